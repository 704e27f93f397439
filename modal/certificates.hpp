// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of modes, static results and shapes.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::modal {

/// The certificate of a modes file. fields() has the unit and meaning of each member, which are
/// named as in the file.
struct ModesCertificate {
  double count_proved = 0.0, count_below = 0.0, count_limit_hz = 0.0;
  double residual_max = 0.0;
  std::optional<double> frequency_rounding_max{};    // with at least one mode
  std::optional<double> frequency_error_estimate{};  // by AMLS
  std::optional<double> frequency_error_parts{};     // of a model with reduced parts
  double rigid_modes = 0.0, massless_unknowns = 0.0;
  double shift = 0.0, solves = 0.0, factors = 0.0, retries = 0.0;
  double factor_entries = 0.0, factor_rcond = 0.0;

  static const std::vector<CertificateField<ModesCertificate>>& fields();
  bool operator==(const ModesCertificate&) const = default;
};

/// The same of a file of static results.
struct StaticCertificate {
  double cases = 0.0;
  double backward_error_max = 0.0, forward_error_max = 0.0, balance_max = 0.0;
  double factor_entries = 0.0, factor_rcond = 0.0;

  static const std::vector<CertificateField<StaticCertificate>>& fields();
  bool operator==(const StaticCertificate&) const = default;
};

/// The same of a file of a shape.
struct ShapeCertificate {
  double cases = 0.0, covered = 0.0, radius_spread = 0.0;

  static const std::vector<CertificateField<ShapeCertificate>>& fields();
  bool operator==(const ShapeCertificate&) const = default;
};

}  // namespace clatter::modal
