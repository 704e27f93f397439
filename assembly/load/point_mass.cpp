// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/point_mass.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/coupling/coupling.hpp"
#include "assembly/coupling/dof_numbers.hpp"
#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

/// Coordinates of one node by its x y z rx ry rz.
Eigen::Matrix<double, Eigen::Dynamic, 6> axes_of(const rom::DofSet& set) {
  const auto n = static_cast<Eigen::Index>(set.dofs.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> axes = Eigen::MatrixXd::Zero(n, 6);
  for (Eigen::Index k = 0; k < n; ++k)
    axes.row(k).segment<3>(set.is_rotation[static_cast<size_t>(k)] != 0 ? 3 : 0) =
        set.direction.row(k);
  return axes;
}

SparseMatrix six_rows(const SparseMatrix& T, Eigen::Index row) {
  return SparseMatrix(SparseMatrix(T.transpose()).middleCols(row, 6)).transpose();
}

void check_takes(const PointMassSpec& spec, const rom::DofSet& set) {
  if (set.kind == "contact_grid" || set.kind == "mean" || set.kind == "bolt")
    throw InputError(fmt::format("{}: found a set of kind {}, expected a coupling, point or nodes",
                                 spec.where, set.kind));
  constexpr double kAcross = 1e-9;  // of two directions
  for (size_t k = 0; !has_rotations(set) && k + 2 < set.dofs.size(); k += 3) {
    const Eigen::Matrix3d axes = set.direction.middleRows<3>(static_cast<Eigen::Index>(k));
    if (!(axes * axes.transpose()).isIdentity(kAcross))
      throw InputError(
          fmt::format("{}: found {}, expected x y z of each node", spec.where, set.labels[k]));
  }
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
  constexpr double kLeft = 1e-9;  // of a direction that no coordinate has
  const Eigen::Matrix<double, 6, 6> block = mass_block(spec);
  const Eigen::Matrix<double, Eigen::Dynamic, 6> axes = axes_of(set);
  const Eigen::Matrix<double, 6, 6> left =
      Eigen::Matrix<double, 6, 6>::Identity() - axes.transpose() * axes;
  for (int a = 0; a < 6; ++a)
    if (left.row(a).norm() > kLeft && left.row(a) * block * left.row(a).transpose() > 0.0)
      throw InputError(fmt::format("{}: found no coordinate {} that moves the mass, expected one",
                                   spec.where, kDofNames[a]));
  const Eigen::MatrixXd own = axes * block * axes.transpose();
  for (size_t a = 0; a < set.dofs.size(); ++a)
    for (size_t b = 0; b < set.dofs.size(); ++b) {
      const double value = own(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      if (set.dofs[a] >= set.dofs[b] && value != 0.0) M.coeffRef(set.dofs[a], set.dofs[b]) += value;
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
