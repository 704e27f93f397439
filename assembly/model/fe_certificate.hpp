// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What was proved of an assembled model.
#include <optional>
#include <vector>

#include "core/base/certificate.hpp"

namespace clatter::assembly {

/// The certificate of an FE model. fields() has the unit and meaning of each member, which are
/// named as in the file.
struct FeCertificate {
  double dofs = 0.0;
  // Of a model assembled here, by certify().
  std::optional<double> dofs_fixed{}, dofs_pivot{};
  std::optional<double> nonzeros_K{}, nonzeros_M{}, nonzeros_T{}, largest_T_entry{};
  std::optional<double> rigid_motions_held_by_equations{}, rigid_recovery_error{};
  std::optional<double> mass_error{}, centre_error{}, inertia_error{};
  // Of matrices of other programs, by import_matrices().
  std::optional<double> held_dofs{};
  // By both.
  std::optional<double> rigid_force_residue{};
  // Of each [[heat]].
  CertificateNumbers heat_balance{};

  static const std::vector<CertificateField<FeCertificate>>& fields();
  bool operator==(const FeCertificate&) const = default;
};

}  // namespace clatter::assembly
