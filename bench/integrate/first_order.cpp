// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/first_order.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/error.hpp"
#include "dynamics/integrate/impact.hpp"

namespace clatter::bench {

using dynamics::ForceElement;
using dynamics::gather;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A stage that ends where it begins: what moves within a step is at its value at `time`.
dynamics::Stage instant(double time, double kappa) { return {time, kappa, 0, {-kappa}}; }

/// Over which the direction of an event function is looked at [s].
constexpr double kMoment = 1e-9;

}  // namespace

FirstOrder::FirstOrder(dynamics::System& system, bool events_of_contacts) : system_(&system) {
  const int N = system.modes();
  int next = N;
  for (int k = 0; k < N; ++k) {
    const bool second = system.second_order()(k) != 0.0;
    if (second && system.inertia()(k) == 0.0)
      throw InputError("bench: found a quasi-static mode, expected modes with inertia");
    v_at_.push_back(second ? next++ : -1);
  }
  D_ = VectorXd::Ones(next);
  for (int k = 0; k < N; ++k)
    if (v_at_[k] < 0) D_(k) = system.damping()(k);
  v_.setZero(N);
  for (int e = 0; e < system.elements(); ++e) {
    const int groups = static_cast<int>(system.groups(e).size());
    for (int g = 0; g < groups; ++g) blocks_.push_back(block_of(e, g));
    for (int i = 0; i < system.element(e).events(); ++i) events_.push_back({e, i});
    auto* contact = dynamic_cast<dynamics::ProfileContact*>(&system.element(e));
    if (contact == nullptr || !events_of_contacts) continue;
    contacts_.push_back(contact);
    gaps_ += contact->outlines();
  }
  find_pattern();
}

int FirstOrder::row_of(int mode) const {
  const int v = v_at_[mode];
  return v < 0 ? mode : v;
}

FirstOrder::Block FirstOrder::block_of(int element, int group) const {
  const std::vector<int>& at = system_->groups(element)[group];
  Block block;
  block.element = element;
  block.group = group;
  std::map<int, int> column;  // of a mode
  const auto row_of_P = [&](int y) {
    const int body = system_->owner(y);
    const auto& rows = system_->rows(body);
    const auto row = std::find(rows.begin(), rows.end(), y) - rows.begin();
    return std::pair(system_->mode_offset(body), Eigen::RowVectorXd(system_->P(body).row(row)));
  };
  for (const int y : at) {
    const auto [first, row] = row_of_P(y);
    for (Index k = 0; k < row.size(); ++k)
      if (row(k) != 0.0) column[first + static_cast<int>(k)] = 0;
  }
  for (auto& [mode, place] : column) {
    place = static_cast<int>(block.modes.size());
    block.modes.push_back(mode);
  }
  block.P = MatrixXd::Zero(static_cast<Index>(at.size()), static_cast<Index>(block.modes.size()));
  for (size_t i = 0; i < at.size(); ++i) {
    const auto [first, row] = row_of_P(at[i]);
    for (Index k = 0; k < row.size(); ++k)
      if (row(k) != 0.0)
        block.P(static_cast<Index>(i), column.at(first + static_cast<int>(k))) = row(k);
  }
  return block;
}

void FirstOrder::find_pattern() {
  std::vector<std::set<int64_t>> columns(static_cast<size_t>(size()));
  const auto column = [&](int j) -> std::set<int64_t>& { return columns[j]; };
  for (int j = 0; j < size(); ++j) column(j).insert(j);
  for (int k = 0; k < modes(); ++k) {
    const int v = v_at_[k];
    if (v < 0) continue;
    column(v).insert(k);
    column(k).insert(v);
  }
  for (const Block& block : blocks_)
    for (const int j : block.modes)
      for (const int i : block.modes) {
        column(j).insert(row_of(i));
        if (v_at_[j] >= 0) column(row_of(j)).insert(row_of(i));
      }
  for (const auto& rows : columns) {
    starts_.push_back(static_cast<int64_t>(rows_.size()));
    rows_.insert(rows_.end(), rows.begin(), rows.end());
  }
  starts_.push_back(static_cast<int64_t>(rows_.size()));
  const auto position = [&](int i, int j) {
    const auto begin = rows_.begin() + starts_[j],
               end = rows_.begin() + starts_[static_cast<size_t>(j) + 1];
    return std::lower_bound(begin, end, i) - rows_.begin();
  };
  for (int j = 0; j < size(); ++j) diagonal_.push_back(position(j, j));
  for (int k = 0; k < modes(); ++k) {
    const int v = v_at_[k];
    eta_of_v_.push_back(v < 0 ? -1 : position(k, v));
    omega_at_.push_back(v < 0 ? -1 : position(v, k));
    damping_at_.push_back(v < 0 ? -1 : position(v, v));
  }
  for (Block& block : blocks_)
    for (const int j : block.modes)
      for (const int i : block.modes) {
        const int v = v_at_[j];
        block.at_eta.push_back(position(row_of(i), j));
        block.at_v.push_back(v < 0 ? -1 : position(row_of(i), v));
      }
}

VectorXd FirstOrder::state(const VectorXd& eta, const VectorXd& v) const {
  VectorXd x(size());
  x.head(modes()) = eta;
  for (int k = 0; k < modes(); ++k)
    if (v_at_[k] >= 0) x(v_at_[k]) = v(k);
  return x;
}

VectorXd FirstOrder::velocities(const VectorXd& x) const {
  VectorXd v = VectorXd::Zero(modes());
  for (int k = 0; k < modes(); ++k)
    if (v_at_[k] >= 0) v(k) = x(v_at_[k]);
  return v;
}

void FirstOrder::set_state(const double* x) {
  eta_ = Eigen::Map<const VectorXd>(x, modes());
  for (int k = 0; k < modes(); ++k)
    if (v_at_[k] >= 0) v_(k) = x[v_at_[k]];
  system_->interface(eta_, y_);
  system_->interface(v_, v_y_);
}

void FirstOrder::evaluate(double time, const double* x, double* g) {
  set_state(x);
  system_->evaluate(instant(time, 1.0), y_, v_y_, false, f_);
  system_->load_force(time, F_);
  system_->add_interface_force(f_, F_);
  const auto &omega_squared = system_->omega_squared(), &damping = system_->damping();
  for (int k = 0; k < modes(); ++k) {
    const int v = v_at_[k];
    if (v < 0) {
      g[k] = F_(k);
    } else {
      g[k] = v_(k);
      g[v] = F_(k) - damping(k) * v_(k) - omega_squared(k) * eta_(k);
    }
  }
}

/// nullptr: zero.
const MatrixXd* FirstOrder::tangent_of(const Block& block) const {
  const dynamics::Response& response = system_->response(block.element);
  if (!system_->has_groups(block.element)) return &response.tangent;
  const dynamics::TangentBlock& own = response.blocks[block.group];
  return own.active ? &own.values : nullptr;
}

void FirstOrder::jacobian(double time, const double* x, double* values) {
  set_state(x);
  system_->evaluate(instant(time, 1.0), y_, v_y_, true, f_);
  for (Block& block : blocks_)
    if (const MatrixXd* T = tangent_of(block); T != nullptr) block.T_1 = *T;
  system_->evaluate(instant(time, 2.0), y_, v_y_, true, f_);
  std::fill(values, values + rows_.size(), 0.0);
  for (int k = 0; k < modes(); ++k) {
    const auto i = static_cast<size_t>(k);
    if (v_at_[i] < 0) continue;
    values[eta_of_v_[i]] = 1.0;
    values[omega_at_[i]] -= system_->omega_squared()(k);
    values[damping_at_[i]] -= system_->damping()(k);
  }
  for (Block& block : blocks_) add_block(block, values);
}

/// Adds P^T A P and P^T B P of the tangents T_1 = A + B (kappa = 1) and T_2 = A + B / 2.
void FirstOrder::add_block(Block& block, double* values) const {
  const MatrixXd* T_2 = tangent_of(block);
  if (T_2 == nullptr) return;
  const std::vector<int>& touched = system_->response(block.element).touched;
  block.B = 2.0 * (block.T_1 - *T_2);
  block.A = block.T_1 - block.B;
  const bool all = touched.empty();
  if (!all) block.P_touched = block.P(touched, Eigen::all);
  const MatrixXd& P = all ? block.P : block.P_touched;
  block.product.noalias() = block.A * P;
  block.by_eta.noalias() = P.transpose() * block.product;
  for (size_t i = 0; i < block.at_eta.size(); ++i)
    values[block.at_eta[i]] += block.by_eta(static_cast<Index>(i));
  if (block.B.isZero(0.0)) return;
  block.product.noalias() = block.B * P;
  block.by_v.noalias() = P.transpose() * block.product;
  const double rounding = 1e-12 * block.by_eta.cwiseAbs().maxCoeff();
  for (size_t i = 0; i < block.at_v.size(); ++i) {
    const double value = block.by_v(static_cast<Index>(i));
    if (block.at_v[i] >= 0) {
      values[block.at_v[i]] += value;
    } else if (std::abs(value) > rounding) {
      throw NumericsError("bench: a force depends on the rate of a state");
    }
  }
}

void FirstOrder::event_functions(double time, const double* x, double* values) {
  set_state(x);
  for (size_t i = 0; i < events_.size(); ++i) {
    const ForceElement& element = system_->element(events_[i].element);
    const auto& at = element.coordinates();
    values[i] = element.event_function(events_[i].index, time, gather(y_, at), gather(v_y_, at));
  }
  double* gaps = values + events_.size();
  for (dynamics::ProfileContact* contact : contacts_) {
    const auto& at = contact->coordinates();
    gather(y_, at, y_contact_);
    gather(v_y_, at, v_contact_);
    contact->find_gaps(time, y_contact_, v_contact_,
                       {gaps, static_cast<size_t>(contact->outlines())});
    gaps += contact->outlines();
  }
}

int FirstOrder::side(int event, double time, const double* x) {
  VectorXd g(size()), now(events()), then(events());
  evaluate(time, x, g.data());
  const VectorXd later = Eigen::Map<const VectorXd>(x, size()) + kMoment * g.cwiseQuotient(D_);
  event_functions(time, x, now.data());
  event_functions(time + kMoment, later.data(), then.data());
  const double change = then(event) - now(event);
  const bool at_root = std::abs(now(event)) <= std::abs(change);
  return (at_root ? change : now(event)) >= 0.0 ? 1 : -1;
}

int FirstOrder::pass_event(int event, double time, double* x) {
  set_state(x);
  const EventFunction& which = events_[event];
  const dynamics::StageState now{time, eta_, v_, {}, y_, v_y_};
  VectorXd f = VectorXd::Zero(system_->interface_size()), eta_jump, v_jump;
  ForceElement& element = system_->element(which.element);
  if (which.index == dynamics::RigidContact::kTouch &&
      dynamic_cast<dynamics::RigidContact*>(&element) != nullptr)
    f = dynamics::Impact(*system_, now, which.element).solve();
  else
    element.at_event(which.index, time);
  system_->jump(now, f, eta_jump, v_jump);
  eta_ += eta_jump;
  v_ += v_jump;
  Eigen::Map<VectorXd>(x, size()) = state(VectorXd(eta_), VectorXd(v_));
  return side(event, time, x);
}

}  // namespace clatter::bench
