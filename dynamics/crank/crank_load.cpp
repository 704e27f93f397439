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
      sign_(rotation == Rotation::kForward ? 1.0 : -1.0),
      clock_(std::move(clock)),
      law_(std::move(law)),
      ramp_(std::move(ramp)) {}

void CrankLoad::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                         bool with_tangent, Response& response) {
  const double angle = sign_ * y(0), rate = sign_ * v(0);
  if (!(std::abs(angle) <= kLargest))
    throw StepRefused("crankshaft: its load does not hold the speed of the clock",
                      fmt::format("{:.3g} deg from its clock, at most {:.3g}", angle / kDegree,
                                  kLargest / kDegree));
  const Motion<double> turn = clock_.turn(stage.time);
  const double share = ramp_(stage.time);
  double torque = law_.controller ? law_.controller->torque() : law_.constant;
  double by_angle = 0.0, by_rate = 0.0;
  if (law_.at_speed) {
    const double ratio = (turn.velocity + rate) / *law_.at_speed;
    by_rate = 2.0 * torque * ratio / *law_.at_speed;
    torque *= ratio * ratio;
  } else if (law_.table) {
    constexpr double kStep = 1e-5;  // [rad]: central difference of a piecewise cubic
    const double at = turn.position + angle;
    torque = (*law_.table)(at);
    by_angle = ((*law_.table)(at + kStep) - (*law_.table)(at - kStep)) / (2.0 * kStep);
  }
  last_ = {share * torque, angle, rate};
  response.force.setConstant(1, -sign_ * last_.torque);
  if (with_tangent) response.tangent.setConstant(1, 1, -share * (by_angle + by_rate / stage.kappa));
}

TurningAngle CrankLoad::table_angle(double time, const Eigen::VectorXd& y,
                                    const Eigen::VectorXd& v) const {
  const Motion<double> turn = clock_.turn(time);
  return {turn.position + sign_ * y(0), turn.velocity + sign_ * v(0)};
}

void CrankLoad::begin_step(double time) {
  if (law_.controller) law_.controller->begin_step(time);
}

void CrankLoad::accept_step(double time) {
  accepted_ = finished_;
  time_ = time;
  if (law_.controller) law_.controller->accept_step(time, accepted_.angle, accepted_.rate);
}

void CrankLoad::record(History& history) const {
  history.put("crank_load_torque", "N m", accepted_.torque);
  history.put("crank_deviation", "rad", accepted_.angle);
  history.put("crank_speed", "rad/s", clock_.turn(time_).velocity + accepted_.rate);
}

std::vector<double> CrankLoad::save() const {
  return law_.controller ? law_.controller->save() : std::vector<double>{};
}

void CrankLoad::restore(const std::vector<double>& state) {
  if (law_.controller) law_.controller->restore(state);
}

}  // namespace clatter::dynamics
