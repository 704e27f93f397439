// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of a run.
#include <optional>
#include <string>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::dynamics {

/// Differences between two cycles at equal crank angles; all absent when there was only one.
struct CycleDifference {
  /// Largest difference of the piston's secondary motion [m], [rad]; absent without a piston.
  std::optional<double> lateral{}, tilt{};
  /// The same of named cylinders.
  CertificateNumbers lateral_of{}, tilt_of{};
  /// By body, sqrt(sum |v - v'|^2 / sum |v|^2) over modal velocities, the norm of kinetic energy.
  CertificateNumbers velocity{};

  bool operator==(const CycleDifference&) const = default;
};

/// A way of creep (creep_watch.hpp) from which a run says so [m]. Bushes that rest in the teeth of
/// a running drive creep by a tenth of it, which changes its motion by less than the step tolerance
/// (hard case TD11); what stays at rest goes on.
inline constexpr double kLongestCreep = 1e-4;

/// The certificate of a run. fields() has the unit and meaning of each member, which are named as
/// in the file; those of CycleDifference are named periodicity_lateral,
/// periodicity_tilt, those of named cylinders and `periodicity_<body>`.
struct RunCertificate : CycleDifference {
  double energy_residue = 0.0, energy_exchanged = 0.0;
  std::optional<double> energy_imbalance{};  // absent in older files
  std::optional<double> oil_residue{}, oil_moved{};
  std::optional<double> creep{};
  double complete = 0.0, cycles = 0.0, steps_accepted = 0.0, steps_rejected = 0.0;

  static const std::vector<CertificateField<RunCertificate>>& fields();
  bool operator==(const RunCertificate&) const = default;
};

/// Lines for the user, "periodicity_lateral: 1.2e-06 m", "periodicity_block: 0.00123"; none after
/// one cycle.
std::vector<std::string> periodicity_lines(const CycleDifference& difference);

}  // namespace clatter::dynamics
