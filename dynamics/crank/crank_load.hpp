// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The torque that loads a crankshaft whose rotation is free.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/component/run_time.hpp"
#include "dynamics/crank/mean_torque.hpp"
#include "dynamics/element/crank_angle.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/element/table_force.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// A torque against the rotation: of one of these laws.
struct CrankLoadLaw {
  double constant = 0.0;                 // [N m]
  std::optional<double> at_speed;        // it grows with the square of the speed from here [rad/s]
  std::optional<Spline> table;           // over the crank's angle [N m]
  std::optional<MeanTorque> controller;  // holds the mean speed
};

/// That torque on the rotation rx of the crank from its clock, with the angle theta + d and the
/// speed of the crank itself; d is rx in the direction of rotation. The reaction is on the ground.
class CrankLoad : public ForceElement, public TableForce {
 public:
  static constexpr double kLargest = 0.5;  // deviation from the clock [rad]

  /// @param turn y index of rx. @param ramp of the start.
  CrankLoad(int turn, CrankClock clock, Rotation rotation, CrankLoadLaw law, TimeFunction ramp);
  std::string name() const override { return "crank load"; }
  /// StepRefused where the crank is further from its clock than kLargest.
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  bool has_table() const override { return law_.table.has_value(); }
  TurningAngle table_angle(double time, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v) const override {
    return crank_.at(time, y(0), v(0));
  }
  double next_row(double angle) const override { return law_.table->next_point(angle); }
  double by_table(double time, const TurningAngle& at) const override {
    return -crank_.sign() * ramp_(time) * (*law_.table)(at.angle);
  }
  void begin_step(double time) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd& v) const override {
    return {0.0, 0.0, -crank_.sign() * last_.torque * v(0)};
  }
  /// `crank_load_torque` [N m], `crank_deviation` [rad] from the clock, `crank_speed` [rad/s].
  void record(History& history) const override;
  std::vector<double> save() const override;
  void restore(const std::vector<double>& state) override;

 private:
  struct State {
    double torque = 0.0, angle = 0.0, rate = 0.0, speed = 0.0;
  };
  CrankAngle crank_;
  CrankLoadLaw law_;
  TimeFunction ramp_;
  State last_, finished_, accepted_;
};

}  // namespace clatter::dynamics
