// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The torque that holds the mean speed of a free crank.
#include <vector>

namespace clatter::dynamics {

/// A load torque L that is constant in each cycle and holds the mean of the deviation d of the
/// crank's angle, and of its rate. In a cycle of length T
///
///   Q = L + I (d'_end - d'_begin) / T                     the mean of all other torques
///   a = (Q - L) / I,  v = (d_end - d_begin) / T + a T/2,  m = mean of d + (d_end - d_begin)/2
///                                                             + a T^2/12
///
/// are acceleration, speed and angle at its end without what repeats in each cycle, and the next
/// cycle has L = Q + I (3 v / (2 T) + m / T^2): where Q stays the same, speed and angle are those
/// of the clock after two cycles (dead-beat control of a double integrator).
class MeanTorque {
 public:
  /// @param first L of the first cycle [N m]. @param inertia I [kg m2]. @param cycle T [s].
  MeanTorque(double first, double inertia, double cycle)
      : torque_(first), inertia_(inertia), cycle_(cycle) {}
  double torque() const { return torque_; }
  void begin_step(double time);
  /// A step ended at `time` with the deviation `angle` [rad] and its rate [rad/s].
  void accept_step(double time, double angle, double rate);
  std::vector<double> save() const { return {torque_, angle_, rate_}; }
  /// The state at the begin of a cycle, three numbers.
  void restore(const std::vector<double>& state);

 private:
  double torque_, inertia_, cycle_;
  bool counting_ = false;
  double angle_ = 0.0, rate_ = 0.0;  // at the end of the last step
  double begin_ = 0.0, first_angle_ = 0.0, first_rate_ = 0.0, time_ = 0.0, integral_ = 0.0;
};

}  // namespace clatter::dynamics
