// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/certificate_warning.hpp"

namespace clatter::rom {

std::string certificate_warning(const ReducedModel& model) {
  const auto& found = model.certificate;
  if (found == ReducedCertificate{})
    return "no certificate: its modes and mass properties are unverified";
  if (found.certified != 0.0) return {};
  return "not certified: condensed with --no-certificate, or from such a part: "
         "missing modes would be undetected";
}

}  // namespace clatter::rom
