// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/tie_rows.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/coupling/member_group.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly {
namespace {

constexpr double kNoMotion = 1e-14;    // entries of the rotation's rows that are rounding
constexpr double kOnALine = 1e-3;      // second moment of the weights, of that of the faces' extent
constexpr double kLeastWeight = 0.05;  // of the largest one, where the faces' other nodes count

double coefficient_of(const ProjectedNode& row, int32_t node) {
  const auto found = row.on.find(node);
  return found == row.on.end() ? 0.0 : std::abs(found->second);
}

/// Whether the combined masters lie on a line, or are one node.
bool is_on_a_line(const ProjectedNode& row, const RowMatrix& nodes) {
  double weight = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const auto& [node, value] : row.on) {
    weight += std::abs(value);
    centre += std::abs(value) * nodes.row(node).transpose();
  }
  centre /= weight;
  double extent = 0.0;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const int32_t node : row.around) {
    const Eigen::Vector3d arm = nodes.row(node).transpose() - centre;
    extent = std::max(extent, arm.squaredNorm());
    moments += coefficient_of(row, node) * arm * arm.transpose();
  }
  return dense::symmetric_eigen(moments).values(1) <= kOnALine * weight * extent;
}

/// What the rotation of the masters is the mean of: they with their coefficients. Those of
/// congruent faces lie on a line or at a point, which define none: there the faces' other nodes
/// count too.
std::vector<Member> turning_members(const ProjectedNode& row, const RowMatrix& nodes) {
  const bool widened = is_on_a_line(row, nodes);
  double largest = 0.0;
  for (const auto& [node, value] : row.on) largest = std::max(largest, std::abs(value));
  std::vector<Member> members;
  for (const int32_t node : row.around) {
    const double weight =
        std::max(coefficient_of(row, node), widened ? kLeastWeight * largest : 0.0);
    if (weight > 0.0)
      members.push_back({{3 * node, 3 * node + 1, 3 * node + 2, -1, -1, -1},
                         nodes.row(node).transpose(),
                         weight});
  }
  return members;
}

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
  const Coupling turn =
      distribute(turning_members(row, nodes), Eigen::Vector3d::Zero(), {3, 4, 5}, where);
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
