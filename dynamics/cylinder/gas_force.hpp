// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Gas pressure over the angle of a crank that does not turn as the clock.
#include <memory>
#include <string>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/element/table_force.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// (p(theta) - ambient) times a unit load on a body, theta of the crank itself. Its work on the
/// unit load's coordinate, the displaced volume [m3], is the input of the gas.
class GasForce : public ForceElement, public TableForce {
 public:
  /// @param volume y index of the unit load's coordinate. @param crank free. @param ambient [Pa].
  /// @param ramp of the start.
  GasForce(std::string name, int volume, CrankAngle crank, Spline pressure, double ambient,
           TimeFunction ramp)
      : ForceElement({volume}),
        name_(std::move(name)),
        crank_(std::move(crank)),
        pressure_(std::move(pressure)),
        ambient_(ambient),
        ramp_(std::move(ramp)) {
    crank_.join(coordinates_);
  }
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  TurningAngle table_angle(double time, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v) const override {
    return crank_.at(time, y(1), v(1));
  }
  double next_row(double angle) const override { return pressure_.next_point(angle); }
  double by_table(double time, const TurningAngle& at) const override {
    return ramp_(time) * (pressure_(at.angle) - ambient_);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const override {
    return {0.0, 0.0, last_ * v(0)};
  }

 private:
  std::string name_;
  CrankAngle crank_;
  Spline pressure_;
  double ambient_;
  TimeFunction ramp_;
  double last_ = 0.0;  // pressure over ambient [Pa]
};

/// The elements of piston and block, named as the loads of a crank that turns as the clock.
/// InputError for unit loads that do not exist.
std::vector<std::unique_ptr<ForceElement>> gas_forces(const CylinderBodies& bodies,
                                                      const CrankAngle& crank, const Spline& gas);

}  // namespace clatter::dynamics
