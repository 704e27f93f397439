// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pattern search for the best position of one node.
#include <Eigen/Core>
#include <limits>
#include <vector>

namespace clatter::mesh {

/// The 26 unit vectors to the neighbours of a cube's centre.
inline const std::vector<Eigen::Vector3d>& search_directions() {
  static const std::vector<Eigen::Vector3d> kDirections = [] {
    std::vector<Eigen::Vector3d> all;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        for (int k = -1; k <= 1; ++k) {
          if (i != 0 || j != 0 || k != 0) all.push_back(Eigen::Vector3d(i, j, k).normalized());
        }
      }
    }
    return all;
  }();
  return kDirections;
}

/// Moves a point while the score rises: tries all directions at each step length, keeps the best
/// position, halves the step. `point` is any reference-like view of the point that score(best)
/// reads; a score that is not above `best` need not be exact, so its computation may stop early.
/// Returns the best score.
template <class Point, class Score>
double search_position(Point point, double first_step, Score score) {
  constexpr int kHalvings = 7;  // the last step is about a hundredth of the first
  double best = score(-std::numeric_limits<double>::infinity());
  double step = first_step;
  for (int halving = 0; halving < kHalvings; ++halving, step *= 0.5) {
    const Eigen::Vector3d from = point.get();
    Eigen::Vector3d to = from;
    for (const Eigen::Vector3d& direction : search_directions()) {
      point.set(from + step * direction);
      const double value = score(best);
      if (value > best) {
        best = value;
        to = point.get();
      }
    }
    point.set(to);
  }
  return best;
}

}  // namespace clatter::mesh
