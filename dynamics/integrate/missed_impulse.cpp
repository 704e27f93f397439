// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/integrate/missed_impulse.hpp"

#include "dynamics/integrate/rows_in_step.hpp"

namespace clatter::dynamics {

MissedImpulse::MissedImpulse(const System& system, const ErrorWeights& weights,
                             const Tableau& tableau)
    : system_(system),
      weights_(weights),
      tableau_(tableau),
      no_displacement_(Eigen::VectorXd::Zero(system.modes())),
      velocity_(system.modes()) {}

double MissedImpulse::error(double begin, const std::vector<StageState>& stages) {
  const double end = stages[tableau_.stages - 1].time;
  bool any = false;
  for (const Load& load : system_.loads()) {
    if (!load.next_row) continue;
    const RowsInStep rows(load, begin, end);
    if (!rows.hide_something()) continue;
    double sum = tableau_.b[0] * load.value(begin);
    for (size_t i = 0; i < stages.size(); ++i)
      sum += tableau_.b[i + 1] * load.value(stages[i].time);
    if (!any) velocity_.setZero();
    any = true;
    velocity_.segment(system_.mode_offset(load.body), load.direction.size()) +=
        (rows.integral() - (end - begin) * sum) * load.direction;
  }
  return any ? modal_error(system_, weights_, no_displacement_, velocity_) : 0.0;
}

}  // namespace clatter::dynamics
