// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/craig_bampton.hpp"

#include <fmt/format.h>

#include <memory>

#include "core/base/error.hpp"
#include "core/fe/dof_label.hpp"

namespace clatter::condense {
namespace {

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

CraigBampton craig_bampton(const PartitionedModel& part, const StaticPart& statics,
                           const ModeRequest& request, StepClock& clock) {
  const sparse::Factor& factor = *statics.factor_ii;
  CraigBampton out;
  out.factor = factor.report();
  out.rigid_error = statics.reduction.rigid_error;
  out.interior = interior_modes(part, factor, request, clock);
  out.fixed_interface_hz = out.interior.hz;
  out.basis = ReducedBasis(statics.factor_ii, part.K.ib, part.team());
  out.basis.shapes.swap(out.interior.vectors);
  out.interior.vectors.resize(0, 0);
  static_cast<ReducedMatrices&>(out) = project(part, statics.reduction, out.basis);
  clock.lap("reduced matrices");
  const bool guyan = request.count == 0 && request.fmax_hz == 0.0;
  const double target = guyan ? 0.0 : request.frequency_error;
  if (target == 0.0 && !request.estimate_error) return out;
  out.residual = add_residual_modes(out, factor, part, part.free.q(part.dofs.boundary, Eigen::all),
                                    out.interior.accurate_to_hz, target);
  const Eigen::Index shapes = out.fixed_interface_hz.size();
  out.fixed_interface_hz.conservativeResize(shapes + out.residual.hz.size());
  out.fixed_interface_hz.tail(out.residual.hz.size()) = out.residual.hz;
  clock.lap(fmt::format("{} residual modes", out.residual.hz.size()));
  return out;
}

}  // namespace clatter::condense
