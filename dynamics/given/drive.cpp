// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/drive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kFullTurn = 2.0 * std::numbers::pi;

/// speed * time less whole turns. The product's own rounding, 5e-10 rad after a million turns, is
/// added again.
double turned(double speed, double time) {
  const double product = speed * time;
  return std::remainder(product, kFullTurn) + std::fma(speed, time, -product);
}

}  // namespace

Drive::Drive(double mean, double start, std::vector<SpeedOrder> orders)
    : mean_(mean), start_(std::remainder(start, kFullTurn)), orders_(std::move(orders)) {
  if (mean_ == 0.0 && !orders_.empty())
    throw InputError("drive: orders need a mean speed other than 0");
  for (const SpeedOrder& one : orders_)
    if (!(one.order > 0.0))
      throw InputError(fmt::format("drive: found order {}, expected a positive one", one.order));
}

Drive::Drive(TurnTable table, double start)
    : mean_(0.0),
      start_(std::remainder(start, kFullTurn)),
      table_(std::make_shared<const TurnTable>(std::move(table))) {}

Motion<double> Drive::at(double time) const {
  if (table_) {
    Motion<double> motion = table_->at(time);
    motion.position = std::remainder(motion.position, kFullTurn) + start_;
    return motion;
  }
  Motion<double> motion{start_ + turned(mean_, time), mean_, 0.0};
  for (const SpeedOrder& one : orders_) {
    const double frequency = one.order * mean_, angle = turned(frequency, time) + one.phase;
    motion.position += one.amplitude / frequency * (std::sin(angle) - std::sin(one.phase));
    motion.velocity += one.amplitude * std::cos(angle);
    motion.acceleration -= one.amplitude * frequency * std::sin(angle);
  }
  return motion;
}

bool Drive::repeats(double cycle) const {
  if (table_) return false;
  constexpr double kRounding = 1e-6;  // of a turn
  const double turns = mean_ * cycle / kFullTurn;
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < kRounding; };
  return is_whole(turns) && std::all_of(orders_.begin(), orders_.end(), [&](const auto& one) {
           return is_whole(one.order * turns);
         });
}

}  // namespace clatter::dynamics
