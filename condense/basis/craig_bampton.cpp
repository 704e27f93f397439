// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/craig_bampton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/log.hpp"

namespace clatter::condense {
namespace {

/// Drops vectors that depend on others.
void drop_dependent(CraigBampton& source) {
  ReducedBasis& basis = source.basis;
  const std::vector<int> kept = independent_columns(source.M_rr, basis.boundary());
  source.dropped = static_cast<int>(basis.size()) - static_cast<int>(kept.size());
  if (source.dropped == 0) return;
  warn(fmt::format("{} basis vectors depend on others and were dropped", source.dropped));
  std::vector<int> modes;
  for (const int j : kept) {
    if (j >= basis.boundary()) modes.push_back(j - static_cast<int>(basis.boundary()));
  }
  source.fixed_interface_hz = source.fixed_interface_hz(modes).eval();
  basis.shapes = basis.shapes(Eigen::all, modes).eval();
  source.M_rr = source.M_rr(kept, kept).eval();
  source.K_rr = source.K_rr(kept, kept).eval();
}

}  // namespace

CraigBampton craig_bampton(const PartitionedModel& part, const StaticPart& statics,
                           const ModeRequest& request, StepClock& clock) {
  const sparse::Factor& factor = *statics.factor_ii;
  CraigBampton out;
  out.factor = factor.report();
  out.rigid_error = statics.reduction.rigid_error;
  out.interior = interior_modes(part, factor, request, clock);
  out.fixed_interface_hz = out.interior.hz;
  out.basis = ReducedBasis(part, statics.factor_ii);
  out.basis.shapes.swap(out.interior.vectors);
  out.interior.vectors.resize(0, 0);
  static_cast<ReducedMatrices&>(out) = project(part, statics.reduction, out.basis);
  clock.lap("reduced matrices");
  const bool guyan = request.count == 0 && request.fmax_hz == 0.0;
  const double target = guyan ? 0.0 : request.frequency_error;
  if (target > 0.0 || request.estimate_error) {
    out.residual =
        add_residual_modes(out, factor, part, part.free.q(part.dofs.boundary, Eigen::all),
                           out.interior.accurate_to_hz, target);
    const Eigen::Index shapes = out.fixed_interface_hz.size();
    out.fixed_interface_hz.conservativeResize(shapes + out.residual.hz.size());
    out.fixed_interface_hz.tail(out.residual.hz.size()) = out.residual.hz;
    clock.lap(fmt::format("{} residual modes", out.residual.hz.size()));
  }
  drop_dependent(out);
  return out;
}

std::vector<int> independent_columns(const Eigen::MatrixXd& M_rr, Eigen::Index protected_count,
                                     double tolerance) {
  const Eigen::Index r = M_rr.rows();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(r, r);  // rows of the kept columns' Cholesky factor
  std::vector<int> kept;
  for (Eigen::Index j = 0; j < r; ++j) {
    const auto rank = static_cast<Eigen::Index>(kept.size());
    Eigen::VectorXd row = M_rr.col(j)(kept);
    L.topLeftCorner(rank, rank).triangularView<Eigen::Lower>().solveInPlace(row);
    const double left = M_rr(j, j) - row.squaredNorm();
    if (j >= protected_count && left <= tolerance * M_rr(j, j)) continue;
    L.row(rank).head(rank) = row.transpose();
    L(rank, rank) = std::sqrt(std::max(left, 1e-300));
    kept.push_back(static_cast<int>(j));
  }
  return kept;
}

}  // namespace clatter::condense
