#include "condense/verify.hpp"

#include <fmt/format.h>

#include "core/log.hpp"

namespace clatter::condense {

modal::Comparison verify(ReducedModel& reduced, const assembly::FeModel& model, double to_hz) {
  auto& out = reduced.certificate;
  const double limit = to_hz > 0.0 ? to_hz : out.at("accurate_to_hz");
  modal::Comparison result;
  try {
    result = modal::compare(model, reduced, {limit, 0});
  } catch (const modal::NothingCompared& error) {  // a certificate without it is still one
    warn(fmt::format("not verified: {}", error.what()));
    return result;
  }
  out["verified_to_hz"] = limit;
  out["verified_modes"] = static_cast<double>(result.modes.size());
  out["verified_frequency_error"] = result.largest_error();
  out["verified_mac"] = result.smallest_mac();
  return result;
}

}  // namespace clatter::condense
