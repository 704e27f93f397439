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
  BodyPart& part = parts_.emplace_back();
  part.offset = modes_;
  part.P.resize(0, body.modes());
  modes_ += body.modes();
  omega_squared_ = joined(omega_squared_, body.omega_squared);
  damping_ = joined(damping_, body.damping);
  inertia_ = joined(inertia_, body.inertia);
  second_order_ = joined(second_order_, second_order_of(body));
  eta_start_ = joined(eta_start_, or_zero(body.eta_start, body.modes()));
  v_start_ = joined(v_start_, or_zero(body.v_start, body.modes()));
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
  BodyPart& part = parts_[body];
  const auto found = std::find(part.places.begin(), part.places.end(), place);
  if (found != part.places.end()) return part.rows[found - part.places.begin()];
  const ModalBody& owner = bodies_[body];
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
  part.rows.push_back(index);
  part.places.push_back(place);
  part.P.conservativeResize(part.P.rows() + 1, Eigen::NoChange);
  part.P.bottomRows(1) = row;
  find_singles(body);
  return index;
}

/// Looks at a body that has got a row.
void System::find_singles(int body) {
  BodyPart& part = parts_[body];
  if (!part.is_single) return;
  const MatrixXd& P = part.P;
  const Eigen::Index row = P.rows() - 1;
  Eigen::Index mode = 0;
  const double scale = P.row(row).cwiseAbs().maxCoeff(&mode);
  const bool single =
      (P.row(row).array() != 0.0).count() <= 1 && (P.col(mode).array() != 0.0).count() <= 1;
  if (single) {
    singles_.y.push_back(part.rows.back());
    singles_.mode.push_back(part.offset + static_cast<int>(mode));
    singles_.scale.push_back(std::copysign(scale, P(row, mode)));
    return;
  }
  part.is_single = false;
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
  const BodyPart& part = parts_[owner_[y_index]];
  return part.places[std::find(part.rows.begin(), part.rows.end(), y_index) - part.rows.begin()];
}

void System::add_element(std::unique_ptr<ForceElement> element) {
  ElementPart& part = elements_.emplace_back();
  part.cost.name = element->name();
  part.groups = groups_of(*element);
  part.element = std::move(element);
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
    const int at = parts_[b].offset + kTurn;
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
    const BodyPart& part = parts_[b];
    if (part.is_single) continue;
    part.held.noalias() = part.P * modal.segment(part.offset, bodies_[b].modes());
    for (size_t i = 0; i < part.rows.size(); ++i)
      y(part.rows[i]) = part.held(static_cast<Eigen::Index>(i));
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
  for (const BodyPart& part : parts_) {
    if (part.is_single) continue;
    const MatrixXd& P = part.P;
    const Eigen::Index n = P.rows(), first = part.offset;
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
        (*y[k])(part.rows[i]) = sums[static_cast<Eigen::Index>(k) * n + i];
  }
}

template void System::interface(const std::array<const VectorXd*, 2>&,
                                const std::array<VectorXd*, 2>&) const;
template void System::interface(const std::array<const VectorXd*, 4>&,
                                const std::array<VectorXd*, 4>&) const;

VectorXd System::interface(const VectorXd& modal) const {
  VectorXd y;
  interface(modal, y);
  return y;
}

void System::add_interface_force(const VectorXd& f_y, VectorXd& g) const {
  for (size_t i = 0; i < singles_.y.size(); ++i)
    g(singles_.mode[i]) += singles_.scale[i] * f_y(singles_.y[i]);
  for (size_t b = 0; b < bodies_.size(); ++b) {
    const BodyPart& part = parts_[b];
    if (part.rows.empty() || part.is_single) continue;
    gather(f_y, part.rows, part.held);
    g.segment(part.offset, bodies_[b].modes()).noalias() += part.P.transpose() * part.held;
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
    const Eigen::Index at = parts_[b].offset, n = frame->modes();
    v.segment(at + kSpatial, n) =
        frame->rate_jump(state.time, state.eta.segment(at, kSpatial + n),
                         eta.segment<3>(at + kMomentum), v.segment(at + kSpatial, n));
  }
}

void System::load_force(double time, VectorXd& g) const {
  g.setZero(modes_);
  for (const auto& load : loads_) {
    g.segment(mode_offset(load.body), load.direction.size()) += load.value(time) * load.direction;
  }
}

}  // namespace clatter::dynamics
