// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/rigid_mass.hpp"

#include <Eigen/Geometry>

namespace clatter::rom {

Eigen::MatrixXd rigid_about(const Eigen::MatrixXd& rigid, const Eigen::Vector3d& point) {
  Eigen::MatrixXd out = rigid;
  for (Eigen::Index j = 0; j < 3; ++j)
    out.col(3 + j) -= rigid.leftCols<3>() * Eigen::Vector3d(Eigen::Vector3d::Unit(j).cross(point));
  return out;
}

MassProperties properties_of(const Eigen::MatrixXd& rigid_mass, const Eigen::Vector3d& point) {
  MassProperties out;
  out.mass = rigid_mass.topLeftCorner<3, 3>().trace() / 3.0;
  // Column j is the momentum m e_j x c of a unit rotation about axis j.
  const Eigen::Matrix3d S = rigid_mass.topRightCorner<3, 3>();
  const Eigen::Vector3d c =
      0.5 / out.mass * Eigen::Vector3d(S(1, 2) - S(2, 1), S(2, 0) - S(0, 2), S(0, 1) - S(1, 0));
  out.centre = point + c;
  out.inertia = rigid_mass.bottomRightCorner<3, 3>() -
                out.mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
  return out;
}

}  // namespace clatter::rom
