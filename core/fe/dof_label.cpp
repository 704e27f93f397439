// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/dof_label.hpp"

#include <fmt/format.h>

#include <cmath>

namespace clatter::fe {

std::string describe_dof(const FeModel& model, int32_t dof) {
  Eigen::Index row = -1;
  double largest = 0.0;
  for (SparseMatrix::InnerIterator it(model.T, dof); it; ++it) {
    if (std::abs(it.value()) <= largest) continue;
    largest = std::abs(it.value());
    row = it.row();
  }
  if (row < 0) return fmt::format("DoF {}", dof);
  const Eigen::RowVector3d at = model.nodes.row(row / 3);
  return fmt::format("node {} ({:.4g}, {:.4g}, {:.4g}) direction {}", row / 3, at.x(), at.y(),
                     at.z(), "xyz"[row % 3]);
}

}  // namespace clatter::fe
