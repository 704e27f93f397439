// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/crank/mean_torque.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::dynamics {

void MeanTorque::begin_step(double time) {
  if (counting_) return;
  counting_ = true;
  begin_ = time_ = time;
  first_angle_ = angle_;
  first_rate_ = rate_;
  integral_ = 0.0;
}

void MeanTorque::accept_step(double time, double angle, double rate) {
  integral_ += 0.5 * (time - time_) * (angle_ + angle);
  time_ = time;
  angle_ = angle;
  rate_ = rate;
  if (time - begin_ < cycle_ * (1.0 - 1e-9)) return;  // rounding of the cycle's end
  const double length = time - begin_, travelled = angle_ - first_angle_;
  const double a = (rate_ - first_rate_) / length;
  const double speed = travelled / length + 0.5 * a * length;
  const double mean = integral_ / length + 0.5 * travelled + a * length * length / 12.0;
  torque_ += inertia_ * (a + (1.5 * speed + mean / length) / length);
  counting_ = false;
}

void MeanTorque::restore(const std::vector<double>& state) {
  if (state.size() != 3)
    throw InputError(
        fmt::format("torque on the crank: found {} numbers, expected 3", state.size()));
  torque_ = state[0];
  angle_ = state[1];
  rate_ = state[2];
  counting_ = false;
}

}  // namespace clatter::dynamics
