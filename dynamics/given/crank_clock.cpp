// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/crank_clock.hpp"

#include <cmath>

namespace clatter::dynamics {

Motion<double> CrankClock::turn(double time) const {
  Motion<double> turn{speed * time, speed, 0.0};
  for (const SpeedOrder& one : orders) {
    const double w = one.order * speed, angle = w * time + one.phase;
    turn.position += one.amplitude / w * (std::sin(angle) - std::sin(one.phase));
    turn.velocity += one.amplitude * std::cos(angle);
    turn.acceleration -= one.amplitude * w * std::sin(angle);
  }
  if (deviation) {
    const SplinePoint more = deviation->at(time);
    turn.position += more.value;
    turn.velocity += more.first;
    turn.acceleration += more.second;
  }
  return turn;
}

double CrankClock::time(double angle) const {
  double time = angle / speed;
  if (is_uniform()) return time;
  for (int i = 0; i < 50; ++i) {
    const Motion<double> now = turn(time);
    const double step = (now.position - angle) / now.velocity;
    time -= step;
    if (std::abs(step) * speed < 1e-14) break;
  }
  return time;
}

bool CrankClock::is_forward() const {
  double amplitude = 0.0;
  for (const SpeedOrder& one : orders) amplitude += std::abs(one.amplitude);
  return amplitude < speed;
}

}  // namespace clatter::dynamics
