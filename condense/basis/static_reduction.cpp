// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/static_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/progress.hpp"
#include "core/dense/least_squares.hpp"
#include "core/fe/dof_label.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double norm_of(const MatrixXd& x, const sparse::RowTeam& team) {
  return std::sqrt(team.sum(x.squaredNorm()));
}

/// Removes rounding in Psi from the mass properties. Psi + E P represents the rigid motions, where
/// E = r_i - Psi r_b and P = r_b^+ give the change of least norm; the kept rows get this change,
/// and M_bb the symmetric change of least rank that gives it the momentum of these motions.
void carry_rigid_motions(const PartitionedModel& part, const sparse::Factor& factor_ii,
                         const RigidMotions& rigid, const std::vector<int32_t>& kept,
                         StaticReduction& out) {
  const PartitionedMatrix &K = part.K, &M = part.M;
  const sparse::RowTeam& team = part.team();
  const MatrixXd &r_b = rigid.at_boundary, &r_i = rigid.inside;
  out.rigid_error = norm_of(r_i + factor_ii.solve(K.ib * r_b), team) / norm_of(r_i, team);
  const MatrixXd P = dense::pseudo_inverse(r_b);
  const MatrixXd left = r_i(kept, Eigen::all) - out.rows * r_b;
  out.rows += left * P;

  const MatrixXd inertia = *part.interior().mass({}) * r_i + M.ib * r_b;
  const MatrixXd carried = -factor_ii.boundary_product(inertia);  // Psi^T f
  const MatrixXd momentum =
      M.bb * r_b + team.sum(M.ib.transpose() * r_i) + carried +
      P.transpose() * (team.sum(r_i.transpose() * inertia) - r_b.transpose() * carried);
  const MatrixXd change = (momentum - out.M_bb * r_b) * P;
  out.M_bb += change + change.transpose() - P.transpose() * (r_b.transpose() * change);
  out.M_bb = (0.5 * (out.M_bb + out.M_bb.transpose())).eval();
}

InteriorFactor factorised(const PartitionedModel& part) {
  try {
    return part.factor_interior();
  } catch (const sparse::NotPositiveDefinite& error) {
    const std::string where =
        error.column < 0 ? std::string{}
                         : ", at " + fe::describe_dof(part.full, part.dofs.interior[error.column]);
    throw sparse::NotPositiveDefinite(
        fmt::format("the boundary does not hold the body: K_ii {}{}; add a set to the boundary, or "
                    "look for a part of the mesh that is not connected",
                    error.what(), where),
        error.column);
  }
}

}  // namespace

StaticShapes shapes_by_solves(const PartitionedModel& part, const sparse::Factor& factor_ii,
                              const std::vector<int32_t>& kept) {
  constexpr Index kBlock = 64;
  const SparseMatrix &K_ib = part.K.ib, &M_ib = part.M.ib;
  const auto mass = part.interior().mass({});
  const Index n_b = K_ib.cols();
  StaticShapes out;
  out.M_bb = part.M.bb;
  out.rows.resize(static_cast<Index>(kept.size()), n_b);
  Progress progress("constraint modes", static_cast<double>(n_b));
  for (Index first = 0; first < n_b; first += kBlock) {
    const Index count = std::min(kBlock, n_b - first);
    const MatrixXd Psi = -factor_ii.solve(MatrixXd(K_ib.middleCols(first, count)));
    out.rows.middleCols(first, count) = Psi(kept, Eigen::all);
    const MatrixXd inertia = *mass * Psi + MatrixXd(M_ib.middleCols(first, count));
    out.M_bb.middleCols(first, count) +=
        part.team().sum(M_ib.transpose() * Psi) - factor_ii.boundary_product(inertia);
    progress.update(static_cast<double>(first + count));
  }
  out.M_bb = (0.5 * (out.M_bb + out.M_bb.transpose())).eval();
  return out;
}

StaticReduction reduce_statically(const PartitionedModel& part, const sparse::Factor& factor_ii,
                                  const RigidMotions& rigid, const std::vector<int32_t>& kept,
                                  StaticMass method) {
  StaticReduction out;
  const bool all_rows_here = part.interior().local() != nullptr;
  static_cast<StaticShapes&>(out) =
      all_rows_here ? sweep_shapes(dynamic_cast<const sparse::SupernodalFactor&>(factor_ii), part.M,
                                   kept, method)
                    : shapes_by_solves(part, factor_ii, kept);
  out.K_bb = part.K.bb - factor_ii.boundary_part();
  if (rigid.at_boundary.cols() > 0) carry_rigid_motions(part, factor_ii, rigid, kept, out);
  return out;
}

StaticPart static_part(const PartitionedModel& part, const std::vector<int32_t>& kept,
                       StepClock& clock) {
  StaticPart out{factorised(part), {}};
  clock.lap(fmt::format("factor of K_ii ({:.3g} entries{})", static_cast<double>(out.order.entries),
                        out.order.method == "given" ? ", stored order" : ""));
  const Eigen::MatrixXd& motions = part.free.q;
  const RigidMotions rigid{motions(part.dofs.boundary, Eigen::all),
                           motions(part.dofs.interior, Eigen::all)};
  out.reduction = reduce_statically(part, *out.factor_ii, rigid, kept);
  clock.lap(fmt::format("{} constraint modes", part.dofs.boundary.size()));
  return out;
}

}  // namespace clatter::condense
