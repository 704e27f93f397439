// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/certificate_warning.hpp"

namespace clatter::rom {

std::string certificate_warning(const ReducedModel& model) {
  const auto& found = model.certificate;
  if (found.empty()) return "no certificate: its modes and mass properties are unverified";
  const auto certified = found.find("certified");
  if (certified == found.end() || certified->second != 0.0) return {};
  return "not certified: condensed with --no-certificate, "
         "missing modes would be undetected";
}

}  // namespace clatter::rom
