// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Oil that left a pad over its edges.
#include <Eigen/Core>

namespace clatter::film {

/// What a pad moved over its edges in a step, volumes out of the pad [m3].
struct EdgeVolumes {
  Eigen::ArrayXd lower, upper;     // over its first and last axial edge, by column, n_angle
  double sides = 0.0, ends = 0.0;  // net, over its angular edges and over the ends of the liner
  double sides_moved = 0.0, ends_moved = 0.0;   // the same without sign
  double recesses = 0.0, recesses_moved = 0.0;  // into grooves, net and without sign
};

}  // namespace clatter::film
