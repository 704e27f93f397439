// SPDX-License-Identifier: GPL-3.0-or-later
// The geometric stiffness of one shell.
#include "core/fe/prestress.hpp"
#include "core/fe/shell_kinematics.hpp"

namespace clatter::fe {
namespace {

/// Forces per width 11 12 21 22, where the sheet has these strains.
Eigen::Matrix2d membrane_force(const ShellStiffness& sheet, const ShellStrains& strains) {
  const double ratio = strains.ratio;
  const Eigen::Vector3d force =
      ratio * sheet.A * strains.membrane + ratio * ratio * sheet.B * strains.curvature;
  Eigen::Matrix2d out;
  out << force(0), force(2), force(2), force(1);
  return out;
}

}  // namespace

ShellMatrix shell_geometric_stiffness(const ShellCell& cell, const Eigen::VectorXd& u,
                                      const Eigen::VectorXd& dT) {
  const MidSurface mid(cell);
  const mesh::FaceRule& rule = mesh::face_rule(cell.type);
  const Eigen::Index n = cell.x.rows();
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
    const Eigen::Vector2d at = rule.points.row(q).transpose();
    const SurfacePoint point(mid, at);
    Eigen::MatrixX2d along(n, 2);  // derivatives of h along r, s
    along << point.h_r.head(n), point.h_s.head(n);
    const Eigen::MatrixX2d gradient = along * point.to_axes.transpose();
    const Eigen::Matrix2d force = membrane_force(cell.stiffness, shell_strains(cell, u, at, dT));
    between += rule.weights(q) * point.area * gradient * force * gradient.transpose();
  }
  // The mid-surface moves as u + theta x (offset V).
  ShellMatrix out = ShellMatrix::Zero(6 * n, 6 * n);
  Eigen::Matrix<double, 3, 6> move_i, move_j;
  move_i.leftCols<3>() = move_j.leftCols<3>() = Eigen::Matrix3d::Identity();
  for (Eigen::Index i = 0; i < n; ++i) {
    move_i.rightCols<3>() = cross_matrix(cell.offset * cell.directors.row(i).transpose());
    for (Eigen::Index j = 0; j < n; ++j) {
      move_j.rightCols<3>() = cross_matrix(cell.offset * cell.directors.row(j).transpose());
      out.block<6, 6>(6 * i, 6 * j) = between(i, j) * move_i.transpose() * move_j;
    }
  }
  return out;
}

}  // namespace clatter::fe
