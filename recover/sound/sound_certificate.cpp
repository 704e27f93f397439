// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_certificate.hpp"

namespace clatter::recover {

const std::vector<CertificateField<SoundCertificate>>& SoundCertificate::fields() {
  using C = SoundCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"faces", &C::faces, "", "of the acoustic skin"},
      {"mesh_limit_hz", &C::mesh_limit_hz, "Hz",
       "frequency with the requested number of mean edges a wavelength"},
      {"shape_error", &C::shape_error, "",
       "difference of the acoustic skin from the wrap before remeshing, in volume and in the "
       "volume of a sphere of its area, over the latter",
       good_up_to(0.05,
                  "the acoustic skin is too coarse for the body: a smaller skin.shape_error")},
      {"lid_area_m2", &C::lid_area_m2, "m2", "area that closes openings"},
      {"open_edges", &C::open_edges, "",
       "edges of the part's skin with one face: 0 for a closed skin; holes up to the opening are "
       "closed"},
      {"map_flux_error", &C::map_flux_error, "",
       "flux lost from the exposed faces to the acoustic skin, six rigid motions, relative",
       good_up_to(1e-9, "volume flow is lost between part and acoustic skin", 1e-6)},
      {"map_velocity_error", &C::map_velocity_error, "",
       "RMS difference of rigid motions of the acoustic skin and of the map, without lids, "
       "relative"},
      {"monopole_error_db", &C::monopole_error_db, "dB",
       "largest error of the power of a point source inside the acoustic skin; absent of thin "
       "bodies",
       good_up_to(0.2, "the acoustic skin does not resolve the highest frequency", 3.0)},
      {"surface_power_error_db", &C::surface_power_error_db, "dB",
       "largest difference of its power from pressures on the skin and from the far field",
       good_up_to(0.5,
                  "the acoustic skin does not resolve the highest frequency, or the near field of "
                  "a slow motion")},
      {"far_field_error_db", &C::far_field_error_db, "dB",
       "largest error of diagonal entries of R from the stored far field, against the far field "
       "in all directions",
       good_up_to(1.0, "the stored far field misses lobes of a motion that hardly radiates")},
      {"interpolation_error_db", &C::interpolation_error_db, "dB",
       "largest error of interpolated diagonal entries of R, measured at frequencies that were "
       "then added",
       good_up_to(0.5,
                  "powers between the computed frequencies are off: a smaller grid.tolerance_db")},
      {"microphone_interpolation_error_db", &C::microphone_interpolation_error_db, "dB",
       "the same of the rows of microphones, of their norm",
       good_up_to(0.5, "pressures between the computed frequencies are off")},
      {"highest_condition", &C::highest_condition, "", "condition number of the solved matrices",
       good_up_to(1e6, "faces of the acoustic skin are badly shaped", 1e10)}};
  return list;
}

}  // namespace clatter::recover
