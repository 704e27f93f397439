// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/crank_load.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/units.hpp"

namespace clatter::dynamics {

CrankLoad::CrankLoad(int turn, CrankClock clock, Rotation rotation, CrankLoadLaw law,
                     TimeFunction ramp)
    : ForceElement({turn}),
      crank_(std::move(clock), rotation, turn),
      law_(std::move(law)),
      ramp_(std::move(ramp)) {}

void CrankLoad::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                         bool with_tangent, Response& response) {
  const double angle = crank_.sign() * y(0), rate = crank_.sign() * v(0);
  if (!(std::abs(angle) <= kLargest))
    throw StepRefused("crankshaft: its load does not hold the speed of the clock",
                      fmt::format("{:.3g} deg from its clock, at most {:.3g}", angle / kDegree,
                                  kLargest / kDegree));
  const TurningAngle turn = table_angle(stage.time, y, v);
  const double share = ramp_(stage.time);
  double torque = law_.controller ? law_.controller->torque() : law_.constant;
  double by_angle = 0.0, by_rate = 0.0;
  if (law_.at_speed) {
    const double ratio = turn.rate / *law_.at_speed;
    by_rate = 2.0 * torque * ratio / *law_.at_speed;
    torque *= ratio * ratio;
  } else if (law_.table) {
    torque = (*law_.table)(turn.angle);
    by_angle = law_.table->slope(turn.angle);
  }
  last_ = {share * torque, angle, rate, turn.rate};
  response.force.setConstant(1, -crank_.sign() * last_.torque);
  if (with_tangent) response.tangent.setConstant(1, 1, -share * (by_angle + by_rate / stage.kappa));
}

void CrankLoad::begin_step(double time) {
  if (law_.controller) law_.controller->begin_step(time);
}

void CrankLoad::accept_step(double time) {
  accepted_ = finished_;
  if (law_.controller) law_.controller->accept_step(time, accepted_.angle, accepted_.rate);
}

void CrankLoad::record(History& history) const {
  history.put("crank_load_torque", "N m", accepted_.torque);
  history.put("crank_deviation", "rad", accepted_.angle);
  history.put("crank_speed", "rad/s", accepted_.speed);
}

std::vector<double> CrankLoad::save() const {
  return law_.controller ? law_.controller->save() : std::vector<double>{};
}

void CrankLoad::restore(const std::vector<double>& state) {
  if (law_.controller) law_.controller->restore(state);
}

}  // namespace clatter::dynamics
