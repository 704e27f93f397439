// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/point_mass.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/dof_numbers.hpp"
#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

/// 0 ... 5: which of x y z rx ry rz a coordinate of a reference node is.
int dof_of(const rom::DofSet& set, size_t k) {
  Eigen::Index axis = 0;
  set.direction.row(static_cast<Eigen::Index>(k)).cwiseAbs().maxCoeff(&axis);
  return static_cast<int>(axis) + (set.is_rotation[k] != 0 ? 3 : 0);
}

SparseMatrix six_rows(const SparseMatrix& T, Eigen::Index row) {
  return SparseMatrix(SparseMatrix(T.transpose()).middleCols(row, 6)).transpose();
}

void check_takes(const PointMassSpec& spec, const rom::DofSet& set) {
  if (set.kind == "contact_grid" || set.kind == "mean" || set.kind == "bolt")
    throw InputError(fmt::format("{}: found a set of kind {}, expected a coupling, point or nodes",
                                 spec.where, set.kind));
  for (size_t k = 0; k < set.dofs.size(); ++k)
    if (!has_rotations(set) && dof_of(set, k) != static_cast<int>(k % 3))
      throw InputError(
          fmt::format("{}: found {}, expected x y z of each node", spec.where, set.labels[k]));
  if (has_rotations(set) ? set.dofs.size() > 6 : set.dofs.size() % 3 != 0)
    throw InputError(fmt::format("{}: found {} directions, expected x y z of nodes, or one point",
                                 spec.where, set.dofs.size()));
  const bool needs_turn = !spec.inertia.isZero(0.0) || !spec.offset.isZero(0.0);
  if (needs_turn && !has_rotations(set))
    throw InputError(
        fmt::format("{}: found an inertia or offset on a set without rotations, expected a "
                    "coupling with six directions",
                    spec.where));
}

}  // namespace

bool has_rotations(const rom::DofSet& set) {
  return std::any_of(set.is_rotation.begin(), set.is_rotation.end(), [](int r) { return r != 0; });
}

Eigen::Matrix<double, 6, 6> mass_block(const PointMassSpec& spec) {
  const Eigen::Matrix<double, 3, 6> R = rigid_motion(spec.offset);
  Eigen::Matrix<double, 6, 6> block = spec.mass * R.transpose() * R;
  block.bottomRightCorner<3, 3>() += spec.inertia;
  return block;
}

void add_to_set(SparseMatrix& M, const PointMassSpec& spec, const rom::DofSet& set) {
  check_takes(spec, set);
  if (!has_rotations(set)) {
    const double share = spec.mass / static_cast<double>(set.dofs.size() / 3);
    for (const int32_t dof : set.dofs) M.coeffRef(dof, dof) += share;
    return;
  }
  const Eigen::Matrix<double, 6, 6> block = mass_block(spec);
  std::array<int32_t, 6> dofs;
  dofs.fill(-1);
  for (size_t k = 0; k < set.dofs.size(); ++k) dofs[dof_of(set, k)] = set.dofs[k];
  for (int a = 0; a < 6; ++a) {
    const int32_t row = dofs[a];
    if (row < 0 && block(a, a) > 0.0)
      throw InputError(fmt::format("{}: found no coordinate {} that moves the mass, expected one",
                                   spec.where, kDofNames[a]));
    for (int b = 0; b < 6; ++b) {
      const int32_t col = dofs[b];
      if (row >= col && col >= 0 && block(a, b) != 0.0) M.coeffRef(row, col) += block(a, b);
    }
  }
}

void add_to_point(SparseMatrix& M, const PointMassSpec& spec, const SparseMatrix& T,
                  Eigen::Index row) {
  const SparseMatrix T_p = six_rows(T, row);
  const SparseMatrix block = mass_block(spec).eval().sparseView();
  const SparseMatrix change = SparseMatrix(T_p.transpose()) * SparseMatrix(block * T_p);
  M += SparseMatrix(change.triangularView<Eigen::Lower>());
}

void add_between(SparseMatrix& M_sq, const PointMassSpec& spec, const SparseMatrix& T_s,
                 const SparseMatrix& T, Eigen::Index row) {
  const SparseMatrix block = mass_block(spec).eval().sparseView();
  M_sq += SparseMatrix(six_rows(T_s, row).transpose()) * SparseMatrix(block * six_rows(T, row));
}

void add_moments(MassMoments& moments, const PointMassSpec& spec, const rom::DofSet& set) {
  const size_t nodes = has_rotations(set) ? 1 : set.dofs.size() / 3;
  for (size_t p = 0; p < nodes; ++p)
    add_point(moments, spec.mass / static_cast<double>(nodes),
              set.position.row(static_cast<Eigen::Index>(3 * p)).transpose() + spec.offset,
              spec.inertia);
}

}  // namespace clatter::assembly
