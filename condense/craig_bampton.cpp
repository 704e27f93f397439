#include "condense/craig_bampton.hpp"

#include <fmt/format.h>

#include "assembly/dof_place.hpp"
#include "condense/constraint_modes.hpp"
#include "core/error.hpp"
#include "modal/free_motions.hpp"

namespace clatter::condense {
namespace {

modal::SupernodalFactor factorise_interior(const assembly::FeModel& model,
                                        const DofPartition& partition, const SparseMatrix& K_ii) {
  try {
    return modal::SupernodalFactor(K_ii);
  } catch (const modal::NotPositiveDefinite& error) {
    const std::string where =
        error.column < 0
            ? std::string{}
            : ", at " +
                  assembly::place_of(model, partition.interior[static_cast<size_t>(error.column)]);
    throw modal::NotPositiveDefinite(
        fmt::format("the boundary does not hold the body: K_ii {}{}; add a set to the boundary, or "
                    "look for a part of the mesh that is not connected",
                    error.what(), where),
        error.column);
  }
}

void assemble_basis(CraigBampton& out, Eigen::MatrixXd&& Psi_ib, const Eigen::MatrixXd& Phi_ik) {
  const Eigen::Index n_b = Psi_ib.cols();
  const Eigen::Index r = n_b + Phi_ik.cols();
  out.basis.n_boundary = static_cast<int>(n_b);
  out.basis.V_b = Eigen::MatrixXd::Identity(n_b, r);
  out.basis.V_i = std::move(Psi_ib);
  out.basis.V_i.conservativeResize(Eigen::NoChange, r);
  out.basis.V_i.rightCols(Phi_ik.cols()) = Phi_ik;
}

}  // namespace

CraigBampton craig_bampton(const assembly::FeModel& model, const DofPartition& partition,
                           const PartitionedMatrix& K, const PartitionedMatrix& M,
                           const ModeRequest& request, StepClock& clock) {
  check_boundary_holds(model, partition);
  const modal::SupernodalFactor factor = factorise_interior(model, partition, K.ii);
  CraigBampton out;
  out.factor = factor.report();
  clock.lap(
      fmt::format("factor of K_ii ({:.3g} entries)", static_cast<double>(out.factor.entries)));
  Eigen::MatrixXd Psi_ib = constraint_modes(factor, K.ib);
  const Eigen::MatrixXd motions = model.rigid * modal::free_motions(model);
  out.rigid_error = restore_rigid_motions(Psi_ib, motions(partition.boundary, Eigen::all),
                                          motions(partition.interior, Eigen::all));
  clock.lap(fmt::format("{} constraint modes", Psi_ib.cols()));

  out.interior = interior_modes(model, partition, K, M, factor, request, clock);
  out.fixed_interface_hz = out.interior.hz;
  assemble_basis(out, std::move(Psi_ib), out.interior.vectors);
  out.interior.vectors.resize(0, 0);
  out.M_rr = project(M, out.basis);
  out.K_rr = project(K, out.basis);
  clock.lap("reduced matrices");
  const bool guyan = request.count == 0 && request.fmax_hz == 0.0;
  out.residual = add_residual_modes(out, factor, K, M, out.interior.accurate_to_hz,
                                    guyan ? 0.0 : request.frequency_error);
  const Eigen::Index kept = out.fixed_interface_hz.size();
  out.fixed_interface_hz.conservativeResize(kept + out.residual.hz.size());
  out.fixed_interface_hz.tail(out.residual.hz.size()) = out.residual.hz;
  clock.lap(fmt::format("{} residual modes", out.residual.hz.size()));
  return out;
}

}  // namespace clatter::condense
