// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/turn_torque.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace clatter::dynamics {
namespace {

std::vector<int> both(int angle, std::optional<int> reaction) {
  std::vector<int> coordinates{angle};
  if (reaction) coordinates.push_back(*reaction);
  return coordinates;
}

/// <x> and its slope: 0 below -s, x above s, a parabola between them.
struct Positive {
  double value, slope;
};

Positive positive(double x, double s) {
  if (x >= s) return {x, 1.0};
  if (x <= -s) return {0.0, 0.0};
  return {(x + s) * (x + s) / (4.0 * s), (x + s) / (2.0 * s)};
}

}  // namespace

TurnTorque::TurnTorque(std::string name, int angle, std::optional<int> reaction)
    : ForceElement(both(angle, reaction)), name_(std::move(name)), recorded_(name_ + "_moment") {
  std::replace(recorded_.begin(), recorded_.end(), ' ', '_');
}

TurnLaw TurnTorque::at(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  const bool relative = y.size() == 2;
  return law(time, relative ? y(0) - y(1) : y(0), relative ? v(0) - v(1) : v(0));
}

void TurnTorque::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                          bool with_tangent, Response& response) {
  time_ = stage.time;
  const TurnLaw now = at(time_, y, v);
  last_ = now.moment;
  response.force.resize(y.size());
  response.force(0) = now.moment;
  if (y.size() == 2) response.force(1) = -now.moment;
  if (!with_tangent) return;
  const double slope = now.by_angle + now.by_speed / stage.kappa;
  response.tangent.resize(y.size(), y.size());
  response.tangent(0, 0) = slope;
  if (y.size() == 2) response.tangent << slope, -slope, -slope, slope;
}

Power TurnTorque::power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const {
  return at(time_, y, v).power;
}

void TurnTorque::record(History& history) const { history.put(recorded_, "N m", accepted_); }

TableTorque::TableTorque(std::string name, int angle, std::optional<int> reaction,
                         TorqueTable table, std::function<double(double)> ramp)
    : TurnTorque(std::move(name), angle, reaction),
      table_(std::move(table)),
      ramp_(std::move(ramp)) {}

TurnLaw TableTorque::law(double time, double angle, double speed) const {
  const double from = angle - table_.zero;
  double drive = table_.constant, slope = 0.0;
  for (const TorqueOrder& one : table_.orders) {
    const double phase = one.order * from + one.phase;
    drive += one.amplitude * std::cos(phase);
    slope -= one.order * one.amplitude * std::sin(phase);
  }
  if (table_.table) {
    const SplinePoint point = table_.table->at(from);
    drive += table_.scale * point.value;
    slope += table_.scale * point.first;
  }
  double factor = ramp_(time), factor_by_speed = 0.0;
  if (table_.speed != 0.0) {
    const double ratio = speed / table_.speed;
    factor_by_speed = factor * 2.0 * ratio / table_.speed;
    factor *= ratio * ratio;
  }
  const double hypot = std::hypot(speed, table_.drag_speed);
  const double drag = table_.drag * speed / hypot + table_.viscous * speed;
  const double drag_slope =
      table_.drag * table_.drag_speed * table_.drag_speed / (hypot * hypot * hypot) +
      table_.viscous;
  return {factor * drive - drag,
          factor * slope,
          factor_by_speed * drive - drag_slope,
          {0.0, drag * speed, factor * drive * speed}};
}

TurningAngle TableTorque::table_angle(double, const Eigen::VectorXd& y,
                                      const Eigen::VectorXd& v) const {
  return has_reaction() ? TurningAngle{y(0) - y(1) - table_.zero, v(0) - v(1)}
                        : TurningAngle{y(0) - table_.zero, v(0)};
}

double TableTorque::by_table(double time, const TurningAngle& at) const {
  const double ratio = table_.speed == 0.0 ? 1.0 : at.rate / table_.speed;
  return ramp_(time) * ratio * ratio * table_.scale * table_.table->at(at.angle).value;
}

CamTorque::CamTorque(std::string name, int angle, std::optional<int> reaction, CamTrain train,
                     std::function<double(double)> ramp)
    : TurnTorque(std::move(name), angle, reaction),
      train_(std::move(train)),
      ramp_(std::move(ramp)) {}

TurnLaw CamTorque::law(double time, double angle, double speed) const {
  const double rounding = kRounding * train_.force;
  TurnLaw sum;
  double springs = 0.0;
  for (const double lobe : train_.lobes) {
    const SplinePoint y = train_.law.at(angle - lobe);
    const double inertia = train_.mass * speed * speed;
    const double spring = train_.force + train_.stiffness * y.value;
    const Positive F = positive(spring + inertia * y.second, rounding);
    const double by_angle = F.slope * (train_.stiffness * y.first + inertia * y.third);
    const double by_speed = F.slope * 2.0 * train_.mass * speed * y.second;
    sum.moment -= F.value * y.first;
    sum.by_angle -= by_angle * y.first + F.value * y.second;
    sum.by_speed -= by_speed * y.first;
    sum.power.stored += (train_.force + 0.5 * train_.stiffness * y.value) * y.value;
    springs += spring * y.first;
  }
  const double factor = train_.valves * ramp_(time);
  sum.moment *= factor;
  sum.by_angle *= factor;
  sum.by_speed *= factor;
  sum.power.stored *= train_.valves;
  sum.power.input = (sum.moment + train_.valves * springs) * speed;
  return sum;
}

}  // namespace clatter::dynamics
