// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/condense.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condense/basis/cutoff_search.hpp"
#include "condense/basis/inertia_force.hpp"
#include "condense/basis/truncation.hpp"
#include "condense/certify/certificate.hpp"
#include "condense/part_limits.hpp"
#include "condense/rows/recovery_rows.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/free_motions.hpp"

namespace clatter::condense {
namespace {

void report_repeated(const DofPartition& partition) {
  if (partition.repeated.empty()) return;
  warn(fmt::format("boundary: {} DoFs are in two sets and got one coordinate each, the first is {}",
                   partition.repeated.size(), partition.repeated.front()));
}

/// Rigid motions (n x m) in `size` reduced coordinates: their boundary rows; fixed-interface modes
/// do not contribute.
Eigen::MatrixXd boundary_rows(const PartitionedModel& part, const Eigen::MatrixXd& motions,
                              Eigen::Index size) {
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(size, motions.cols());
  const auto n_b = static_cast<Eigen::Index>(part.dofs.boundary.size());
  reduced.topRows(n_b) = motions(part.dofs.boundary, Eigen::all);
  return reduced;
}

/// The imaginary part of a complex stiffness on the basis.
Eigen::MatrixXd loss_of(const PartitionedModel& part, const ReducedBasis& basis) {
  if (part.interior().local() == nullptr)
    throw InputError(fmt::format(
        "{}: loss_factor: found a model shared by several processes, expected one process: "
        "clatter-condense; or [damping] and [[modal_damping]] in place of loss factors",
        part.full.name));
  return basis.congruence(part.full.loss);
}

std::map<std::string, Eigen::VectorXd> reduced_loads(const fe::FeModel& model,
                                                     const DofPartition& dofs,
                                                     const ReducedBasis& basis) {
  std::map<std::string, Eigen::VectorXd> loads;
  for (const auto& [name, load] : model.loads) {
    const Eigen::MatrixXd interior = load(dofs.interior), boundary = load(dofs.boundary);
    loads[name] = basis.project(interior, boundary);
  }
  return loads;
}

}  // namespace

rom::ReducedModel condense(const fe::FeModel& model, const CondenseOptions& options,
                           StepClock& clock) {
  const LocalPart part(model, options.boundary, options.order);
  clock.lap("partition");
  return condense(part, options, clock);
}

rom::ReducedModel condense(const PartitionedModel& part, const CondenseOptions& options,
                           StepClock& clock) {
  const fe::FeModel& model = part.full;
  report_repeated(part.dofs);
  check_parts(model, options.modes);
  SkinRecovery recovery(part, options.skin, options.rows);
  StaticPart statics = static_part(part, recovery.unknowns(), clock);
  SearchedBasis found = options.modes.accurate_to_hz > 0.0
                            ? search_cutoff(part, statics, options.modes, clock)
                            : SearchedBasis{craig_bampton(part, statics, options.modes, clock), {}};
  CraigBampton& source = found.basis;
  limit_to_parts(model, options.modes, source);

  rom::InertiaInvariants inertia;
  if (options.inertia_invariants) {
    inertia = part.inertia(source.basis);
    clock.lap("inertia invariants");
  }
  Eigen::MatrixXd loss;
  if (model.loss.rows() > 0) {
    loss = loss_of(part, source.basis);
    clock.lap("loss factors");
  }
  Eigen::MatrixXd lacking;
  if (options.joined_error) {
    lacking = truncation(source, *statics.factor_ii, part);
    clock.lap("error of joined modes");
  }
  Eigen::MatrixXd of_frame;
  if (!part.free.all_free()) of_frame = inertia_force(part, source.basis);
  std::map<std::string, Eigen::VectorXd> loads = reduced_loads(model, part.dofs, source.basis);
  RowMatrix& static_rows = statics.reduction.rows;
  RowMatrix shape_rows = source.basis.shapes(recovery.unknowns(), Eigen::all);
  source.basis = {};  // with the factor, before the rows of the skin take its memory
  statics.factor_ii.reset();
  recovery.gather(part, static_rows, shape_rows);
  rom::Skin skin = recovery.recover(static_rows, shape_rows);
  RecoveredSets rows = recovery.recover_sets(static_rows, shape_rows);
  rows.sets.insert(part.dofs.sets.begin(), part.dofs.sets.end());
  rows.grids.insert(part.dofs.grids.begin(), part.dofs.grids.end());
  clock.lap("loads and skin rows");
  rom::ReducedModel reduced{.name = model.name,
                            .method = options.method,
                            .n_boundary = static_cast<int>(part.dofs.boundary.size()),
                            .M_rr = source.M_rr,
                            .K_rr = source.K_rr,
                            .alpha = model.alpha,
                            .beta = model.beta,
                            .modal_damping = options.modal_damping,
                            .loss = std::move(loss),
                            .rigid = boundary_rows(part, model.rigid, source.M_rr.rows()),
                            .inertia_force = std::move(of_frame),
                            .sets = std::move(rows.sets),
                            .grids = std::move(rows.grids),
                            .loads = std::move(loads),
                            .mass = model.mass,
                            .fixed_interface_hz = source.fixed_interface_hz,
                            .valid_to_hz = source.interior.cutoff_hz,
                            .truncation = std::move(lacking),
                            .skin = std::move(skin),
                            .inertia = std::move(inertia),
                            .combined = std::move(rows.combined),
                            .recovered_sets = std::move(rows.names),
                            .elimination = statics.order,
                            .certificate = {},
                            .deck = model.deck};
  if (found.search.tried > 0) record(found.search, reduced.certificate);
  record_parts(model, source, reduced.certificate);
  Eigen::MatrixXd motions = boundary_rows(part, part.free.q, reduced.size());
  if (options.interface) {
    ReducedInterface interface =
        reduce_interface(reduced, *options.interface, motions, fe::characteristic_length(model),
                         source.interior.accurate_to_hz);
    reduced = std::move(interface.model);
    motions = std::move(interface.motions);
    record(interface.report, reduced.certificate);
    clock.lap(fmt::format("{} interface modes", interface.report.modes));
  }
  certify(reduced, part, source, motions, options.certificate);
  clock.lap("certificate");
  return reduced;
}

}  // namespace clatter::condense
