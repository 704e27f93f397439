// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inertia of an elastic body whose frame moves as prescribed.
#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/rom/inertia_invariants.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/given/drive.hpp"

namespace clatter::dynamics {

/// The motion of a frame that a drive turns, for MovingFrame. @param axis unit vector in the
/// frame's axes, about which it turns. @param arm from a point of the axis to the frame's origin,
/// in the frame's axes [m].
std::function<rom::FrameMotion(double)> turning_frame(const Drive& drive,
                                                      const Eigen::Vector3d& axis,
                                                      const Eigen::Vector3d& arm);

/// p* of eq. (9) of the paper on the modal coordinates of a body in a frame that moves as
/// `motion(t)` says (in the frame's axes):
///
///   p* = load(t) - C(t) eta - G(t) eta'
///
/// Its work is energy that the frame's drive puts in. Stresses of the rotation do not stiffen the
/// body: terms of the first order in displacements only (Shabana, section 5.3).
class MovingFrame : public ForceElement {
 public:
  /// @param coordinates y indices of all modal coordinates of the body. @param invariants in these
  /// coordinates.
  MovingFrame(std::string body, std::vector<int> coordinates, rom::InertiaInvariants invariants,
              std::function<rom::FrameMotion(double)> motion);

  std::string name() const override { return body_ + " frame"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  std::string body_;
  rom::InertiaInvariants invariants_;
  std::function<rom::FrameMotion(double)> motion_;
  double time_ = 0.0;
  Eigen::VectorXd load_;  // of the last time
  Eigen::MatrixXd softening_, gyroscopic_;
};

}  // namespace clatter::dynamics
