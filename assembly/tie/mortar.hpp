// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Dual mortar projection of a slave surface onto a non-matching master surface.
//
// The slave's displacements follow from the weak condition int Phi_j (u_slave - u_master) dA = 0
// with multipliers Phi_j that are dual to the slave's shape functions (Wohlmuth, SIAM J. Numer.
// Anal. 38, 2000): int Phi_j N_k dA = delta_jk int N_j dA on each slave face. So D is diagonal and
//   u_j = sum_k M_jk / D_jj u_k,   D_jj = int N_j dA,  M_jk = int Phi_j N_k^master dA:
// P = D^-1 M has no more entries than M, while standard multipliers would make D^-1 dense.
// Corners of quadratic faces have int N_j dA <= 0; there
//   N^_corner = N_corner + a (sum of N_mid of the adjacent mid-side nodes), N^_mid = (1 - 2 a)
//   N_mid, a = 1/5,
// replaces N (Popp, Wohlmuth, Gee, Wall, SIAM J. Sci. Comput. 34, 2012), and
//   u_corner = u^_corner,  u_mid = a (u^_corner1 + u^_corner2) + (1 - 2 a) u^_mid.
// Integrals extend over the parts of slave facets that master facets cover (Puso and Laursen,
// Comput. Methods Appl. Mech. Engng 193, 2004), D with the same points as M: constants are always
// reproduced, linear fields where both sides lie in one plane; there the patch test is passed.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "assembly/tie/face_geometry.hpp"

namespace clatter::assembly {

/// One slave node as a combination of nodes: coefficients that sum to one.
struct ProjectedNode {
  int32_t node = -1;
  std::map<int32_t, double> on;  // master nodes; also untied corners of a tied mid-side node
  std::vector<int32_t> around;   // these, and the other nodes of their master faces
  double jump = 1.0;  // coefficient of an additional displacement of the slave node (bolt)
};

/// The result of project().
struct Projection {
  std::vector<ProjectedNode> tied;  // by node
  std::vector<int32_t> untied;      // slave nodes that no master covers
  double largest_gap = 0.0;         // [m], between tied facet parts
  double covered = 0.0;             // [m2]
  double slave_area = 0.0;          // [m2]
};

/// Projects `slave` onto `master`; facet parts further apart than `distance` [m], or that do not
/// face one another, are not tied, nor is a face with less than a tenth of its area covered or a
/// node with less than a twentieth of its weight covered.
Projection project(const std::vector<TieFace>& slave, const std::vector<TieFace>& master,
                   double distance);

/// sqrt(area / number) of the faces [m].
double mean_size(const std::vector<TieFace>& faces);

}  // namespace clatter::assembly
