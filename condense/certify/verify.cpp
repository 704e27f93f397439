// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/certify/verify.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"

namespace clatter::condense {

modes::Comparison verify(rom::ReducedModel& reduced, const fe::FeModel& model, double to_hz) {
  rom::ReducedCertificate& out = reduced.certificate;
  const double limit = to_hz > 0.0 ? to_hz : out.accurate_to_hz.value();
  modes::Comparison result;
  try {
    result = modes::compare(model, reduced, {limit, 0});
  } catch (const modes::NothingCompared& error) {  // the certificate is valid without it
    warn(fmt::format("not verified: {}", error.what()));
    return result;
  }
  out.verified_to_hz = limit;
  out.verified_modes = static_cast<double>(result.modes.size());
  out.verified_frequency_error = result.largest_error();
  out.verified_mac = result.smallest_mac();
  return result;
}

}  // namespace clatter::condense
