// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/static_reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/progress.hpp"
#include "core/dense/least_squares.hpp"
#include "core/fe/dof_label.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// What carry_rigid_motions needs of the matrices.
struct BoundaryBlocks {
  const PartitionedMatrix& K;
  const PartitionedMatrix& M;
  const sparse::SymmetricOperator& M_ii;
  const sparse::RowTeam& team;
};

double norm_of(const MatrixXd& x, const sparse::RowTeam& team) {
  return std::sqrt(team.sum(x.squaredNorm()));
}

/// Removes rounding in Psi from the mass properties. Psi + E P represents the rigid motions, where
/// E = r_i - Psi r_b and P = r_b^+ give the change of least norm; the kept rows get this change,
/// and M_bb the symmetric change of least rank that gives it the momentum of these motions.
void carry_rigid_motions(const sparse::Factor& factor_ii, const BoundaryBlocks& blocks,
                         const RigidMotions& rigid, const std::vector<int32_t>& kept,
                         StaticReduction& out) {
  const auto& [K, M, M_ii, team] = blocks;
  const MatrixXd &r_b = rigid.at_boundary, &r_i = rigid.inside;
  out.rigid_error = norm_of(r_i + factor_ii.solve(K.ib * r_b), team) / norm_of(r_i, team);
  const MatrixXd P = dense::pseudo_inverse(r_b);
  const MatrixXd left = r_i(kept, Eigen::all) - out.rows * r_b;
  out.rows += left * P;

  const MatrixXd inertia = M_ii * r_i + M.ib * r_b;
  const MatrixXd carried = -factor_ii.boundary_product(inertia);  // Psi^T f
  const MatrixXd momentum =
      M.bb * r_b + team.sum(M.ib.transpose() * r_i) + carried +
      P.transpose() * (team.sum(r_i.transpose() * inertia) - r_b.transpose() * carried);
  const MatrixXd change = (momentum - out.M_bb * r_b) * P;
  out.M_bb += change + change.transpose() - P.transpose() * (r_b.transpose() * change);
  out.M_bb = (0.5 * (out.M_bb + out.M_bb.transpose())).eval();
}

std::shared_ptr<const sparse::SupernodalFactor> factorise_interior(
    const PartitionedModel& part, const rom::EliminationOrder& order) {
  try {
    sparse::FactorOptions options;
    if (order.fits(part.K.ii))
      options.permutation.assign(order.permutation.begin(), order.permutation.end());
    return std::make_shared<sparse::SupernodalFactor>(part.K.ii, part.K.ib, options);
  } catch (const sparse::NotPositiveDefinite& error) {
    const std::string where =
        error.column < 0
            ? std::string{}
            : ", at " + fe::describe_dof(part.full,
                                         part.dofs.interior[static_cast<size_t>(error.column)]);
    throw sparse::NotPositiveDefinite(
        fmt::format("the boundary does not hold the body: K_ii {}{}; add a set to the boundary, or "
                    "look for a part of the mesh that is not connected",
                    error.what(), where),
        error.column);
  }
}

rom::EliminationOrder order_of(const sparse::SupernodalFactor& factor, const SparseMatrix& K_ii) {
  const std::vector<int64_t> permutation = factor.permutation();
  return {{permutation.begin(), permutation.end()},
          rom::sha256_of_pattern(K_ii),
          factor.report().ordering,
          factor.report().entries};
}

}  // namespace

StaticReduction reduce_statically(const sparse::SupernodalFactor& factor_ii,
                                  const PartitionedMatrix& K, const PartitionedMatrix& M,
                                  const RigidMotions& rigid, const std::vector<int32_t>& kept,
                                  StaticMass method) {
  StaticReduction out;
  static_cast<StaticShapes&>(out) = sweep_shapes(factor_ii, M, kept, method);
  out.K_bb = K.bb - factor_ii.boundary_part();
  if (rigid.at_boundary.cols() > 0)
    carry_rigid_motions(factor_ii, {K, M, sparse::SymmetricProduct(M.ii), sparse::one_process()},
                        rigid, kept, out);
  return out;
}

StaticReduction reduce_by_solves(const sparse::Factor& factor_ii, const PartitionedModel& part,
                                 const RigidMotions& rigid, const std::vector<int32_t>& kept) {
  constexpr Index kBlock = 64;
  const PartitionedMatrix &K = part.K, &M = part.M;
  const sparse::RowTeam& team = part.team();
  const auto mass = part.interior()->mass({});
  const Index n_b = K.bb.cols();
  StaticReduction out;
  out.K_bb = K.bb - factor_ii.boundary_part();
  out.M_bb = M.bb;
  out.rows.resize(static_cast<Index>(kept.size()), n_b);
  Progress progress("constraint modes", static_cast<double>(n_b));
  for (Index first = 0; first < n_b; first += kBlock) {
    const Index count = std::min(kBlock, n_b - first);
    const MatrixXd Psi = -factor_ii.solve(MatrixXd(K.ib.middleCols(first, count)));
    out.rows.middleCols(first, count) = Psi(kept, Eigen::all);
    const MatrixXd inertia = *mass * Psi + MatrixXd(M.ib.middleCols(first, count));
    out.M_bb.middleCols(first, count) +=
        team.sum(M.ib.transpose() * Psi) - factor_ii.boundary_product(inertia);
    progress.update(static_cast<double>(first + count));
  }
  out.M_bb = (0.5 * (out.M_bb + out.M_bb.transpose())).eval();
  if (rigid.at_boundary.cols() > 0)
    carry_rigid_motions(factor_ii, {K, M, *mass, team}, rigid, kept, out);
  return out;
}

StaticPart static_part(const PartitionedModel& part, const std::vector<int32_t>& kept,
                       StepClock& clock, const rom::EliminationOrder& order) {
  StaticPart out;
  std::shared_ptr<const sparse::SupernodalFactor> own;
  if (part.shared) {
    out.factor_ii = part.shared->factor_interior();
    out.order = part.shared->order();
    out.order.entries = out.factor_ii->report().entries;
  } else {
    out.factor_ii = own = factorise_interior(part, order);
    out.order = order_of(*own, part.K.ii);
  }
  clock.lap(fmt::format("factor of K_ii ({:.3g} entries{})", static_cast<double>(out.order.entries),
                        out.order.method == "given" ? ", stored order" : ""));
  const Eigen::MatrixXd& motions = part.free.q;
  const RigidMotions rigid{motions(part.dofs.boundary, Eigen::all),
                           motions(part.dofs.interior, Eigen::all)};
  out.reduction = own ? reduce_statically(*own, part.K, part.M, rigid, kept)
                      : reduce_by_solves(*out.factor_ii, part, rigid, kept);
  clock.lap(fmt::format("{} constraint modes", part.dofs.boundary.size()));
  return out;
}

}  // namespace clatter::condense
