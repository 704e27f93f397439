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

MassError compare_mass(const rom::MassProperties& found, const rom::MassProperties& expected);

/// Removes from K_rr the spurious stiffness by rounding against the free motions r, K_rr <- P^T
/// K_rr P with P = I - r (r^T M_rr r)^{-1} r^T M_rr, so that K_rr r = 0. Couplings with many nodes
/// have entries in K up to 1e6 times those of K_rr, and rounding grows with them. Returns |K_rr r|
/// / (|K_rr| |r|) before the change; 0 where nothing but the motions is left.
/// @param r the free motions in reduced coordinates, size x m.
double clear_rigid_stiffness(rom::ReducedModel& reduced, const Eigen::MatrixXd& r);

/// Fills `reduced.certificate` (core/rom/reduced_certificate.hpp) except for what record(),
/// verify() and add_rows() add; rigid_stiffness_residue by clear_rigid_stiffness, which it calls.
/// `spectrum` false omits the costly part, the spectrum of (K_rr, M_rr): no rigid_modes,
/// first_elastic_hz, max_frequency_hz, condition_M_rr. Only a free body has mass_error and
/// mass_error_elements, only a model with inertia invariants inertia_invariants_error
/// (frame_inertia.hpp), only AMLS eigen_frequency_error. accurate_to_hz is half of cutoff_hz, with
/// own modes all of it; residual modes help the body's own modes alone, so that
/// frequency_error_joined is the accuracy of a body joined to others (absent with own modes).
/// @param motions the free rigid motions in reduced coordinates, r x m.
/// Throws NumericsError when the reduction did not preserve the rigid motions or the mass.
void certify(rom::ReducedModel& reduced, const PartitionedModel& part, const CraigBampton& source,
             const Eigen::MatrixXd& motions, bool spectrum);

}  // namespace clatter::condense
