#pragma once
// Stiffness and consistent mass of one isoparametric tetrahedron.
//
//   K_e = int B^T C B dV,   m_ab = rho int N_a N_b dV,   M_e = m (x) I_3      (eq. 7 of the paper)
//
// Points. tet4: one for K, exact mass in closed form. Straight tet10: four for K (strain linear:
// exact), the mass is det J times a constant matrix (exact). Curved tet10: the integrand of K is
// rational; fourteen points of degree 5 integrate dN/dx det J (degree 3) exactly, so that the
// linear patch test holds on curved cells too, which four points do not give; the mass takes
// sixty-four points of degree 7 and is exact.
#include <Eigen/Core>

#include "assembly/material.hpp"

namespace clatter::assembly {

/// Nodes of a cell, one row a node [m]; N = 4 or 10.
template <int N>
using CellNodes = Eigen::Matrix<double, N, 3>;

/// The matrices of one cell; node-major DoFs (3 a + d).
template <int N>
struct ElementMatrices {
  Eigen::Matrix<double, 3 * N, 3 * N> stiffness;  // [N/m], symmetric, both triangles filled
  Eigen::Matrix<double, N, N> mass;               // [kg], scalar: the same for x, y, z
  double min_jacobian = 0.0;                      // smallest det J met [m3]; <= 0: inverted cell
};

/// True when every middle node lies in the middle of its edge (to 1e-10 of the edge length);
/// always true for N = 4.
template <int N>
bool is_straight(const CellNodes<N>& x);

/// K_e and m of one cell. The values mean nothing where min_jacobian <= 0: check it.
template <int N>
void compute_element(const CellNodes<N>& x, const Material& material, ElementMatrices<N>& out);

extern template bool is_straight<4>(const CellNodes<4>&);
extern template bool is_straight<10>(const CellNodes<10>&);
extern template void compute_element<4>(const CellNodes<4>&, const Material&, ElementMatrices<4>&);
extern template void compute_element<10>(const CellNodes<10>&, const Material&,
                                         ElementMatrices<10>&);

}  // namespace clatter::assembly
