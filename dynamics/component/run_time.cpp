// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/run_time.hpp"

#include <algorithm>
#include <utility>

namespace clatter::dynamics {

TimeFunction ramped(const TimeSpec& time, TimeFunction value) {
  if (time.ramp <= 0.0) return value;
  return [begin = time.begin, length = time.ramp, value = std::move(value)](double t) {
    const double s = std::clamp((t - begin) / length, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s) * value(t);
  };
}

}  // namespace clatter::dynamics
