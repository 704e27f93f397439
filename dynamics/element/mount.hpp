// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Linear springs and dampers between single coordinates and the ground.
#include "dynamics/element/element.hpp"

namespace clatter::dynamics {

/// One spring-damper: f = -k y - c v on its coordinate.
struct GroundSpring {
  int coordinate;    // in the system's y
  double stiffness;  // [N/m] or [N m/rad]
  double damping;    // [N s/m] or [N m s/rad]
};

/// Engine mounts, and guides that hold a body where the model has no other support.
class Mount : public ForceElement {
 public:
  Mount(std::string name, const std::vector<GroundSpring>& springs);
  std::string name() const override { return name_; }
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool with_tangent, Response& response) override;
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd& v) const override;
  /// By coordinate.
  const Eigen::VectorXd& stiffness() const { return stiffness_; }
  const Eigen::VectorXd& damping() const { return damping_; }

 private:
  std::string name_;
  Eigen::VectorXd stiffness_, damping_;
};

}  // namespace clatter::dynamics
