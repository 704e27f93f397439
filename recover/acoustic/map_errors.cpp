// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/acoustic/map_errors.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace clatter::recover {
namespace {

using Rigid = Eigen::Matrix<double, 3, 6>;

/// Displacements of a point by the motions x, y, z and turns about `middle` by 1 / radius.
Rigid rigid_motions(const sound::Surface& acoustic, const Eigen::Vector3d& point) {
  const Eigen::Vector3d arm = (point - acoustic.middle) / acoustic.radius;
  Rigid u;
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(d);
    u.col(d) = axis;
    u.col(3 + d) = axis.cross(arm);
  }
  return u;
}

}  // namespace

MapErrors map_errors(const rom::Skin& skin, const sound::Surface& acoustic, const VelocityMap& map,
                     const ExposedFlux& flux) {
  Eigen::MatrixXd nodal(3 * skin.nodes.rows(), 6);
  for (Eigen::Index n = 0; n < skin.nodes.rows(); ++n)
    nodal.middleRows(3 * n, 3) = rigid_motions(acoustic, skin.nodes.row(n));
  const Eigen::MatrixXd mapped = map.map * nodal;
  std::vector<char> is_lid(static_cast<size_t>(acoustic.face_count()), 0);
  for (int32_t lid : map.lids) is_lid[lid] = 1;
  double difference = 0.0, size = 0.0;
  Eigen::RowVectorXd through = Eigen::RowVectorXd::Zero(6);
  for (Eigen::Index c = 0; c < acoustic.face_count(); ++c) {
    const auto corners = mapped.middleRows(3 * c, 3);
    const Eigen::RowVectorXd mean = corners.colwise().mean();
    through += acoustic.face_area[c] * mean;
    if (is_lid[c]) continue;
    const Eigen::RowVectorXd exact =
        acoustic.face_normal.row(c) * rigid_motions(acoustic, acoustic.face_centre.row(c));
    difference += acoustic.face_area[c] * (mean - exact).squaredNorm();
    size += acoustic.face_area[c] * exact.squaredNorm();
  }
  const Eigen::RowVectorXd out = flux.sum.transpose() * nodal;
  // A flat sheet has no flux in its plane.
  constexpr double kLeast = 1e-3;
  Eigen::RowVectorXd magnitude = flux.amount.transpose() * nodal.cwiseAbs();
  magnitude = magnitude.cwiseMax(kLeast * magnitude.maxCoeff()).eval();
  return {.flux = (through - out).cwiseAbs().cwiseQuotient(magnitude).maxCoeff(),
          .velocity = size > 0.0 ? std::sqrt(difference / size) : 0.0};
}

}  // namespace clatter::recover
