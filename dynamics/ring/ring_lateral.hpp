// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The lateral motion of an elastic liner at the height of a ring.
#include <Eigen/Core>
#include <vector>

#include "dynamics/film/gap.hpp"

namespace clatter::dynamics {

/// Mean lateral displacement (x, y) of the bore's wall around a ring, 2/n sum n_c u_c over n cells
/// with outward normals n_c, in the coordinates [patches | fit] of the liner (film::PatchMap). It
/// is exact for rigid motions; its transpose spreads a lateral force over the patches beside the
/// ring, as a pressure that follows the cosine, with exactly that resultant.
class RingLateral {
 public:
  /// @param liner of the block. @param height of the ring above the pin's centre [m]. @param radius
  /// of the bore [m].
  RingLateral(const film::ElasticSurface& liner, double height, double radius);

  /// Finds the rows where the pin's centre is at engine z `stroke` [m].
  void move(double stroke);
  /// The columns of [patches | fit] in which the rows have entries, ascending.
  const std::vector<int>& columns() const { return columns_; }
  /// 2 x columns().size(): (x, y) by the coordinates, and its derivative by the height [1/m].
  const Eigen::Matrix2Xd& rows() const { return rows_; }
  const Eigen::Matrix2Xd& slope() const { return slope_; }

 private:
  film::PadGrid cells_;
  film::PatchMap map_;
  film::SparseRows by_cell_, by_cell_slope_;
  std::vector<int> columns_, place_;
  Eigen::Matrix2Xd rows_, slope_;
  double stroke_;
};

}  // namespace clatter::dynamics
