// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/certificates.hpp"

namespace clatter::modal {

const std::vector<CertificateField<ModesCertificate>>& ModesCertificate::fields() {
  using C = ModesCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"count_proved", &C::count_proved, "",
       "1: the modes below the limit are as many as the inertia of K - sigma M says; by AMLS only "
       "where the errors leave it unambiguous",
       good_from(1.0, "a mode may be missing")},
      {"count_below", &C::count_below, "", "modes below the limit by inertia"},
      {"count_limit_hz", &C::count_limit_hz, "Hz", "the limit of the count"},
      {"residual_max", &C::residual_max, "", "largest relative residual of a mode",
       good_up_to(1e-6, "modes are not converged", 1e-3)},
      {"frequency_rounding_max", &C::frequency_rounding_max, "", "largest of `rounding`",
       good_up_to(1e-3, "rounding of the entries of K moves the lowest frequencies")},
      {"frequency_error_estimate", &C::frequency_error_estimate, "",
       "by AMLS: largest estimated relative error of a frequency",
       good_up_to(0.01,
                  "frequencies near the limit are too high: eigen_solver = \"block-lanczos\"")},
      {"frequency_error_parts", &C::frequency_error_parts, "",
       "largest estimated relative error of a frequency for the modes that reduced parts lack; "
       "absent where one of them does not know",
       good_up_to(0.01, "ask for fewer modes, or reduce the parts with a higher cut-off")},
      {"rigid_modes", &C::rigid_modes, "", "modes of zero stiffness"},
      {"massless_unknowns", &C::massless_unknowns, "", "infinite eigenvalues"},
      {"shift", &C::shift, "rad2/s2", "shift of the eigen-solver"},
      {"solves", &C::solves, "", "solves with the factor"},
      {"factors", &C::factors, "", "factorisations"},
      {"retries", &C::retries, "", "further tries of the eigen-solver"},
      {"factor_entries", &C::factor_entries, "", "entries of the factor"},
      {"factor_rcond", &C::factor_rcond, "", "smallest over largest pivot of the factor"}};
  return list;
}

const std::vector<CertificateField<StaticCertificate>>& StaticCertificate::fields() {
  using C = StaticCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"cases", &C::cases, "", "number of cases"},
      {"backward_error_max", &C::backward_error_max, "", "largest backward error of a case",
       good_up_to(1e-12, "the equations are not solved", 1e-12)},
      {"forward_error_max", &C::forward_error_max, "",
       "largest estimated forward error of a case, relative",
       good_up_to(1e-3,
                  "rounding of the entries of K moves the displacements: thicker walls, smaller "
                  "jumps of stiffness, or stiffer supports",
                  1.0)},
      {"balance_max", &C::balance_max, "",
       "largest sum of applied forces and reactions, over the forces that cancel",
       good_up_to(1e-8, "forces and reactions differ by more than rounding of the loads")},
      {"factor_entries", &C::factor_entries, "", "entries of the factor"},
      {"factor_rcond", &C::factor_rcond, "", "smallest over largest pivot of the factor"}};
  return list;
}

const std::vector<CertificateField<ShapeCertificate>>& ShapeCertificate::fields() {
  using C = ShapeCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"cases", &C::cases, "", "number of cases"},
      {"covered", &C::covered, "", "share of the grid's points that lie on faces",
       good_from(0.1, "the shape is extrapolated where no face is")},
      {"radius_spread", &C::radius_spread, "m",
       "largest difference between the distance of a node from the axis and their mean"}};
  return list;
}

}  // namespace clatter::modal
