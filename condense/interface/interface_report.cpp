// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "condense/interface/interface_modes.hpp"

namespace clatter::condense {

void record(const InterfaceReport& report, rom::ReducedCertificate& certificate) {
  certificate.interface_coordinates = report.coordinates;
  certificate.interface_modes = report.modes;
  certificate.interface_cutoff_hz = report.cutoff_hz;
  certificate.interface_frequency_error = report.frequency_error;
  certificate.interface_film_work_error = report.pressure_work_error;
}

std::string interface_line(const rom::ReducedCertificate& c) {
  const std::string cutoff =
      c.interface_cutoff_hz.value() > 0.0
          ? fmt::format(", all below {:.0f} Hz", c.interface_cutoff_hz.value())
          : std::string{};
  const double film_error = c.interface_film_work_error.value();
  const std::string film =
      film_error > 0.0
          ? fmt::format(", and the work of film pressure by {:.2g} %", 100.0 * film_error)
          : std::string{};
  return fmt::format(
      "{:.0f} boundary coordinates became {:.0f} interface modes{}; that changes "
      "frequencies up to {:.0f} Hz by {:.2g} %{}",
      c.interface_coordinates.value(), c.interface_modes.value(), cutoff, c.accurate_to_hz.value(),
      100.0 * c.interface_frequency_error.value(), film);
}

}  // namespace clatter::condense
