// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Forces by a table over an angle that the motion decides, as pulses between stages need them.
#include <Eigen/Core>

namespace clatter::dynamics {

/// An angle [rad] and its rate [rad/s].
struct TurningAngle {
  double angle = 0.0, rate = 0.0;
};

/// What an element implements besides ForceElement where part of its force is a table over an
/// angle. The error estimate cannot see a pulse of the table that a step passes between its stages
/// (hard case S16).
class TableForce {
 public:
  virtual ~TableForce() = default;
  /// Whether there is a table; the functions below are of one that is there.
  virtual bool has_table() const { return true; }
  /// Where the table is read, at a time [s] and the element's coordinates y, v (n_e).
  virtual TurningAngle table_angle(double time, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& v) const = 0;
  /// The first row of the table above an angle [rad].
  virtual double next_row(double angle) const = 0;
  /// The force of the table on the element's first coordinate.
  virtual double by_table(double time, const TurningAngle& at) const = 0;
  /// Whether the opposite force is on the element's second coordinate.
  virtual bool has_reaction() const { return false; }
};

}  // namespace clatter::dynamics
