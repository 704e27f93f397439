// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of discs.
#include <vector>

#include "dynamics/bearing/shaft_axes.hpp"
#include "dynamics/body/port.hpp"

namespace clatter::dynamics {

/// A point of a disc with displacement d, small tilt t across the axis w, and large angle a:
///
///   position  c + d + (I + [t x]) A(a) arm
///   spin      t' - w (t' . (t x w)) + a' (w + t x w)
///
/// to first order in tilt. A moment acts on the angle by its component along the tilted axis, and
/// on the tilts by the one across it, so that an axial moment on a tilted disc gives what the
/// angular momentum needs to stay on the axis while the spin changes; power is force . velocity +
/// moment . spin exactly.
class DiscPort : public Port {
 public:
  /// @param coordinates y indices of x, y, z, rx, ry, rz of a disc, or only of its angle: then its
  /// centre is fixed and its axis does not tilt. They may be of several bodies, as of a wheel that
  /// turns on its hub. @param centre of mass at rest [m]. @param arm from there, at the angle 0
  /// [m].
  DiscPort(std::vector<int> coordinates, const ShaftAxes& axes, const Eigen::Vector3d& centre,
           const Eigen::Vector3d& arm);
  void motion(double time, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
              PortState& state) override;
  void add_curvature(const Eigen::VectorXd& y, const Vector6& wrench,
                     Eigen::Ref<Eigen::MatrixXd> tangent) override;

 private:
  bool tilts() const { return size() == 6; }
  /// Index of the large angle among the coordinates.
  int turn() const { return tilts() ? 3 + axes_.axis : 0; }
  Eigen::Matrix3d turned(double angle) const;
  /// The rotations of y without the large one; zero where it does not tilt.
  Eigen::Vector3d tilt(const Eigen::VectorXd& y) const;

  ShaftAxes axes_;
  Eigen::Vector3d centre_, arm_;
};

}  // namespace clatter::dynamics
