// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A disc that rolls and slides on a plane.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/body/spatial_frame.hpp"
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// A plane that carries a disc, and the contact between them.
struct DiscPlane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    // of the plane [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit vector, to the side of the disc
  double stiffness = 0.0;                             // [N/m]
  double damping = 0.0;                               // per depth [N s/m2]
  double friction = 0.0;                              // coefficient of friction
  double slip_speed = 1e-5;  // over which friction reaches 71 % of its limit [m/s]
};

/// Contact of the sharp edge of a disc with a plane at the edge's lowest point, at depth s and with
/// the velocity v of the disc's material there:
///
///   N = s (k + c s'),   F = - mu N v_t / sqrt(v_t^2 + v_s^2)
///
/// Friction below its limit holds the disc: it rolls, and creeps with about v_s F / (mu N). The
/// body is rigid.
class DiscContact : public ForceElement {
 public:
  /// @param coordinates y indices of the ten coordinates of a rigid spatial body, whose centre of
  /// mass is the disc's centre. @param axis of the disc, unit vector in the body's axes.
  /// @param radius [m].
  DiscContact(std::string name, std::vector<int> coordinates,
              std::shared_ptr<const SpatialFrame> frame, const Eigen::Vector3d& axis, double radius,
              const DiscPlane& plane);

  std::string name() const override { return name_; }
  /// StepRefused when the disc lies flat: it then has no lowest point.
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;

 private:
  struct Touch;
  Touch touch(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const;

  std::string name_;
  std::shared_ptr<const SpatialFrame> frame_;
  Eigen::Vector3d axis_;
  double radius_;
  DiscPlane plane_;
  double time_ = 0.0;           // of the last evaluation
  mutable SpatialState state_;  // working memory of touch(), which power() calls too
};

}  // namespace clatter::dynamics
