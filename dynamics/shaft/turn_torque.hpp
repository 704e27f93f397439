// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Torques over the angle of the body on which they act.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/element/table_force.hpp"
#include "dynamics/given/cam_law.hpp"
#include "dynamics/given/periodic_spline.hpp"

namespace clatter::dynamics {

/// Moment [N m] at an angle and speed, and its derivatives.
struct TurnLaw {
  double moment = 0.0, by_angle = 0.0, by_speed = 0.0;
  Power power;
};

/// A moment on an angle that depends on angle and speed; its reaction acts on a second one, from
/// which both are then measured, or on the ground.
class TurnTorque : public ForceElement {
 public:
  /// @param angle, reaction: y indices.
  TurnTorque(std::string name, int angle, std::optional<int> reaction);
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_moment` [N m]; spaces of the name are underscores.
  void record(History& history) const override;

 protected:
  virtual TurnLaw law(double time, double angle, double speed) const = 0;

 private:
  TurnLaw at(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  std::string name_, recorded_;
  double time_ = 0.0, last_ = 0.0, finished_ = 0.0, accepted_ = 0.0;
};

/// One order of a torque: amplitude cos(order * angle + phase).
struct TorqueOrder {
  double order = 1.0, amplitude = 0.0, phase = 0.0;  // per turn, [N m], [rad]
};

struct TorqueTable {
  double constant = 0.0;  // [N m]
  std::vector<TorqueOrder> orders;
  std::optional<PeriodicSpline> table;  // [N m] over the angle [rad]
  double scale = 1.0;                   // of the table
  double zero = 0.0;   // angle of the body where the table's and orders' is 0 [rad]
  double speed = 0.0;  // all of the above hold at it and grow with its square; 0: at any [rad/s]
  double drag = 0.0;   // against the rotation [N m]
  double drag_speed = 0.1;  // over which the drag reaches 71 % [rad/s]
  double viscous = 0.0;     // [N m s]
};

/// moment = ramp (constant + sum of orders + table) (speed / reference)^2
///          - drag speed / sqrt(speed^2 + drag_speed^2) - viscous speed
class TableTorque : public TurnTorque, public TableForce {
 public:
  /// @param ramp factor over time [s].
  TableTorque(std::string name, int angle, std::optional<int> reaction, TorqueTable table,
              std::function<double(double)> ramp);
  bool has_table() const override { return table_.table.has_value(); }
  TurningAngle table_angle(double time, const Eigen::VectorXd& y,
                           const Eigen::VectorXd& v) const override;
  double next_row(double angle) const override { return table_.table->next_point(angle); }
  double by_table(double time, const TurningAngle& at) const override;
  bool has_reaction() const override { return coordinates_.size() == 2; }

 protected:
  TurnLaw law(double time, double angle, double speed) const override;

 private:
  TorqueTable table_;
  std::function<double(double)> ramp_;
};

/// Valves that lobes of one body open, without motion of their own.
struct CamTrain {
  CamLaw law;
  std::vector<double> lobes;  // angle of the body at which each is at the law's angle 0 [rad]
  double valves = 1.0;        // per lobe
  double force = 0.0;         // of a spring at lift 0 [N]
  double stiffness = 0.0;     // of a spring [N/m]
  double mass = 0.0;          // reduced to the valve [kg]
};

/// moment = - sum over lobes of n F y',  F = <F_0 + k y + m speed^2 y''>, by virtual work.
///
/// The train moves as at constant speed (no m y' speed'), and does not bounce: F >= 0, where < > is
/// rounded over kRounding of F_0. The springs' energy is stored; what their inertia takes and gives
/// is input.
class CamTorque : public TurnTorque {
 public:
  static constexpr double kRounding = 0.02;
  /// @param ramp factor over time [s].
  CamTorque(std::string name, int angle, std::optional<int> reaction, CamTrain train,
            std::function<double(double)> ramp);

 protected:
  TurnLaw law(double time, double angle, double speed) const override;

 private:
  CamTrain train_;
  std::function<double(double)> ramp_;
};

}  // namespace clatter::dynamics
