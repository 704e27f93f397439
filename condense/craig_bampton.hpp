#pragma once
// The Craig-Bampton basis: constraint modes and fixed-interface modes from one factorisation.
#include <string>

#include "condense/residual_modes.hpp"
#include "core/stopwatch.hpp"
#include "modal/eigen/eigen_solver.hpp"

namespace clatter::condense {

/// How many fixed-interface modes: exactly one of count and fmax_hz is positive; none for Guyan.
struct ModeRequest {
  int count = 0;
  double fmax_hz = 0.0;
  bool prove_count = true;
  double frequency_error = 5e-4;  // aimed at by residual modes below half the cut-off; 0: none
  modal::EigenMethod method = modal::EigenMethod::kBlockLanczos;
};

/// The basis V = [I 0; Psi_ib Phi_ik] and its matrices, with what was proved on the way.
struct CraigBampton : Reduction {
  Eigen::VectorXd fixed_interface_hz;  // of the kept modes, residual modes after them
  Eigen::VectorXd residuals;           // of the kept modes
  ResidualReport residual;
  double cutoff_hz = 0.0;  // all fixed-interface modes below it are kept
  modal::CountProof proof;
  modal::FactorReport factor;
  double rigid_error = 0.0;  // |Psi r_b - r_i| / |r_i| of the plain solve
};

/// Basis of Craig and Bampton (1968): Psi_ib = -K_ii^{-1} K_ib, K_ii Phi = M_ii Phi Lambda. One
/// factorisation of K_ii serves both. Without modes (`request` empty) it is Guyan's (1965), and the
/// cut-off is the first fixed-interface frequency, from where on the basis holds nothing.
/// @param K, M blocks of the model's matrices by `partition`. Steps go to `clock`.
/// Throws InputError when the boundary does not hold the body, NumericsError as solve_modes does.
CraigBampton craig_bampton(const assembly::FeModel& model, const DofPartition& partition,
                           const PartitionedMatrix& K, const PartitionedMatrix& M,
                           const ModeRequest& request, StepClock& clock);

}  // namespace clatter::condense
