// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Forces between two ports.
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/force/element.hpp"
#include "dynamics/force/port.hpp"

namespace clatter::dynamics {

/// Force and moment on port a of a pair, by the motion of a relative to b; the reaction on b acts
/// at the same point of space, so that force and moment balance to rounding.
struct PairForce {
  Eigen::Vector3d force, moment;  // on a [N], [N m]
  /// d(force, moment) by d(distance, rotation of a relative to b) and by their rates, 6 x 6.
  Eigen::Matrix<double, 6, 6> by_distance, by_rate;
  double stored = 0.0, lost = 0.0;  // [J], [W]
};

/// Distance [m] and relative rates of two ports, a as seen by an observer who turns with b, in the
/// engine's axes.
struct PairMotion {
  Eigen::Vector3d distance, velocity, spin;
};

/// An element between two ports whose force depends on their relative position, velocity and
/// angular velocity.
class PortElement : public ForceElement {
 public:
  PortElement(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b);

  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage&) override { finished_ = last_; }
  void accept_step(double) override { accepted_ = finished_; }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// `<name>_force_x`, `_y`, `_z` [N] on a, in the engine's axes; spaces of the name are
  /// underscores.
  void record(History& history) const override;

 protected:
  virtual PairForce force(double time, const PairMotion& motion) const = 0;

 private:
  PairMotion move(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;
  std::string name_;
  std::array<std::string, 3> recorded_;  // names of histories
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero(), finished_ = last_, accepted_ = last_;  // [N]
  std::unique_ptr<Port> a_, b_;
  mutable PortState at_a_, at_b_;
  mutable Eigen::VectorXd y_a_, y_b_, v_a_, v_b_;
  Matrix6X distance_by_y_, rate_by_y_, by_a_, by_b_;  // 6 x n_e, of the last tangent
  double time_ = 0.0;
};

/// A spring and damper of the same stiffness in all directions between two points: a spherical
/// joint, or in a plane a revolute joint, with the elasticity of its bearing.
class Bushing : public PortElement {
 public:
  /// @param stiffness [N/m]. @param damping [N s/m].
  Bushing(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b, double stiffness,
          double damping)
      : PortElement(std::move(name), std::move(a), std::move(b)),
        stiffness_(stiffness),
        damping_(damping) {}

 protected:
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  double stiffness_, damping_;
};

/// A spring and damper along the line between two points.
class LineSpring : public PortElement {
 public:
  /// @param stiffness [N/m]. @param damping [N s/m]. @param length without force [m].
  LineSpring(std::string name, std::unique_ptr<Port> a, std::unique_ptr<Port> b, double stiffness,
             double damping, double length)
      : PortElement(std::move(name), std::move(a), std::move(b)),
        stiffness_(stiffness),
        damping_(damping),
        length_(length) {}

 protected:
  PairForce force(double time, const PairMotion& motion) const override;

 private:
  double stiffness_, damping_, length_;
};

}  // namespace clatter::dynamics
