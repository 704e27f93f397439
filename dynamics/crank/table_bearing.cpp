// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/table_bearing.hpp"

#include <fmt/format.h>

namespace clatter::dynamics {

PairForce TableBearing::force(double, const PairMotion& motion) const {
  PairForce law = thrust_force(motion);
  const JournalMotion at = journal(motion);
  const double e = at.offset.norm();
  if (!(e <= table_.last()))
    throw StepRefused(name() + ": the journal is beyond the table of the bearing",
                      fmt::format("eccentricity {:.4g} m", e));
  const double slope = table_.slope(e), across = e > 0.0 ? table_.value(e) / e : slope;
  const Eigen::Vector2d n = e > 0.0 ? Eigen::Vector2d(at.offset / e) : Eigen::Vector2d::Zero();
  const int rows[] = {axes_.first(), axes_.second()};
  for (int i = 0; i < 2; ++i) {
    law.force(rows[i]) = -across * at.offset(i) - damping_ * at.velocity(i);
    law.by_rate(rows[i], rows[i]) = -damping_;
    for (int j = 0; j < 2; ++j)
      law.by_distance(rows[i], rows[j]) = -(slope - across) * n(i) * n(j) - (i == j ? across : 0.0);
  }
  law.stored += table_.integral(e);
  law.lost += damping_ * at.velocity.squaredNorm();
  return law;
}

}  // namespace clatter::dynamics
