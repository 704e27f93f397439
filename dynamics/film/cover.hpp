// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which part of a skirt's pad is inside the liner.
#include <Eigen/Core>
#include <limits>

#include "dynamics/film/grid.hpp"

namespace clatter::film {

/// Ends of a liner, engine z [m]; infinite: none.
struct LinerEnds {
  double bottom = -std::numeric_limits<double>::infinity();
  double top = std::numeric_limits<double>::infinity();
};

/// Covered fractions of the rows of a pad's cells and of the edges between them, with their
/// derivatives by the pad's height.
struct Cover {
  Eigen::ArrayXd share;             // w of each row [1], n_axial; 0: outside the liner
  Eigen::ArrayXd share_slope;       // dw/dz [1/m]
  Eigen::ArrayXd share_curve;       // d2w/dz2 [1/m2]
  Eigen::ArrayXd edge, edge_slope;  // H at the lower edge of each row and the pad's top [1],
                                    // dH/dz [1/m], n_axial + 1
  Eigen::ArrayXd of_cells(int n_angle) const { return share.replicate(n_angle, 1); }  // w, n
};

/// Cover of a pad by a liner with ends.
///
///   H(z) = S((z - bottom)/b + 1/2) + S((top - z)/b + 1/2) - 1,   w_j = mean of H over row j,
///   S(x) = 3 x^2 - 2 x^3 on (0, 1), 0 below, 1 above
///
/// An end is smoothed over b, the height of one row of cells, so that w has two continuous
/// derivatives while a row passes it. The mean of S over any interval around 1/2 is exact: once
/// the pad reaches half a row beyond an end, the sum of w times the height of a row is the covered
/// length. Rows that are entirely inside have w = 1 to the bit.
class CoverMap {
 public:
  /// InputError unless top is at least two rows above bottom.
  CoverMap(const LinerEnds& ends, const PadGrid& pad);
  /// Writes the cover of the pad whose z = 0 is at engine z `height` [m].
  void at(double height, Cover& cover) const;

 private:
  LinerEnds ends_;
  Eigen::VectorXd edges_;  // of the rows [m]
  double width_;           // b [m]
};

}  // namespace clatter::film
