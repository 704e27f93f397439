// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of a reduced model.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::rom {

/// The certificate of a reduced model. fields() has the unit and meaning of each member, which are
/// named as in the file; one without a value does not apply or was not determined. All are absent
/// for a model of another program.
struct ReducedCertificate {
  std::optional<double> certified;
  // Rigid motions and mass.
  std::optional<double> rigid_modes, rigid_stiffness_residue, rigid_shape_error;
  std::optional<double> mass_error, mass_error_elements, inertia_invariants_error;
  // Modes of the basis.
  std::optional<double> fixed_interface_modes, own_modes, load_shapes, residual_modes;
  std::optional<double> eigen_residual_max, eigen_frequency_error, modal_mass_error;
  std::optional<double> dropped_vectors, count_proved, count_below, count_limit_hz;
  // Accuracy.
  std::optional<double> cutoff_hz, accurate_to_hz, frequency_error_estimate;
  std::optional<double> frequency_error_joined, frequency_error_modes, frequency_error_parts;
  std::optional<double> frequency_error_target, frequency_error_bound, rows_added_error;
  std::optional<double> cutoffs_tried, verified_to_hz, verified_modes;
  std::optional<double> verified_frequency_error, verified_mac;
  // Interface modes.
  std::optional<double> interface_coordinates, interface_modes, interface_cutoff_hz;
  std::optional<double> interface_frequency_error, interface_film_work_error;
  // Conditioning.
  std::optional<double> condition_M_rr, first_elastic_hz, max_frequency_hz;
  std::optional<double> K_ii_rcond, K_ii_probe_residual;
  /// Numbers of another version, which add-rows keeps.
  CertificateNumbers other;

  static const std::vector<CertificateField<ReducedCertificate>>& fields();
  bool operator==(const ReducedCertificate&) const = default;
};

}  // namespace clatter::rom
