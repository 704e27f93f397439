// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/truncation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/base/error.hpp"
#include "core/base/progress.hpp"
#include "core/dense/solve.hpp"
#include "core/fe/part_errors.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index kBlock = 64;

/// H^T K_ii^{-1} H, n_b x n_b.
MatrixXd work_of_inertia(const sparse::Factor& factor_ii, const PartitionedModel& part) {
  const SparseMatrix &K_ib = part.K.ib, &M_ib = part.M.ib;
  const auto mass = part.interior().mass({});
  const Index n_b = K_ib.cols();
  MatrixXd work(n_b, n_b);
  Progress progress("truncation", static_cast<double>(n_b));
  for (Index first = 0; first < n_b; first += kBlock) {
    const Index count = std::min(kBlock, n_b - first);
    const MatrixXd Psi = -factor_ii.solve(MatrixXd(K_ib.middleCols(first, count)));
    const MatrixXd H = *mass * Psi + MatrixXd(M_ib.middleCols(first, count));
    const MatrixXd response = factor_ii.solve(H);
    work.middleCols(first, count) =
        part.team().sum(M_ib.transpose() * response) - factor_ii.boundary_product(*mass * response);
    progress.update(static_cast<double>(first + count));
  }
  return work;
}

/// All of them know their truncation, and one process has all rows.
void check_parts(const PartitionedModel& part) {
  const std::string& name = part.full.name;
  if (const std::string without = fe::parts_without_truncation(part.full.parts); !without.empty())
    throw InputError(
        fmt::format("{}: joined_error: found parts without it: {}, expected joined_error = true in "
                    "their rom.toml too",
                    name, without));
  if (part.interior().local() == nullptr)
    throw InputError(fmt::format(
        "{}: joined_error: found an assembly of reduced parts shared by several processes, "
        "expected one process: clatter-condense",
        name));
}

}  // namespace

MatrixXd truncation(const Reduction& reduction, const sparse::Factor& factor_ii,
                    const PartitionedModel& part) {
  if (!part.full.parts.list.empty()) check_parts(part);
  const Index n_b = reduction.basis.boundary(), r = reduction.basis.size(), k = r - n_b;
  MatrixXd out = MatrixXd::Zero(r, r);
  out.topLeftCorner(n_b, n_b) = work_of_inertia(factor_ii, part);
  if (k > 0) {
    const MatrixXd of_shapes = reduction.M_rr.bottomLeftCorner(k, n_b);  // X^T H
    out.topLeftCorner(n_b, n_b) -=
        of_shapes.transpose() *
        dense::solve_symmetric(reduction.K_rr.bottomRightCorner(k, k), of_shapes);
  }
  for (const fe::FePart& one : part.full.parts.list)
    out += reduction.basis.congruence(one.truncation);
  return 0.5 * (out + out.transpose());
}

}  // namespace clatter::condense
