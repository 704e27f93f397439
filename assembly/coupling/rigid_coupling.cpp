// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/rigid_coupling.hpp"

namespace clatter::assembly {

std::vector<Dependence> rigid_dependences(const DofNumbers& numbers, NodeOrPoint owner,
                                          const std::vector<int>& directions,
                                          const ReferenceDofs& reference) {
  Eigen::Matrix<double, 6, 6> motion = Eigen::Matrix<double, 6, 6>::Identity();
  motion.topRows<3>() = rigid_motion(numbers.position(owner), reference.position);
  std::vector<Dependence> out;
  for (const int d : directions) {
    Dependence one;
    one.dof = numbers.of(owner, d);
    if (one.dof < 0) continue;
    for (int r = 0; r < 6; ++r) {
      if (motion(d, r) == 0.0) continue;
      one.on.dofs.push_back(reference.ids[r]);
      one.on.values.push_back(motion(d, r));
    }
    // A node that is its own reference.
    if (one.on.dofs.size() == 1 && one.on.dofs[0] == one.dof) continue;
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace clatter::assembly
