// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/element/crank_angle.hpp"

#include <utility>

namespace clatter::dynamics {

CrankAngle::CrankAngle(CrankClock clock, Rotation rotation, int turn, double firing)
    : clock_(std::move(clock)),
      sign_(rotation == Rotation::kForward ? 1.0 : -1.0),
      firing_(firing),
      turn_(turn) {}

void CrankAngle::join(std::vector<int>& coordinates) const {
  if (is_free()) coordinates.push_back(turn_);
}

TurningAngle CrankAngle::at(double time, double turn, double rate) const {
  const Motion<double> clock = clock_.turn(time);
  return {clock.position - firing_ + sign_ * turn, clock.velocity + sign_ * rate};
}

Motion<double> CrankAngle::lead_of(double time, const Motion<double>& apart) const {
  const Motion<double> now = clock_.turn(time);
  const double later = clock_.time(now.position + apart.position);
  const Motion<double> there = clock_.turn(later);
  const double rate = (now.velocity + apart.velocity) / there.velocity;
  return {
      later - time, rate - 1.0,
      (now.acceleration + apart.acceleration - rate * rate * there.acceleration) / there.velocity};
}

CrankLead CrankAngle::lead(const Stage& stage, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v) const {
  CrankLead lead;
  if (!is_free()) return lead;
  const double a = y(y.size() - 1), rate = v(v.size() - 1), begin = stage.begin();
  const bool known = stage.v_known != nullptr;
  const double acceleration = known ? (rate - (*stage.v_known)(turn_)) / stage.kappa : 0.0;
  const double before = known ? (*stage.y_begin)(turn_) : a - (stage.time - begin) * rate;
  const double rate_before = known ? (*stage.v_begin)(turn_) : rate;
  lead.now = lead_of(stage.time, {sign_ * a, sign_ * rate, sign_ * acceleration});
  lead.begin = lead_of(begin, {sign_ * before, sign_ * rate_before, 0.0});
  const Motion<double> there = clock_.turn(stage.time + lead.now.position);
  const double by = sign_ / there.velocity, per_stage = 1.0 / stage.kappa,
               bend = (1.0 + lead.now.velocity) * there.acceleration / there.velocity;
  lead.by_turn = {by, by * (per_stage - bend),
                  by * per_stage * ((known ? per_stage : 0.0) - 2.0 * bend)};
  return lead;
}

}  // namespace clatter::dynamics
