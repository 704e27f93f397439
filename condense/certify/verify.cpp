// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/certify/verify.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"

namespace clatter::condense {
namespace {

/// @param compare gives the comparison up to a frequency.
template <class Compare>
modes::Comparison verify_with(rom::ReducedModel& reduced, double to_hz, const Compare& compare) {
  rom::ReducedCertificate& out = reduced.certificate;
  const double limit = to_hz > 0.0 ? to_hz : out.accurate_to_hz.value();
  modes::Comparison result;
  try {
    result = compare(modes::CompareOptions{limit, 0});
  } catch (const modes::NothingCompared& error) {  // the certificate is valid without it
    warn(fmt::format("not verified: {}", error.what()));
    return result;
  }
  if (result.modes.empty()) return result;
  out.verified_to_hz = limit;
  out.verified_modes = static_cast<double>(result.modes.size());
  out.verified_frequency_error = result.largest_error();
  out.verified_mac = result.smallest_mac();
  return result;
}

}  // namespace

modes::Comparison verify(rom::ReducedModel& reduced, const fe::FeModel& model, double to_hz) {
  return verify_with(reduced, to_hz, [&](const modes::CompareOptions& options) {
    return modes::compare(model, reduced, options);
  });
}

modes::Comparison verify(rom::ReducedModel& reduced, const fe::FeModel& model, double to_hz,
                         const modes::ModeSolver& solve) {
  return verify_with(reduced, to_hz, [&](const modes::CompareOptions& options) {
    return modes::compare(model, reduced, options, solve);
  });
}

}  // namespace clatter::condense
