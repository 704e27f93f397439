// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/liner_ends_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kStepDeg = 0.1;

/// `beyond` [m] over the crank angle [deg]: how far an end of the skirt is outside.
std::string end_text(const std::function<double(double)>& beyond, const char* end,
                     const char* side) {
  double farthest = 0.0;
  for (double at = 0.0; at < 360.0; at += kStepDeg)
    if (beyond(at) > beyond(farthest)) farthest = at;
  if (!(beyond(farthest) > 0.0))
    return fmt::format("stays {:.3g} mm {} its {}", -beyond(farthest) / kMilli, side, end);
  const auto limit = [&](double step) {
    double at = farthest;
    while (std::abs(at - farthest) < 360.0 && beyond(at) > 0.0) at += step;
    return at;
  };
  return fmt::format("leaves its {} by {:.3g} mm, {:.0f} to {:.0f} deg after TDC", end,
                     beyond(farthest) / kMilli, limit(-kStepDeg), limit(kStepDeg));
}

}  // namespace

std::string liner_ends_text(const SliderCrank& crank, const film::PistonLinerOptions& contact) {
  const auto pin = [&](double deg) { return crank.piston_pin(crank.time(deg * kDegree)).position; };
  std::string text;
  const auto add = [&](const std::string& more) {
    text += (text.empty() ? "skirt " : ", ") + more;
  };
  if (std::isfinite(contact.ends.bottom))
    add(end_text([&](double deg) { return contact.ends.bottom - pin(deg) - contact.skirt_bottom; },
                 "bottom", "above"));
  if (std::isfinite(contact.ends.top))
    add(end_text([&](double deg) { return pin(deg) + contact.skirt_top - contact.ends.top; }, "top",
                 "below"));
  return text;
}

}  // namespace clatter::dynamics
