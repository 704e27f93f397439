// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Verifies a reduced model and records the results.
#include <map>
#include <string>

#include "condense/basis/craig_bampton.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// The largest relative differences of the ten mass properties.
struct MassError {
  double mass = 0.0;
  double centre = 0.0;   // over the body's radius of gyration
  double inertia = 0.0;  // over the largest principal moment
  double largest() const { return std::max({mass, centre, inertia}); }
};

/// Ten mass properties from a 6 x 6 rigid mass matrix r^T M r about the origin.
rom::MassProperties mass_properties_of(const Eigen::MatrixXd& rigid_mass);
MassError compare_mass(const rom::MassProperties& found, const rom::MassProperties& expected);

/// Removes from K_rr the spurious stiffness by rounding against the free motions r, K_rr <- P^T
/// K_rr P with P = I - r (r^T M_rr r)^{-1} r^T M_rr, so that K_rr r = 0. Couplings with many nodes
/// have entries in K up to 1e6 times those of K_rr, and rounding grows with them. Returns |K_rr r|
/// / (|K_rr| |r|) before the change.
/// @param r the free motions in reduced coordinates, size x m.
double clear_rigid_stiffness(rom::ReducedModel& reduced, const Eigen::MatrixXd& r);

/// The free rigid motions of a reduced model.
struct ReducedMotions {
  Eigen::MatrixXd q;      // r x m
  bool all_free = false;  // all six of each body
};

/// Fills `reduced.certificate`: certified, 1 with the spectrum of (K_rr, M_rr), 0 when that costly
/// part is omitted (`spectrum` false: no rigid_modes, first_elastic_hz, max_frequency_hz,
/// condition_M_rr);
/// rigid_stiffness_residue of clear_rigid_stiffness, which it calls; rigid_modes, the free motions
/// and other zero eigenvalues of (K_rr, M_rr), to rounding; first_elastic_hz, the lowest other one;
/// for a free body mass_error (against r^T M r of the FE matrices) and mass_error_elements (against
/// the sum over the elements); condition_M_rr of M_rr with unit diagonal; max_frequency_hz;
/// eigen_residual_max; eigen_frequency_error, the largest estimated relative error of a mode's
/// frequency (AMLS only); modal_mass_error; count_proved, count_below and count_limit_hz;
/// fixed_interface_modes, own_modes, load_shapes; cutoff_hz, accurate_to_hz (half of it, with own
/// modes all of it) and frequency_error_estimate, the largest estimated relative error of the
/// body's own modes below accurate_to_hz, frequency_error_joined, the same without the residual
/// modes, which help the body's own modes alone: the accuracy of a body joined to others (absent
/// with own modes), and frequency_error_modes, the number of modes in both estimates;
/// residual_modes; inertia_invariants_error of frame_inertia.hpp when the model has them;
/// rigid_shape_error of the plain solve; dropped_vectors; K_ii_rcond, K_ii_probe_residual. Throws
/// NumericsError when the reduction did not preserve the rigid motions or the mass.
void certify(rom::ReducedModel& reduced, const fe::FeModel& model, const CraigBampton& source,
             const ReducedMotions& free, int dropped, bool spectrum);

}  // namespace clatter::condense
