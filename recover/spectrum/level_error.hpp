// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Standard errors of levels that are means over segments.
#include <Eigen/Core>
#include <optional>
#include <vector>

namespace clatter::recover {

/// Standard errors of a level [dB], plain and A-weighted; absent of one segment.
struct LevelError {
  std::optional<double> db{}, dba{};
};

/// Standard error of the level of a mean power [dB]:
///
///   10 / ln 10  s / P,   s^2 = 1 / (n_e - 1)  1 / n sum_i (P_i - P)^2,   P = 1 / n sum_i P_i
///
/// n_e: equivalent_averages(). Segments without overlap have n_e = n, and s is the standard error
/// of the mean of n independent values (Guide to the Expression of Uncertainty in Measurement, JCGM
/// 100:2008, 4.2.3, and 5.1.2 for the level). Absent of
/// one segment and of powers that are 0.
/// @param powers P_i of the segments
std::optional<double> level_error_db(const std::vector<double>& powers, double averages);

/// The powers of the segments, each the sum of its lines.
class SegmentTotals {
 public:
  /// Sums over lines from `from_hz` on.
  explicit SegmentTotals(double from_hz) : from_hz_(from_hz) {}
  /// Line powers of one more segment.
  void add(const Eigen::VectorXd& frequency_hz, const Eigen::VectorXd& power);
  LevelError error(double averages) const {
    return {level_error_db(plain_, averages), level_error_db(weighted_, averages)};
  }

 private:
  double from_hz_;
  std::vector<double> plain_{}, weighted_{};
};

}  // namespace clatter::recover
