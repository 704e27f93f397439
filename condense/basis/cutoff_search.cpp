// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/cutoff_search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/log.hpp"

namespace clatter::condense {

double cutoff_error_bound(double estimate, double hz, double cutoff_hz) {
  return estimate / (1.0 - std::pow(hz / cutoff_hz, 2));
}

SearchedBasis search_cutoff(const PartitionedModel& part, const StaticPart& statics,
                            const ModeRequest& request, StepClock& clock) {
  constexpr double kFirst = 1.5, kGrowth = 1.25, kLast = 4.0;  // over the requested frequency
  const double accurate_to_hz = request.accurate_to_hz;
  CutOffSearch search{.target = request.frequency_error};
  ModeRequest attempt = request;
  attempt.fmax_hz = request.own_modes ? accurate_to_hz : kFirst * accurate_to_hz;
  while (true) {
    // Residual modes stop when the bound is met, not only the estimate.
    if (!request.own_modes)
      attempt.frequency_error /= cutoff_error_bound(1.0, accurate_to_hz, attempt.fmax_hz);
    CraigBampton found = craig_bampton(part, statics, attempt, clock);
    ++search.tried;
    const double estimate = found.residual.error_estimate;
    search.reached = request.own_modes
                         ? estimate
                         : cutoff_error_bound(estimate, accurate_to_hz, attempt.fmax_hz);
    if (search.reached <= search.target) return {std::move(found), search};
    if (request.own_modes || attempt.fmax_hz * kGrowth > kLast * accurate_to_hz)
      throw NumericsError(fmt::format(
          "{}: accurate_to_hz: frequencies up to {:g} Hz are within {:.1e} with a "
          "cut-off of {:g} Hz, "
          "expected {:.1e}; the factor's rounding may not allow less",
          part.full.name, accurate_to_hz, search.reached, attempt.fmax_hz, search.target));
    say(fmt::format("cut-off {:g} Hz: error up to {:.1e}, requested {:.1e}; raised",
                    attempt.fmax_hz, search.reached, search.target));
    attempt.fmax_hz *= kGrowth;
    attempt.frequency_error = request.frequency_error;
  }
}

void record(const CutOffSearch& search, rom::ReducedCertificate& certificate) {
  certificate.frequency_error_target = search.target;
  certificate.frequency_error_bound = search.reached;
  certificate.cutoffs_tried = search.tried;
}

std::string cutoff_line(const rom::ReducedCertificate& c) {
  return fmt::format(
      "chose a cut-off of {:g} Hz, {:.3g} times {:g} Hz, after {:.0f} tried: frequencies below "
      "are within {:.2g} %, requested {:.2g} %",
      c.cutoff_hz.value(), c.cutoff_hz.value() / c.accurate_to_hz.value(), c.accurate_to_hz.value(),
      c.cutoffs_tried.value(), 100.0 * c.frequency_error_bound.value(),
      100.0 * c.frequency_error_target.value());
}

}  // namespace clatter::condense
