// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gas pressure over the angle of a crank that does not turn as the clock.
#include <memory>
#include <string>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/element/table_force.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// (p(theta + delta) - ambient) times a unit load on a body: delta is the deviation of the crank's
/// angle from that of the clock, in the direction of rotation. Its work on the unit load's
/// coordinate, the displaced volume [m3], is the input of the gas.
class GasForce : public ForceElement, public TableForce {
 public:
  /// @param volume y index of the unit load's coordinate. @param turn y index of the crank's
  /// rotation about +x from that of the clock. @param ambient [Pa]. @param ramp of the start.
  GasForce(std::string name, int volume, int turn, const SliderCrank& crank, Spline pressure,
           double ambient, TimeFunction ramp)
      : ForceElement({volume, turn}),
        name_(std::move(name)),
        crank_(crank),
        pressure_(std::move(pressure)),
        ambient_(ambient),
        ramp_(std::move(ramp)) {}
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  TurningAngle table_angle(double time, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v) const override;
  double next_row(double angle) const override { return pressure_.next_point(angle); }
  double by_table(double time, const TurningAngle& at) const override {
    return ramp_(time) * (pressure_(at.angle) - ambient_);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const override {
    return {0.0, 0.0, last_ * v(0)};
  }

 private:
  std::string name_;
  SliderCrank crank_;
  Spline pressure_;
  double ambient_;
  TimeFunction ramp_;
  double last_ = 0.0;  // pressure over ambient [Pa]
};

/// The angle of the cylinder's crank from its firing TDC [rad], by the rotation about +x from that
/// of the clock [rad].
inline double crank_angle(const SliderCrank& crank, double time, double turn) {
  return crank.angle(time) + (crank.spin(time) < 0.0 ? -turn : turn);
}

/// The elements of piston and block, named as the loads of a crank that turns as the clock.
/// InputError for unit loads that do not exist.
std::vector<std::unique_ptr<ForceElement>> gas_forces(const CylinderBodies& bodies,
                                                      const SliderCrank& crank, const Spline& gas);

}  // namespace clatter::dynamics
