// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The shapes of the interior with the boundary held.
#include "condense/basis/mode_request.hpp"
#include "condense/basis/partitioned_model.hpp"
#include "core/base/stopwatch.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::condense {

/// The shapes X: X^T M_ii X = I, X^T K_ii X = diag((2 pi hz)^2).
struct InteriorModes {
  Eigen::MatrixXd vectors;      // n_i x k: modes, load shapes
  Eigen::VectorXd hz;           // k; of fixed-interface modes their frequencies
  int load_shapes = 0;          // the last columns
  int own_modes = 0;            // elastic modes of the body itself that the basis holds exactly
  int dropped = 0;              // shapes that depended on others
  Eigen::VectorXd residuals;    // of the eigenpairs
  double frequency_error = -1;  // of AMLS: the largest, relative, estimated; else negative
  sparse::CountProof proof;     // of their number
  double cutoff_hz = 0.0;       // all modes below it are present, within the known errors
  double accurate_to_hz = 0.0;  // limit of the body's own frequencies
};

/// Shapes of the interior by `request`.
///
/// Fixed-interface modes (Craig and Bampton 1968): K_ii Phi = M_ii Phi Lambda; accurate_to_hz is
/// half the cut-off. Without modes the cut-off is the first of them.
///
/// Own modes (MacNeal 1971; Rubin 1975; Craig and Chang 1977): the modes K phi = lambda M phi of
/// the body on its supports, or free, with the residual flexibility of the boundary (of a free body
/// by inertia relief). Both together span what [I; Psi_ib] and the columns
///   K_ii^{-1} (M phi)_i = (phi_i - Psi_ib phi_b) / lambda,    K_ii^{-1} (M r)_i
/// span, r the free rigid motions: a mode is a boundary displacement and the response to its own
/// inertia, and inertia relief loads the body with M r. So the first coordinates stay boundary
/// displacements, and each kept mode is exact. accurate_to_hz is the cut-off.
///
/// Load shapes: K_ii^{-1} f_i, the response with the boundary held, so that static responses to the
/// load are exact everywhere.
///
/// @param factor_ii of K_ii. InputError for an unknown load and one that prescribes displacements;
/// NumericsError as solve_modes. Dropped shapes are reported by name. Steps go to `clock`.
InteriorModes interior_modes(const PartitionedModel& part, const sparse::Factor& factor_ii,
                             const ModeRequest& request, StepClock& clock);

}  // namespace clatter::condense
