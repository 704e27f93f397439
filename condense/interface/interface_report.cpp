// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include "condense/interface/interface_modes.hpp"

namespace clatter::condense {

void record(const InterfaceReport& report, std::map<std::string, double>& certificate) {
  certificate["interface_coordinates"] = report.coordinates;
  certificate["interface_modes"] = report.modes;
  certificate["interface_cutoff_hz"] = report.cutoff_hz;
  certificate["interface_frequency_error"] = report.frequency_error;
  certificate["interface_film_work_error"] = report.pressure_work_error;
}

std::string interface_line(const std::map<std::string, double>& certificate) {
  const auto at = [&](const char* name) { return certificate.at(name); };
  const std::string cutoff = at("interface_cutoff_hz") > 0.0
                                 ? fmt::format(", all below {:.0f} Hz", at("interface_cutoff_hz"))
                                 : std::string{};
  const double film_error = at("interface_film_work_error");
  const std::string film =
      film_error > 0.0
          ? fmt::format(", and the work of film pressure by {:.2g} %", 100.0 * film_error)
          : std::string{};
  return fmt::format(
      "{:.0f} boundary coordinates became {:.0f} interface modes{}; that changes "
      "frequencies up to {:.0f} Hz by {:.2g} %{}",
      at("interface_coordinates"), at("interface_modes"), cutoff, at("accurate_to_hz"),
      100.0 * at("interface_frequency_error"), film);
}

}  // namespace clatter::condense
