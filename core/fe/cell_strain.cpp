// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/cell_strain.hpp"

#include <Eigen/LU>

namespace clatter::fe {

using mesh::CellNodes;
using mesh::CellType;

bool has_incompatible_modes(CellType type, const IntegrationChoice& choice) {
  return type == CellType::kHex8 && choice.hex8 == Integration::kIncompatible;
}

Eigen::Matrix3d jacobian(const CellNodes& x, const CellPoint& point) {
  return x.transpose() * point.shape.gradient;
}

CellModes::CellModes(const CellNodes& x, bool incompatible) : x_(x), incompatible_(incompatible) {
  if (!incompatible) return;
  const Eigen::Matrix3d J =
      x.transpose() * mesh::cell_shape(CellType::kHex8, Eigen::Vector3d::Zero()).gradient;
  centre_inverse_ = J.inverse();
  centre_det_ = J.determinant();
}

double CellModes::at(const CellPoint& point, ModeGradient& gradient) const {
  const Eigen::Matrix3d J = jacobian(x_, point);
  const double det = J.determinant();
  if (!(det > 0.0)) return det;
  gradient.resize(count(), 3);
  gradient.topRows(x_.rows()).noalias() = point.shape.gradient * J.inverse();
  for (Eigen::Index k = 0; k < inner(); ++k)
    gradient.row(x_.rows() + k) = (-2.0 * point.xi(k) * centre_det_ / det) * centre_inverse_.row(k);
  return det;
}

StrainMatrix strain_matrix(const ModeGradient& g) {
  StrainMatrix B = StrainMatrix::Zero(6, 3 * g.rows());
  for (Eigen::Index a = 0; a < g.rows(); ++a) {
    for (int d = 0; d < 3; ++d) {
      const int next = (d + 1) % 3;
      B(d, 3 * a + d) = g(a, d);
      B(3 + d, 3 * a + d) = g(a, next);
      B(3 + d, 3 * a + next) = g(a, d);
    }
  }
  return B;
}

}  // namespace clatter::fe
