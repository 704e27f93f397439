// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The angle of the crankshaft, the clock of engine scenes.
#include <memory>
#include <numbers>
#include <vector>

#include "dynamics/given/drive.hpp"
#include "dynamics/given/motion.hpp"
#include "dynamics/given/periodic_spline.hpp"

namespace clatter::dynamics {

/// A crankshaft at 0 deg when time is 0. Its speed is w + sum_k a_k cos(k w t + p_k) with orders k
/// that are multiples of one half, or of a table (speed_table.hpp), so that each cycle of 720 deg
/// takes the same time.
struct CrankClock {
  double speed = 0.0;                // w, the mean [rad/s]
  std::vector<SpeedOrder> orders{};  // of its speed; none: it is constant
  /// Of a table: the angle over time less w t [rad], periodic in a cycle; null: none.
  std::shared_ptr<const PeriodicSpline> deviation{};

  bool is_uniform() const { return orders.empty() && !deviation; }
  double cycle() const { return 4.0 * std::numbers::pi / speed; }  // 720 deg [s]
  double angle(double time) const { return turn(time).position; }  // [rad]
  double angle_deg(double time) const { return angle(time) * 180.0 / std::numbers::pi; }
  /// Angle [rad], speed [rad/s] and acceleration [rad/s2].
  Motion<double> turn(double time) const;
  /// When the crank is at an angle [rad]; speeds must be positive.
  double time(double angle) const;
  /// The speed is positive at all times.
  bool is_forward() const;
};

}  // namespace clatter::dynamics
