// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_certificate.hpp"

#include <fmt/format.h>

namespace clatter::dynamics {

const std::vector<CertificateField<RunCertificate>>& RunCertificate::fields() {
  using C = RunCertificate;
  static const std::vector<CertificateField<C>> list = {
      {"energy_residue", &C::energy_residue, "",
       "imbalance over the energy exchanged, at least over that of bodies at the limit of the "
       "error test, tolerance times velocity_m_s",
       good_up_to(0.01, "steps are too coarse for this motion: a smaller [accuracy] velocity_m_s",
                  0.5)},
      {"energy_exchanged", &C::energy_exchanged, "J", "the energy exchanged"},
      {"energy_imbalance", &C::energy_imbalance, "J",
       "change of the stored energy less what came in, plus what was lost"},
      {"oil_residue", &C::oil_residue, "",
       "largest of the contacts: oil that is missing since the start, over what moved; absent "
       "unless "
       "a scene has [contact.liner_oil]",
       good_up_to(0.01, "the film loses oil: a finer mesh or smaller steps")},
      {"oil_moved", &C::oil_moved, "m3", "what moved there"},
      {"creep", &C::creep, "m",
       "longest way that a contact crept at rest, because its friction has a slip speed; absent "
       "where none has",
       good_up_to(kLongestCreep, "a smaller slip_speed_m_s creeps less; a stop without it sticks")},
      {"complete", &C::complete, "", "1: it ran to the end"},
      {"cycles", &C::cycles, "", "completed cycles; 1 for a scene without an engine"},
      {"steps_accepted", &C::steps_accepted, "", "accepted steps"},
      {"steps_rejected", &C::steps_rejected, "", "steps that were rejected and repeated"},
      {"periodicity_lateral", &C::lateral, "m",
       "largest difference of the piston's lateral position between the last two cycles; absent "
       "after one cycle, as are all that follow"},
      {"periodicity_tilt", &C::tilt, "rad", "the same of its tilt"},
      {"periodicity_lateral_<cylinder>", &C::lateral_of, "m",
       "the lateral position of each named cylinder's piston"},
      {"periodicity_tilt_<cylinder>", &C::tilt_of, "rad", "the same of its tilt"},
      {"periodicity_<body>", &C::velocity, "", "relative difference of the body's velocities",
       good_up_to(0.1, "cycles differ: more cycles, or a mean over several by record_cycles")}};
  return list;
}

std::vector<std::string> periodicity_lines(const CycleDifference& difference) {
  const RunCertificate certificate{difference};
  std::vector<std::string> lines;
  for (const auto& field : RunCertificate::fields()) {
    if (!std::string_view(field.name).starts_with("periodicity_")) continue;
    CertificateNumbers numbers;
    field.visit(certificate, [&](const auto& value) { put_field(field.name, value, numbers); });
    const std::string unit = *field.unit == '\0' ? "" : fmt::format(" {}", field.unit);
    for (const auto& [name, value] : numbers)
      lines.push_back(fmt::format("{}: {:.3g}{}", name, value, unit));
  }
  return lines;
}

}  // namespace clatter::dynamics
