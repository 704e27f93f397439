// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Strains of a cell's displacement modes: its shape functions and, in a hex8 with them, the three
// incompatible modes 1 - xi_k^2 (element.hpp).
#include <Eigen/Core>

#include "core/fe/cell_points.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::fe {

inline constexpr int kIncompatibleModes = 3;

/// True for a hex8 whose material selects incompatible modes.
bool has_incompatible_modes(mesh::CellType type, const IntegrationChoice& choice);

/// Gradients with respect to x, one row per mode.
using ModeGradient = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, mesh::kMaxCellNodes, 3>;

/// Strains 11 22 33 12 23 31 (engineering shear) due to the modes' displacements, column 3 a + d.
using StrainMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, 3 * mesh::kMaxCellNodes>;

/// J(i, k) = dx_i / dxi_k.
Eigen::Matrix3d jacobian(const mesh::CellNodes& x, const CellPoint& point);

/// Displacement modes of one cell with node coordinates `x` (n x 3 [m]), which must outlive it.
class CellModes {
 public:
  CellModes(const mesh::CellNodes& x, bool incompatible);

  Eigen::Index count() const { return x_.rows() + inner(); }
  Eigen::Index inner() const { return incompatible_ ? kIncompatibleModes : 0; }

  /// Returns det J; row a of `gradient` belongs to mode a, unset where det J <= 0.
  double at(const CellPoint& point, ModeGradient& gradient) const;

 private:
  const mesh::CellNodes& x_;
  bool incompatible_;
  Eigen::Matrix3d centre_inverse_ = Eigen::Matrix3d::Zero();
  double centre_det_ = 0.0;
};

StrainMatrix strain_matrix(const ModeGradient& gradient);

}  // namespace clatter::fe
