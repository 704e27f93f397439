// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of bodies that move freely in space.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "dynamics/body/port.hpp"
#include "dynamics/body/spatial_frame.hpp"

namespace clatter::dynamics {

/// A point of a spatial body, rigid or elastic.
class SpatialPort : public Port {
 public:
  /// @param coordinates y indices of the body's 10 + n coordinates. @param arm from the centre of
  /// mass without deformation, in the body's axes [m]. @param shape displacement, and @param slope
  /// rotation of the point by the modes, 3 x n; empty: none.
  SpatialPort(std::vector<int> coordinates, std::shared_ptr<const SpatialFrame> frame,
              const Eigen::Vector3d& arm, Matrix3X shape = {}, Matrix3X slope = {});
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  std::shared_ptr<const SpatialFrame> frame_;
  Eigen::Vector3d arm_;
  Matrix3X shape_, slope_;
  SpatialState at_;      // of the last motion()
  Eigen::Vector3d out_;  // there: from the centre of mass, in the engine's axes
};

}  // namespace clatter::dynamics
