// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Measured or computed rotation of a shaft over time.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/given/motion.hpp"

namespace clatter::dynamics {

/// Angle over time as piecewise polynomials, so that speed and acceleration are its exact
/// derivatives and the acceleration is continuous. Before the first and after the last time the
/// shaft keeps the speed that it has there.
class TurnTable {
 public:
  /// By speeds [rad/s]: monotone cubics (Fritsch and Butland 1984), integrated; the angle is 0 at
  /// the first time. @param time ascending, at least two [s].
  static TurnTable of_speed(std::vector<double> time, const std::vector<double>& speed);
  /// By angles [rad]: the natural cubic spline.
  static TurnTable of_angle(std::vector<double> time, const std::vector<double>& angle);

  /// Angle [rad], speed [rad/s], acceleration [rad/s2].
  Motion<double> at(double time) const;

 private:
  explicit TurnTable(std::vector<double> time) : time_(std::move(time)) {}
  std::vector<double> time_;
  std::vector<std::array<double, 5>> piece_;  // coefficients of powers of the time since its start
};

/// Reads a table over time [s] that must cover [begin, end]: a column in rad/s or rpm is a speed,
/// one in rad or deg an angle. Angles that begin anew after a turn or a cycle, as 0 .. 359, 0 ..,
/// are refused, or with `unwrap` go on in whole turns. InputError "file:line: ..." otherwise.
TurnTable read_turn_table(const std::filesystem::path& path, const std::string& column, bool unwrap,
                          double begin, double end);

}  // namespace clatter::dynamics
