// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Friction in the pin joints of the rod.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/force/joint.hpp"
#include "dynamics/given/rising_table.hpp"

namespace clatter::dynamics {

/// Rotation of one side of a joint about x: a coordinate, and what is prescribed besides it.
struct JointSide {
  std::optional<int> coordinate;          // y index [rad]; none: it only turns as prescribed
  std::function<double(double)> turning;  // prescribed angular velocity over time [rad/s]; empty: 0
};

/// Where the coordinate of `side` is among `coordinates`, to which it is appended when it is not
/// one of them; -1: the side has none.
int place_of(const JointSide& side, std::vector<int>& coordinates);
/// What is prescribed of it [rad/s].
inline double turning_at(const JointSide& side, double time) {
  return side.turning ? side.turning(time) : 0.0;
}

/// The moment of dry friction over the load N of a joint.
struct PinFriction {
  /// Moment over load [m], coefficient times radius of the pin (Coulomb), or a table of moment
  /// [N m] over load [N].
  std::variant<double, RisingTable> moment = 0.0;
  double reversal_speed = 0.5;  // w_0 of the smoothed sign w / sqrt(w^2 + w_0^2) [rad/s]
};

/// A joint with a moment of friction on A, the opposite on B:
///
///   M = -M_f(N) w / sqrt(w^2 + w_0^2),   N = |F|,   w = w_A - w_B
///
/// F is the force of the joint without friction. Its power -M w is lost; what the prescribed
/// rotations do on M is input.
class FrictionJoint : public Joint {
 public:
  FrictionJoint(std::string name, std::unique_ptr<Anchor> a, std::unique_ptr<Anchor> b,
                const RadialForce& law, PinFriction friction, JointSide side_a, JointSide side_b);

  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  void finish_stage(const Stage& stage) override;
  void accept_step(double time) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// Also `<name>_friction_moment` [N m] on A and `<name>_friction_power` [W], lost.
  void record(History& history) const override;

 private:
  struct Turning {
    double moment = 0.0, spin = 0.0,
           prescribed = 0.0;  // on A [N m]; w, its prescribed part [rad/s]
    double lost() const { return -moment * spin; }
  };
  PinFriction friction_;
  JointSide side_a_, side_b_;
  Eigen::VectorXd turn_;  // dw/dv, n_e
  Eigen::VectorXd load_by_y_;
  Eigen::Index planar_;  // coordinates of the joint without friction, the first ones
  mutable Eigen::VectorXd planar_y_, planar_v_;
  Response plain_;
  Turning last_turning_, finished_turning_, accepted_turning_;
};

}  // namespace clatter::dynamics
