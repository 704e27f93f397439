// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/sound_certificate.hpp"

namespace clatter::recover {

const std::vector<CertificateField<SoundCertificate>>& SoundCertificate::fields() {
  using C = SoundCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"faces", &C::faces, "", "of the acoustic skin"},
      {"mesh_limit_hz", &C::mesh_limit_hz, "Hz",
       "frequency with the requested number of mean edges a wavelength"},
      {"lid_area_m2", &C::lid_area_m2, "m2", "area that closes openings"},
      {"open_edges", &C::open_edges, "",
       "edges of the part's skin with one face: 0 for a closed skin; holes up to the opening are "
       "closed"},
      {"map_flux_error", &C::map_flux_error, "",
       "flux lost from the exposed faces to the acoustic skin, six rigid motions, relative"},
      {"map_velocity_error", &C::map_velocity_error, "",
       "RMS difference of rigid motions of the acoustic skin and of the map, without lids, "
       "relative"},
      {"monopole_error_db", &C::monopole_error_db, "dB",
       "largest error of the power of a point source inside the acoustic skin"},
      {"surface_power_error_db", &C::surface_power_error_db, "dB",
       "largest difference of its power from pressures on the skin and from the far field"},
      {"far_field_error_db", &C::far_field_error_db, "dB",
       "largest error of diagonal entries of R from the stored far field, against the far field "
       "in all directions"},
      {"interpolation_error_db", &C::interpolation_error_db, "dB",
       "largest error of interpolated diagonal entries of R, measured at frequencies that were "
       "then added"},
      {"microphone_interpolation_error_db", &C::microphone_interpolation_error_db, "dB",
       "the same of the rows of microphones, of their norm"},
      {"highest_condition", &C::highest_condition, "", "condition number of the solved matrices"}};
  return list;
}

}  // namespace clatter::recover
