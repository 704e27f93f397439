// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was measured of a sound file.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::recover {

/// The certificate of a sound file. fields() has the unit and meaning of each member.
struct SoundCertificate {
  double faces = 0.0, mesh_limit_hz = 0.0, shape_error = 0.0, lid_area_m2 = 0.0, open_edges = 0.0;
  double map_flux_error = 0.0, map_velocity_error = 0.0;
  // Of bodies that have room for a point source.
  std::optional<double> monopole_error_db{}, surface_power_error_db{};
  double far_field_error_db = 0.0;
  double interpolation_error_db = 0.0, microphone_interpolation_error_db = 0.0;
  double highest_condition = 0.0;

  static const std::vector<CertificateField<SoundCertificate>>& fields();
  bool operator==(const SoundCertificate&) const = default;
};

}  // namespace clatter::recover
