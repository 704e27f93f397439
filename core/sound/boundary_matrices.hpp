// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The boundary integral equation of the exterior Neumann problem as matrices.
#include <Eigen/Core>

#include "core/sound/space.hpp"
#include "core/sound/surface.hpp"

namespace clatter::sound {

/// A p = B dp/dn with the combination of Burton and Miller 1971, in Galerkin's form:
///
///   A = 1/2 M - D + alpha W,   B = -( S + alpha (1/2 M' + D') )   alpha = -i / k
///
/// S, D, D' are the single layer, the double layer and its adjoint, W is the negative normal
/// derivative of the double layer, integrated by parts (Maue 1949, Nedelec 1982):
///
///   W_ij = int int G ( n x grad N_i . n x grad N_j - k^2 n(x) . n(y) N_i N_j ) dS dS
///
/// Both p and dp/dn are linear on each face; p is continuous, dp/dn has values of its own at the
/// corners of each face: column 3 f + b of B belongs to corner b of face f. M and M' hold the
/// integrals of N_i N_j.
struct BoundaryMatrices {
  Eigen::MatrixXcd A_transposed;  // n_v x n_v [m2]
  Eigen::MatrixXcd B_transposed;  // 3 n_f x n_v [m3]
};

/// Integrates the matrices at wavenumber k [1/m] > 0, with all threads; the result is independent
/// of their number. Memory: 16 n_v (n_v + 3 n_f) bytes.
/// @throws InputError when the surface is not above the ground plane
/// @throws NumericsError when the memory limit leaves too little
BoundaryMatrices boundary_matrices(const Surface& surface, const Space& space, double k,
                                   Complex alpha);

/// alpha = -i / k, which makes the solution unique at every frequency (Burton and Miller 1971) with
/// the smallest condition number (Marburg 2016 has the sign). Below k = 1 / radius of the surface,
/// where no irregular frequency is, -i k radius^2: W would add its reactive errors to the resistive
/// pressure, which is small there.
Complex burton_miller_coupling(const Surface& surface, double k);

}  // namespace clatter::sound
