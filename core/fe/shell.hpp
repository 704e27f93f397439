// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stiffness and mass of a cell of a shell, six DoFs a node, by one kinematics for triangles and
// quadrilaterals:
//   X = sum h_i (x_i + z V_i),   u = sum h_i (u_i + z theta_i x V_i),   -t/2 <= z <= t/2
// V_i: director of node i in this cell (shell_directors.hpp). A rigid motion has no strain, on a
// warped cell too.
//
//   tri3   MITC3+: constant membrane strain, shear tied at points, rotations with a bubble
//          (Lee, Lee and Bathe 2014)
//   quad4  MITC4+: shear tied at the sides (Dvorkin and Bathe 1984), the membrane free of what a
//          warped cell adds (Ko, Lee and Bathe 2017), four enhanced membrane strains (Simo and
//          Rifai 1990)
//   tri6   the membrane of MITC6 (Lee and Bathe 2004), the bending of MITC7, whose rotations have a
//          bubble (Bathe, Brezzi and Cho 1989)
//   quad8  MITC9: strains tied at points (Bucalem and Bathe 1993); the ninth node, at the centre,
//          moves beside the others as its equilibrium asks
#include <Eigen/Core>

#include "core/fe/shell_section.hpp"
#include "core/mesh/cell.hpp"

namespace clatter::fe {

inline constexpr int kShellNodes = mesh::kMaxFaceNodes, kShellDofs = 6 * kShellNodes;  // at most

using ShellNodes = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kShellNodes, 3>;
using ShellMatrix =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kShellDofs, kShellDofs>;

struct ShellCell {
  mesh::FaceType type = mesh::FaceType::kQuad4;
  ShellNodes x;                                    // n x 3 [m]
  ShellNodes directors;                            // n x 3, unit
  ShellStiffness stiffness;                        // at `thickness`
  double thickness = 0.0;                          // [m]
  Eigen::VectorXd ratio;                           // of the thickness at each node to it; empty: 1
  double offset = 0.0;                             // along V_i to the mid-surface [m]
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // of direction 1, projected; the first side
                                                   // where this is 0 or along the normal
};

/// Rows and columns: x y z rx ry rz of each node, in the global axes.
struct ShellMatrices {
  ShellMatrix stiffness;  // 6n x 6n [N/m, N, N m]
  ShellMatrix mass;       // 6n x 6n [kg, kg m, kg m2]
};

/// The mid-surface has the nodes x_i + offset V_i, which move as u_i + theta_i x (offset V_i).
/// Where the sheet is `ratio` as thick, A, S and the mass of the material have this factor, B and
/// the moment of the mass its square, D and the rotary inertia its cube. The mass is consistent,
/// with the rotary inertia of theta x V: none about V; the centre of a quad8 has its share, else
/// thin curved sheet would be too soft by several per cent. kHrz: it is lumped at the nodes and at
/// the centre of a quad8, which moves with all of them: other cells have 6 x 6 blocks alone.
/// @return false where the cell is no shell: concave, folded (to a triangle, or a director more
/// than 60 degrees off the normal), without area, or not finite.
bool compute_shell(const ShellCell& cell, MassForm form, ShellMatrices& out);

/// Generalised strains at a point of the cell, in its axes (columns: 1, 2, normal).
struct ShellStrains {
  Eigen::Vector3d membrane, curvature;  // 11, 22, 12 (engineering) [1], [1/m]
  Eigen::Vector2d shear;                // 13, 23
  Eigen::Matrix3d axes;
  double ratio = 1.0;  // of the thickness there
  double rise = 0.0;   // of the temperature there [K]
};

/// Those beside a free sheet's, of displacements `u` (6n), also of what the cell has beside its
/// nodes.
/// @param at r, s of the reference cell: -1 to 1 of quadrilaterals; 0 to 1 of triangles.
/// @param dT of shell_thermal_force(), or empty.
ShellStrains shell_strains(const ShellCell& cell, const Eigen::VectorXd& u,
                           const Eigen::Vector2d& at, const Eigen::VectorXd& dT = {});

/// Nodal forces (6n) of thermal strains with all nodes fixed: int B^T C (sum h_i dT_i) (a B x + r)
/// dA. B x are the strains of nodes that move by their positions: 1 1 0 of the membrane of a flat
/// cell. With the same in a warped cell, or one beside its nodes, free expansion causes no stress.
/// a is the mean stretch of a free sheet per kelvin, r the rest of its strains: 0 of an isotropic
/// material.
/// @param dT temperature rise of each node (n) [K], uniform through the thickness.
Eigen::VectorXd shell_thermal_force(const ShellCell& cell, const Eigen::VectorXd& dT);

}  // namespace clatter::fe
