// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Stiffness, consistent mass and thermal forces of an isoparametric cell.
//
//   K_e = int B^T C B dV,   m_ab = rho int N_a N_b dV,   M_e = m (x) I_3      (eq. 7 of the paper)
//
// Quadrature points, "full" unless the material's IntegrationChoice selects otherwise:
//
//   cell       K full                K reduced   M            K exact for
//   tet4       1                                 closed form  any cell
//   tet10      4 straight, 14 curved             closed, 64   straight cells
//   hex8       2 x 2 x 2                         3 x 3 x 3    parallelepipeds
//   hex20      3 x 3 x 3             2 x 2 x 2   4, 5 cubed   parallelepipeds
//   wedge6     3 x 2                 1 x 2       6 x 3        prisms
//   wedge15    6 x 3                 3 x 3       25 x 5       prisms
//   pyramid5   2 x 2 x 2                         3 x 3 x 3    parallelogram bases
//   pyramid13  3, curved 4 cubed                 5 x 5 x 5    parallelogram bases
//
// "fine" is 3 x 3 x 3 points for hex8 and 6 x 3 for wedge6: Nastran's IN = THREE with ISOP = FULL.
//
// M is exact for any cell. Every full rule integrates dN/dx det J exactly, so that the linear patch
// test also passes on distorted and curved cells; this needs 14 points on a curved tet10, where 4
// are common. Reduced wedges and hexahedra are C3D6, C3D15 and C3D20R of Abaqus and CalculiX.
//
// hex8 with incompatible modes: three internal displacement modes 1 - xi_k^2 allow bending without
// shear locking; they are condensed out of K_e (Wilson, Taylor, Doherty, Ghaboussi 1973), with
// gradients at the centre, scaled by det J_0 / det J, so that their mean strain is zero and the
// patch test passes (Taylor, Beresford, Wilson, Int. J. Numer. Meth. Engng 10, 1976).
#include <Eigen/Core>

#include "core/fe/material.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::fe {

/// Matrices of a cell of n nodes; node-major DoFs (3 a + d).
struct ElementMatrices {
  Eigen::MatrixXd stiffness;  // 3n x 3n [N/m], symmetric, both triangles filled
  Eigen::MatrixXd mass;       // n x n [kg], the same for x, y, z
  double min_jacobian = 0.0;  // smallest det J found; <= 0: inverted cell
};

/// True when every mid-side node lies at the midpoint of its edge (to 1e-10 of the edge length);
/// always true for linear cells.
bool is_straight(mesh::CellType type, const mesh::CellNodes& x);

/// K_e and m of one cell with node coordinates `x` (n x 3 [m], order of cell.hpp). The values are
/// invalid where min_jacobian <= 0.
void compute_element(mesh::CellType type, const mesh::CellNodes& x, const Material& material,
                     ElementMatrices& out);

/// Nodal forces (3n) of a temperature rise `dT` (n) [K] with all displacements fixed:
/// int B^T C alpha dT dV [N], dT interpolated by the shape functions (as in CalculiX).
Eigen::VectorXd thermal_force(mesh::CellType type, const mesh::CellNodes& x,
                              const Material& material, const Eigen::VectorXd& dT);

/// Displacements `u` (3n) [m] of a cell, followed by those of its incompatible modes (3 x 3), if
/// any: K_aa a = f_a(dT) - K_au u. `dT` (n) [K], or empty.
Eigen::VectorXd with_inner_modes(mesh::CellType type, const mesh::CellNodes& x,
                                 const Material& material, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& dT);

/// The consistent mass `m` lumped to its diagonal with the same total (Hinton, Rock, Zienkiewicz,
/// Earthq. Eng. Struct. Dyn. 4, 1976): positive for every cell, unlike row sums.
void lump_hrz(Eigen::MatrixXd& m);

}  // namespace clatter::fe
