// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/tie_rows.hpp"

#include <cmath>

#include "assembly/coupling/member_group.hpp"
#include "assembly/coupling/rigid_coupling.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoMotion = 1e-14;  // entries of the rotation's rows that are rounding

}  // namespace

void add(double factor, const Functional& of, Functional& to) {
  if (factor == 0.0) return;
  to.dofs.insert(to.dofs.end(), of.dofs.begin(), of.dofs.end());
  for (const double value : of.values) to.values.push_back(factor * value);
}

Eigen::Vector3d arm_of(const ProjectedNode& row, const Eigen::Vector3d& at,
                       const RowMatrix& nodes) {
  Eigen::Vector3d arm = at;
  for (const auto& [node, value] : row.on) arm -= value * nodes.row(node).transpose();
  return arm;
}

PointMotion rotation_rows(const ProjectedNode& row, const Eigen::Vector3d& arm,
                          const RowMatrix& nodes, const std::string& where) {
  std::vector<Member> members;
  for (const auto& [node, value] : row.on)
    members.push_back({{3 * node, 3 * node + 1, 3 * node + 2, -1, -1, -1},
                       nodes.row(node).transpose(),
                       std::abs(value)});
  const Coupling turn = distribute(members, Eigen::Vector3d::Zero(), {3, 4, 5}, where);
  const Eigen::Matrix3d lever = rigid_motion(arm).rightCols<3>();  // theta x arm
  const std::vector<Functional> theta = turn.nodal_rows();
  PointMotion rows;
  for (int d = 0; d < 3; ++d)
    for (int r = 0; r < 3; ++r)
      for (size_t k = 0; k < theta[r].dofs.size(); ++k) {
        const double value = lever(d, r) * theta[r].values[k];
        if (std::abs(value) <= kNoMotion) continue;
        rows[d].dofs.push_back(theta[r].dofs[k]);
        rows[d].values.push_back(value);
      }
  return rows;
}

void add_masters(const ProjectedNode& row, PointMotion& motion) {
  for (int d = 0; d < 3; ++d)
    for (const auto& [node, value] : row.on) {
      motion[d].dofs.push_back(3 * node + d);
      motion[d].values.push_back(value);
    }
}

}  // namespace clatter::assembly
