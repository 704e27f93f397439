// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/contact_damping.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace clatter::film {

ContactDamping::ContactDamping(const ContactDampingOptions& options)
    : amplitude_(0.5 * std::numbers::pi * options.loss_factor), speed_(options.speed) {
  if (!(options.loss_factor >= 0.0 && options.loss_factor <= 0.6) || !(options.speed > 0.0))
    throw InputError(fmt::format(
        "contact damping: found loss factor {}, speed {} m/s, expected 0 to 0.6 and > 0",
        options.loss_factor, options.speed));
}

ContactDamping::Ratio ContactDamping::at(double gap_rate) const {
  const double root = std::hypot(gap_rate, speed_), scaled = speed_ / root;
  return {1.0 - amplitude_ * gap_rate / root, -amplitude_ * scaled * scaled / root};
}

}  // namespace clatter::film
