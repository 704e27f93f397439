// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nodes and points that define a coupling, and their grouping on large faces.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "assembly/coupling/coupling.hpp"

namespace clatter::assembly {

/// A node or point with its DoFs in a coupling.
struct Member {
  std::array<int32_t, 6> dofs = {-1, -1, -1, -1, -1, -1};  // ids of x y z rx ry rz; -1: not coupled
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // [m]
  double weight = 0.0;                                     // > 0

  bool has(int d) const { return dofs[d] >= 0; }
};

/// Members represented by their weighted mean.
struct MemberGroup {
  std::vector<size_t> members;
  std::vector<double> shares;  // sum to one
  double weight = 0.0;         // sum of the members' weights
};

/// Single members when there are at most kLargeFace of them; else compact groups of at most
/// kGroupNodes that have the same DoFs. Members with rotations stay single.
std::vector<MemberGroup> group_members(const std::vector<Member>& members);

/// Nodes of a face with its consistent areas as weights. Corners of quadratic faces, whose area is
/// zero or negative, are omitted: a coupling needs positive weights, and only their ratios.
std::vector<Member> members_of(const RowMatrix& coordinates, const SurfaceIntegrals& surface);

/// Turns rows C (m x 6 groups, DoF d of group g in column 6 g + d) into rows and means of a
/// coupling; entries at rounding level are omitted.
void set_rows(const Eigen::MatrixXd& C, const std::vector<MemberGroup>& groups,
              const std::vector<Member>& members, Coupling& coupling);

}  // namespace clatter::assembly
