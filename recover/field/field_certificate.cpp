// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/field/field_certificate.hpp"

namespace clatter::recover {

const std::vector<CertificateField<FieldCertificate>>& FieldCertificate::fields() {
  using C = FieldCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"skin_area_m2", &C::skin_area_m2, "m2", "area of the skin"},
      {"skin_closure", &C::skin_closure, "",
       "length of the integral of n dS over the area: 0 for a closed skin",
       good_up_to(1e-3, "the skin is open: powers are those of the faces that it has")},
      {"run_complete", &C::run_complete, "", "1: the run is complete",
       good_from(1.0, "the run was interrupted")},
      {"mean_square_share_above_spectra", &C::mean_square_share_above_spectra, "",
       "of a cycle: share of the mean square velocity above the last line",
       good_up_to(
           0.1,
           "much of the motion is above the last line: a reduced model to a higher frequency")},
      {"cycle_to_cycle_velocity_difference", &C::cycle_to_cycle_velocity_difference, "",
       "of the last two cycles, relative; absent without two",
       good_up_to(0.1, "levels of another cycle differ: more cycles, or a window with cycles")},
      {"cycle_end_velocity_jump", &C::cycle_end_velocity_jump, "",
       "RMS of v_n at the end less v_n at the beginning of the cycle, over the RMS of v_n in the "
       "cycle",
       good_up_to(0.1, "the cycle does not close, and its spectrum has lines of the jump")},
      {"panel_power_difference", &C::panel_power_difference, "",
       "with a sound file: sum of the sound powers of all parts of the skin less that of the "
       "whole, "
       "of the line where it is largest, over the power of all lines",
       good_up_to(1e-6, "the powers of panels do not add up", 1e-3)},
      {"directivity_power_difference", &C::directivity_power_difference, "",
       "with a sound file: largest relative difference of the power through a distant sphere and "
       "that of the part, of a third octave",
       good_up_to(0.05, "more directions are needed at high frequencies")},
      {"resistance_power_difference", &C::resistance_power_difference, "",
       "with a sound file: v^H R v less the power of the far field, of the line where it is "
       "largest, over the power of all lines: what the mesh breaks of reciprocity",
       good_up_to(0.05, "the acoustic skin is too coarse: more edges_per_wavelength", 0.5)}};
  return list;
}

}  // namespace clatter::recover
