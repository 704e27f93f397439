// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/model/fe_certificate.hpp"

namespace clatter::assembly {

const std::vector<CertificateField<FeCertificate>>& FeCertificate::fields() {
  using C = FeCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"dofs", &C::dofs, "", "number of DoFs, n"},
      {"dofs_fixed", &C::dofs_fixed, "", "coordinates held by supports"},
      {"dofs_pivot", &C::dofs_pivot, "", "coordinates eliminated by couplings"},
      {"held_dofs", &C::held_dofs, "", "rows of an imported matrix held by 1e30"},
      {"nonzeros_K", &C::nonzeros_K, "", "stored entries of K"},
      {"nonzeros_M", &C::nonzeros_M, "", "stored entries of M"},
      {"nonzeros_T", &C::nonzeros_T, "", "stored entries of T"},
      {"largest_T_entry", &C::largest_T_entry, "",
       "largest entry of T between displacements; a large one: couplings lie close to one another",
       good_up_to(1e6, "couplings lie close to one another and lose as many digits")},
      {"rigid_motions_held_by_equations", &C::rigid_motions_held_by_equations, "",
       "rigid motions constrained by equations"},
      {"rigid_recovery_error", &C::rigid_recovery_error, "",
       "error of T for the other rigid motions R, relative",
       good_up_to(1e-9, "constraints do not let the part move as it can", 1e-9)},
      {"rigid_force_residue", &C::rigid_force_residue, "", "|K R| / (|K| |R|) of them",
       good_up_to(1e-9,
                  "K resists rigid motions: matrices of few digits, or an unseen support; "
                  "assembled ones are refused")},
      {"mass_error", &C::mass_error, "",
       "mass of a free part, R^T M R against the sum over the elements, relative",
       good_up_to(1e-9, "M is not that of the elements", 1e-9)},
      {"centre_error", &C::centre_error, "",
       "the same of the centre of mass, over the radius of gyration",
       good_up_to(0.01,
                  "lumped masses of large cells move it; other masses are refused by the limit of "
                  "mass_error")},
      {"inertia_error", &C::inertia_error, "", "the same of the inertia, over its trace",
       good_up_to(0.05, "lumped masses of large cells add to it; others as above")},
      {"heat_balance_<heat>", &C::heat_balance, "",
       "sum of the heat into the part over the heat that flows, of a temperature field",
       good_up_to(1e-6, "the temperature field is not solved")}};
  return list;
}

}  // namespace clatter::assembly
