// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/impact.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::dynamics {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Impact::Impact(System& system, const StageState& state, int element) : system_(system) {
  for (int e = 0; e < system.elements(); ++e) {
    auto* const contact = dynamic_cast<RigidContact*>(&system.element(e));
    if (contact == nullptr) continue;
    const auto& at = system.element(e).coordinates();
    if (auto touch = contact->touch(state.time, gather(state.y, at), gather(state.v_y, at)))
      members_.push_back({e, contact, std::move(*touch)});
  }
  const auto n = std::ssize(members_);
  velocity_.resize(3 * n);
  mobility_.resize(3 * n, 3 * n);
  VectorXd eta, v;
  for (Index i = 0; i < n; ++i) {
    const Member& by = members_[i];
    velocity_.segment<3>(3 * i) = by.at.velocity;
    for (Index k = 0; k < 3; ++k) {
      VectorXd f = VectorXd::Zero(system.interface_size());
      const auto& on = system.element(by.element).coordinates();
      for (size_t c = 0; c < on.size(); ++c) f(on[c]) += by.at.impulses(static_cast<Index>(c), k);
      system.jump(state, f, eta, v);
      const VectorXd y_jump = system.interface(eta), v_jump = system.interface(v);
      for (Index j = 0; j < n; ++j) {
        const auto& at = system.element(members_[j].element).coordinates();
        mobility_.block<3, 1>(3 * j, 3 * i + k) =
            members_[j].at.by_y * gather(y_jump, at) + members_[j].at.by_v * gather(v_jump, at);
      }
    }
    if (by.element == element && !(mobility_(3 * i, 3 * i) > 0.0))
      throw NumericsError(fmt::format("time {:.9g} s: {}: an impact, but nothing there has inertia",
                                      state.time, system.element(element).name()));
    if (by.element == element || (!by.at.law.held && by.at.velocity(0) < 0.0))
      closing_.push_back(by.element);
  }
  mobility_ = (0.5 * (mobility_ + mobility_.transpose())).eval();
}

void Impact::hold(int element) {
  for (Member& member : members_)
    if (member.element == element) member.at.law.held = true;
}

VectorXd Impact::solve() const {
  std::vector<ImpactLaw> laws;
  for (const Member& member : members_) laws.push_back(member.at.law);
  const VectorXd impulses = impact_impulses(mobility_, velocity_, laws);
  VectorXd f = VectorXd::Zero(system_.interface_size());
  for (size_t i = 0; i < members_.size(); ++i) {
    const auto at = static_cast<Index>(3 * i);
    const VectorXd own = members_[i].at.impulses * impulses.segment<3>(at);
    const auto& on = system_.element(members_[i].element).coordinates();
    for (size_t c = 0; c < on.size(); ++c) f(on[c]) += own(static_cast<Index>(c));
    if (!laws[i].held || impulses(at) > 0.0)
      members_[i].contact->take_impulse(impulses(at), 1.0 / mobility_(at, at));
  }
  return f;
}

}  // namespace clatter::dynamics
