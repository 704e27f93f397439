// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Lift of a cam over its angle.
#include <filesystem>
#include <string>
#include <variant>

#include "dynamics/given/periodic_spline.hpp"

namespace clatter::dynamics {

/// Lift of a valve (or follower) over the angle of its cam, with period 2 pi: value [m] and
/// derivatives by the angle [m/rad], ...
class CamLaw {
 public:
  /// y = h (1 - x^2)^3, x = angle / half_angle, full lift at angle 0; its second derivative is
  /// continuous. @param half_angle at most pi [rad]. @param lift h [m].
  static CamLaw polynomial(double lift, double half_angle);
  /// A table over one turn.
  static CamLaw table(PeriodicSpline spline);
  /// Any angle; it is taken modulo one turn.
  SplinePoint at(double angle) const;

 private:
  struct Polynomial {
    double lift, half_angle;
  };
  explicit CamLaw(std::variant<Polynomial, PeriodicSpline> law);
  std::variant<Polynomial, PeriodicSpline> law_;
};

/// Reads a periodic table over an angle, as CSV: `column` (or, when empty, the second one) in
/// `unit` over one period of the angle, with or without a closing row. InputError "file:line: ...".
/// @param period [rad]. @param degree of the spline, 3 or 5.
PeriodicSpline read_angle_table(const std::filesystem::path& path, const std::string& column,
                                const std::string& unit, double period, int degree);

/// A lift table [m] over one turn of the cam. InputError also for a lift below zero.
CamLaw read_cam_table(const std::filesystem::path& path, const std::string& column, int degree);

}  // namespace clatter::dynamics
