// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of a field file.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::recover {

/// The certificate of a field file. fields() has the unit and meaning of each member, which are
/// named as in the file.
struct FieldCertificate {
  double skin_area_m2 = 0.0, skin_closure = 0.0, run_complete = 0.0;
  // Of a periodic piece.
  std::optional<double> mean_square_share_above_spectra{};
  std::optional<double> cycle_to_cycle_velocity_difference{}, cycle_end_velocity_jump{};
  // With a sound file.
  std::optional<double> panel_power_difference{}, directivity_power_difference{},
      resistance_power_difference{};

  static const std::vector<CertificateField<FieldCertificate>>& fields();
  bool operator==(const FieldCertificate&) const = default;
};

}  // namespace clatter::recover
