// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Laws of joints and springs.
#include <memory>
#include <utility>
#include <variant>

#include "dynamics/given/rising_table.hpp"
#include "dynamics/law/pair_law.hpp"
#include "dynamics/law/radial_table.hpp"

namespace clatter::dynamics {

/// The same in all directions: force -F(e) n - c(e) d' with the distance d, e = |d|, n = d / e. A
/// spherical joint, in a plane a revolute one, with the elasticity of its bearing.
class RadialJoint : public PairLaw {
 public:
  explicit RadialJoint(RadialForce law) : law_(std::move(law)) {}
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;

 private:
  RadialForce law_;
};

/// A RadialJoint of constant @param stiffness [N/m] and @param damping [N s/m].
std::unique_ptr<PairLaw> linear_joint(double stiffness, double damping);

/// A spring and damper along the line between two points.
class LineSpring : public PairLaw {
 public:
  /// @param stiffness [N/m]. @param damping [N s/m]. @param length without force [m].
  LineSpring(double stiffness, double damping, double length)
      : stiffness_(stiffness), damping_(damping), length_(length) {}
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;

 private:
  double stiffness_, damping_, length_;
};

/// The moment of dry friction over the load N of a joint.
struct PinFriction {
  /// Moment over load [m], coefficient times radius of the pin (Coulomb), or a table of moment
  /// [N m] over load [N].
  std::variant<double, RisingTable> moment = 0.0;
  double reversal_speed = 0.5;  // w_0 of the smoothed sign w / sqrt(w^2 + w_0^2) [rad/s]
};

/// A joint with a moment of friction about its pin,
///
///   M = -M_f(N) w / sqrt(w^2 + w_0^2),   N = |F|
///
/// by the relative spin w and the force F of the joint without friction. Its power -M w is lost.
class FrictionJoint : public PairLaw {
 public:
  /// @param joint without moment. @param axis of the pin: 0, 1, 2 for x, y, z.
  FrictionJoint(std::unique_ptr<PairLaw> joint, PinFriction friction, int axis)
      : joint_(std::move(joint)), friction_(std::move(friction)), axis_(axis) {}
  PairForce force(const Stage& stage, const PairMotion& motion, bool with_derivatives) override;

 private:
  std::unique_ptr<PairLaw> joint_;
  PinFriction friction_;
  int axis_;
};

}  // namespace clatter::dynamics
