// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The angle of the crankshaft, the clock of engine scenes.
#include <numbers>

namespace clatter::dynamics {

/// A crankshaft at constant speed, at 0 deg when time is 0.
struct CrankClock {
  double speed = 0.0;  // omega [rad/s]

  double cycle() const { return 4.0 * std::numbers::pi / speed; }  // 720 deg [s]
  double angle_deg(double time) const { return speed * time * 180.0 / std::numbers::pi; }
};

}  // namespace clatter::dynamics
