// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "dynamics/body/spatial_frame.hpp"

namespace clatter::dynamics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

void gather(const VectorXd& all, const std::vector<int>& indices, VectorXd& picked) {
  picked.resize(static_cast<Eigen::Index>(indices.size()));
  for (size_t i = 0; i < indices.size(); ++i)
    picked(static_cast<Eigen::Index>(i)) = all(indices[i]);
}

void scatter_add(const VectorXd& values, const std::vector<int>& indices, VectorXd& all) {
  for (size_t i = 0; i < indices.size(); ++i)
    all(indices[i]) += values(static_cast<Eigen::Index>(i));
}

VectorXd gather(const VectorXd& all, const std::vector<int>& indices) {
  VectorXd picked;
  gather(all, indices, picked);
  return picked;
}

namespace {

VectorXd joined(const VectorXd& head, const VectorXd& tail) {
  VectorXd both(head.size() + tail.size());
  both << head, tail;
  return both;
}

/// 1 for coordinates of second order, n_m.
VectorXd second_order_of(const ModalBody& body) {
  VectorXd flags = VectorXd::Ones(body.modes());
  for (int k = 0; k < body.modes(); ++k)
    if (body.is_state(k)) flags(k) = 0.0;
  return flags;
}

/// The y indices of an element's groups.
std::vector<std::vector<int>> groups_of(const ForceElement& element) {
  const std::vector<int>& at = element.coordinates();
  if (element.groups().empty()) return {at};
  std::vector<std::vector<int>> groups = element.groups();
  for (std::vector<int>& group : groups)
    for (int& i : group) i = at[i];
  return groups;
}

VectorXd or_zero(const VectorXd& values, int size) {
  return values.size() > 0 ? values : VectorXd::Zero(size);
}

}  // namespace

int System::add_body(ModalBody body) {
  offsets_.push_back(modes_);
  modes_ += body.modes();
  omega_squared_ = joined(omega_squared_, body.omega_squared);
  damping_ = joined(damping_, body.damping);
  inertia_ = joined(inertia_, body.inertia);
  second_order_ = joined(second_order_, second_order_of(body));
  eta_start_ = joined(eta_start_, or_zero(body.eta_start, body.modes()));
  v_start_ = joined(v_start_, or_zero(body.v_start, body.modes()));
  rows_.emplace_back();
  places_.emplace_back();
  P_.emplace_back(0, body.modes());
  part_.emplace_back();
  single_.push_back(1);
  bodies_.push_back(std::move(body));
  return static_cast<int>(bodies_.size()) - 1;
}

int System::coordinate(int body, int dof) {
  return find_or_add(body, {dof, 0, Eigen::Vector3d::Zero()});
}

int System::frame_coordinate(int body, int k, const Eigen::Vector3d& point) {
  return find_or_add(body, {kFrame, k, k < 3 ? point : Eigen::Vector3d::Zero()});
}

int System::modal_coordinate(int body, int mode) {
  return find_or_add(body, {kMode, mode, Eigen::Vector3d::Zero()});
}

int System::combined_coordinate(int body, const WeightedDofs& sum) {
  const auto found = std::find(sums_.begin(), sums_.end(), sum);
  const auto index = static_cast<int>(found - sums_.begin());
  if (found == sums_.end()) sums_.push_back(sum);
  return find_or_add(body, {kSum, index, Eigen::Vector3d::Zero()});
}

int System::find_or_add(int body, const Place& place) {
  const auto b = static_cast<size_t>(body);
  const auto found = std::find(places_[b].begin(), places_[b].end(), place);
  if (found != places_[b].end()) return rows_[b][found - places_[b].begin()];
  const ModalBody& owner = bodies_[b];
  Eigen::RowVectorXd row;
  if (place.dof == kFrame) {
    row = owner.force_of(unit_wrench(place.axis, place.point)).transpose();
  } else if (place.dof == kMode) {
    row = Eigen::RowVectorXd::Unit(owner.modes(), place.axis);
  } else if (place.dof == kSum) {
    const WeightedDofs& sum = sums_[place.axis];
    row.setZero(owner.modes());
    for (size_t i = 0; i < sum.dofs.size(); ++i) row += sum.weights[i] * owner.row_of(sum.dofs[i]);
  } else {
    row = owner.row_of(place.dof);
  }
  const int index = interface_size();
  owner_.push_back(body);
  rows_[b].push_back(index);
  places_[b].push_back(place);
  P_[b].conservativeResize(P_[b].rows() + 1, Eigen::NoChange);
  P_[b].bottomRows(1) = row;
  find_singles(body);
  return index;
}

/// Looks at a body that has got a row.
void System::find_singles(int body) {
  const auto b = static_cast<size_t>(body);
  if (single_[b] == 0) return;
  const Eigen::Index row = P_[b].rows() - 1;
  Eigen::Index mode = 0;
  const double scale = P_[b].row(row).cwiseAbs().maxCoeff(&mode);
  const bool single =
      (P_[b].row(row).array() != 0.0).count() <= 1 && (P_[b].col(mode).array() != 0.0).count() <= 1;
  if (single) {
    singles_.y.push_back(rows_[b].back());
    singles_.mode.push_back(offsets_[b] + static_cast<int>(mode));
    singles_.scale.push_back(std::copysign(scale, P_[b](row, mode)));
    return;
  }
  single_[b] = 0;
  SingleRows others;
  for (size_t i = 0; i < singles_.y.size(); ++i) {
    if (owner(singles_.y[i]) == body) continue;
    others.y.push_back(singles_.y[i]);
    others.mode.push_back(singles_.mode[i]);
    others.scale.push_back(singles_.scale[i]);
  }
  singles_ = std::move(others);
}

const System::Place& System::place_of(int y_index) const {
  const auto b = static_cast<size_t>(owner_[y_index]);
  const auto at = std::find(rows_[b].begin(), rows_[b].end(), y_index) - rows_[b].begin();
  return places_[b][at];
}

void System::add_element(std::unique_ptr<ForceElement> element) {
  costs_.push_back({element->name()});
  responses_.emplace_back();
  tangent_rows_.emplace_back();
  groups_.push_back(groups_of(*element));
  y_of_.emplace_back();
  v_of_.emplace_back();
  moved_.emplace_back();
  change_.emplace_back();
  elements_.push_back(std::move(element));
}

void System::add_load(Load load) { loads_.push_back(std::move(load)); }

bool System::is_rotation(int y_index) const {
  const Place& place = place_of(y_index);
  if (place.dof == kMode) return false;
  if (place.dof == kFrame) return place.axis >= 3;
  if (place.dof == kSum) return sums_[place.axis].is_rotation;
  return bodies_[owner(y_index)].is_rotation[place.dof] != 0;
}

int System::mode_of(int y_index) const {
  const Place& place = place_of(y_index);
  return place.dof == kMode ? place.axis : -1;
}

std::string System::coordinate_name(int y_index) const {
  static constexpr const char* kAxes[] = {"x", "y", "z", "rx", "ry", "rz"};
  const Place& place = place_of(y_index);
  const std::string& body = bodies_[owner(y_index)].name;
  if (place.dof == kMode) return fmt::format("{}: mode {}", body, place.axis + 1);
  if (place.dof == kFrame) return fmt::format("{}: rigid frame, {}", body, kAxes[place.axis]);
  if (place.dof == kSum)
    return fmt::format("{}: {} of {} coordinates", body,
                       is_rotation(y_index) ? "rotation" : "displacement",
                       sums_[place.axis].dofs.size());
  return fmt::format("{}: coordinate {}", body, place.dof);
}

void System::start_frames(double time) const {
  for (const ModalBody& body : bodies_) {
    if (!body.frame) continue;
    const Attitude first = body.frame->free().first();
    body.frame->restart(time, first.q, first.spin);
  }
}

void System::restart_frames(StageState& before, StageState& now) const {
  bool any = false;
  for (size_t b = 0; b < bodies_.size(); ++b) {
    if (!bodies_[b].frame) continue;
    any = true;
    SpatialFrame& frame = *bodies_[b].frame;
    const int at = offsets_[b] + kTurn;
    const auto spin = [&](const StageState& x) {
      return frame.spin(x.time, x.eta.segment<4>(at), x.v.segment<4>(at));
    };
    const Eigen::Vector4d q_before = frame.quaternion(before.time, before.eta.segment<4>(at)),
                          q_now = frame.quaternion(now.time, now.eta.segment<4>(at));
    const Eigen::Vector3d spin_before = spin(before), spin_now = spin(now);
    frame.restart(now.time, q_now, spin_now);
    Eigen::Vector4d p, rate;
    frame.localise(before.time, q_before, spin_before, p, rate);
    before.eta.segment<4>(at) = p;
    before.v.segment<4>(at) = rate;
    now.eta.segment<4>(at) = Eigen::Vector4d::Unit(0);
    now.v.segment<4>(at).setZero();
    before.a.segment<4>(at).setZero();
    now.a.segment<4>(at).setZero();
  }
  if (!any) return;
  for (StageState* state : {&before, &now}) {
    interface(state->eta, state->y);
    interface(state->v, state->v_y);
  }
}

void System::interface(const VectorXd& modal, VectorXd& y) const {
  y.resize(interface_size());
  for (size_t i = 0; i < singles_.y.size(); ++i)
    y(singles_.y[i]) = singles_.scale[i] * modal(singles_.mode[i]);
  for (size_t b = 0; b < bodies_.size(); ++b) {
    if (single_[b] != 0) continue;
    part_[b].noalias() = P_[b] * modal.segment(offsets_[b], bodies_[b].modes());
    for (size_t i = 0; i < rows_[b].size(); ++i)
      y(rows_[b][i]) = part_[b](static_cast<Eigen::Index>(i));
  }
}

template <size_t kCount>
void System::interface(const std::array<const VectorXd*, kCount>& modal,
                       const std::array<VectorXd*, kCount>& y) const {
  for (size_t k = 0; k < kCount; ++k) {
    y[k]->resize(interface_size());
    for (size_t i = 0; i < singles_.y.size(); ++i)
      (*y[k])(singles_.y[i]) = singles_.scale[i] * (*modal[k])(singles_.mode[i]);
  }
  for (size_t b = 0; b < bodies_.size(); ++b) {
    if (single_[b] != 0) continue;
    const MatrixXd& P = P_[b];
    const Eigen::Index n = P.rows(), first = offsets_[b];
    row_sums_.assign(kCount * static_cast<size_t>(n), 0.0);
    double* sums = row_sums_.data();
    for (Eigen::Index j = 0; j < P.cols(); ++j) {
      const double* column = P.col(j).data();
      std::array<double, kCount> x;
      for (size_t k = 0; k < kCount; ++k) x[k] = (*modal[k])(first + j);
      for (Eigen::Index i = 0; i < n; ++i)
        for (size_t k = 0; k < kCount; ++k)
          sums[static_cast<Eigen::Index>(k) * n + i] += column[i] * x[k];
    }
    for (size_t k = 0; k < kCount; ++k)
      for (Eigen::Index i = 0; i < n; ++i)
        (*y[k])(rows_[b][i]) = sums[static_cast<Eigen::Index>(k) * n + i];
  }
}

template void System::interface(const std::array<const VectorXd*, 2>&,
                                const std::array<VectorXd*, 2>&) const;
template void System::interface(const std::array<const VectorXd*, 3>&,
                                const std::array<VectorXd*, 3>&) const;

VectorXd System::interface(const VectorXd& modal) const {
  VectorXd y;
  interface(modal, y);
  return y;
}

void System::add_interface_force(const VectorXd& f_y, VectorXd& g) const {
  for (size_t i = 0; i < singles_.y.size(); ++i)
    g(singles_.mode[i]) += singles_.scale[i] * f_y(singles_.y[i]);
  for (size_t b = 0; b < bodies_.size(); ++b) {
    if (rows_[b].empty() || single_[b] != 0) continue;
    gather(f_y, rows_[b], part_[b]);
    g.segment(offsets_[b], bodies_[b].modes()).noalias() += P_[b].transpose() * part_[b];
  }
}

void System::jump(const StageState& state, const VectorXd& impulse, VectorXd& eta,
                  VectorXd& v) const {
  eta.setZero(modes_);
  v.setZero(modes_);
  add_interface_force(impulse, v);
  for (Eigen::Index k = 0; k < modes_; ++k)
    if (second_order_(k) == 0.0) eta(k) = v(k) / damping_(k);
  v.array() *= inertia_.array();
  for (size_t b = 0; b < bodies_.size(); ++b) {
    const auto& frame = bodies_[b].frame;
    if (!frame || frame->modes() == 0) continue;
    const Eigen::Index at = offsets_[b], n = frame->modes();
    v.segment(at + kSpatial, n) =
        frame->rate_jump(state.time, state.eta.segment(at, kSpatial + n),
                         eta.segment<3>(at + kMomentum), v.segment(at + kSpatial, n));
  }
}

Mobility System::mobility(const StageState& state, const std::vector<int>& coordinates) const {
  const auto n = static_cast<Eigen::Index>(coordinates.size());
  Mobility found{MatrixXd(n, n), MatrixXd(n, n)};
  VectorXd eta, v;
  for (Eigen::Index k = 0; k < n; ++k) {
    jump(state, VectorXd::Unit(interface_size(), coordinates[k]), eta, v);
    found.y.col(k) = gather(interface(eta), coordinates);
    found.v.col(k) = gather(interface(v), coordinates);
  }
  return found;
}

void System::load_force(double time, VectorXd& g) const {
  g.setZero(modes_);
  for (const auto& load : loads_) {
    g.segment(mode_offset(load.body), load.direction.size()) += load.value(time) * load.direction;
  }
}

}  // namespace clatter::dynamics
