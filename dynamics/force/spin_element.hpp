// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Rotation of a rigid body in space.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/force/element.hpp"

namespace clatter::dynamics {

/// Rates of the seven states of a spatial body (rigid_body.hpp): quaternion q = (w, x, y, z) and
/// angular velocity w in the body's principal axes,
///
///   q' = 1/2 q * (0, w),     J w' = - w x J w      (Euler's equations; moments are added by
///   others)
///
/// Its stored energy is that of the rotation, 1/2 w^T J w.
class SpinElement : public ForceElement {
 public:
  /// @param coordinates y indices of q and w, 7. @param inertia principal moments J [kg m2].
  SpinElement(std::string body, std::vector<int> coordinates, const Eigen::Vector3d& inertia);

  std::string name() const override { return body_ + " rotation"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  std::string body_;
  Eigen::Vector3d inertia_;
};

}  // namespace clatter::dynamics
