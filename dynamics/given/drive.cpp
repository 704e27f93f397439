// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/drive.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {

Drive::Drive(double mean, double start, std::vector<SpeedOrder> orders)
    : mean_(mean), start_(start), orders_(std::move(orders)) {
  if (mean_ == 0.0 && !orders_.empty())
    throw InputError("drive: found orders at a mean speed of 0, expected a speed to refer to");
  for (const SpeedOrder& one : orders_)
    if (!(one.order > 0.0))
      throw InputError(fmt::format("drive: found order {}, expected a positive one", one.order));
}

Motion<double> Drive::at(double time) const {
  Motion<double> motion{start_ + mean_ * time, mean_, 0.0};
  for (const SpeedOrder& one : orders_) {
    const double frequency = one.order * mean_, angle = frequency * time + one.phase;
    motion.position += one.amplitude / frequency * (std::sin(angle) - std::sin(one.phase));
    motion.velocity += one.amplitude * std::cos(angle);
    motion.acceleration -= one.amplitude * frequency * std::sin(angle);
  }
  return motion;
}

}  // namespace clatter::dynamics
