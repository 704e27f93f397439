// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Prescribed rotation of a shaft.
#include <memory>
#include <vector>

#include "dynamics/given/motion.hpp"
#include "dynamics/given/turn_table.hpp"

namespace clatter::dynamics {

/// One order of a fluctuating speed: amplitude cos(order * mean speed * t + phase).
struct SpeedOrder {
  double order = 1.0;      // per turn of the shaft
  double amplitude = 0.0;  // [rad/s]
  double phase = 0.0;      // [rad]
};

/// A shaft that turns at a mean speed with orders:
///   speed = mean + sum_k a_k cos(k mean t + p_k),  angle = start + its integral from t = 0.
class Drive {
 public:
  /// @param mean [rad/s]. @param start angle at t = 0 [rad]. InputError for a mean speed of zero
  /// with orders, which then have no frequency, and for orders that are not positive.
  explicit Drive(double mean, double start = 0.0, std::vector<SpeedOrder> orders = {});
  /// By a table of its own. @param start is added to its angle [rad].
  explicit Drive(TurnTable table, double start = 0.0);
  /// Angle less whole turns [rad], so that it keeps its digits over hours (hard case TD14); speed
  /// [rad/s], acceleration [rad/s2].
  Motion<double> at(double time) const;
  /// After `cycle` [s] it and each of its orders have made whole turns; never by a table.
  bool repeats(double cycle) const;

 private:
  double mean_, start_;
  std::vector<SpeedOrder> orders_;
  std::shared_ptr<const TurnTable> table_;  // if any, in place of mean and orders
};

}  // namespace clatter::dynamics
