// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/shared_condense.hpp"

#include <fmt/format.h>

#include <cmath>

#include "condense/certify/verify.hpp"
#include "condense/ranks/shared_part_of_ranks.hpp"
#include "core/base/log.hpp"
#include "core/ranks/rank_share.hpp"

namespace clatter::condense {
namespace {

/// Modes of the part by all ranks; rank 0 receives their vectors, the others none.
modes::ModeSolver solver_of(const PartitionedModel& part) {
  return [&part](const std::vector<int32_t>& /*all*/, const sparse::EigenOptions& requested) {
    sparse::EigenOptions options = requested;
    // Matrices imported without positions have no known rigid-body motions.
    if ((part.full.rigid.colwise().squaredNorm().array() > 0.0).all())
      options.rigid = part.rows_of_whole(part.free.q);
    sparse::ModeSet found = sparse::solve_modes(*part.whole(), options);
    const sparse::RowTeam& team = part.team();
    const std::vector<int32_t> dofs = team.gather(part.shared->whole_dofs());
    const RowMatrix rows = team.gather(RowMatrix(found.vectors));
    found.vectors.resize(part.full.size(), rows.rows() > 0 ? rows.cols() : 0);
    if (rows.rows() > 0) found.vectors(dofs, Eigen::all) = rows;
    return found;
  };
}

}  // namespace

Reducer shared_reducer(const ranks::Ranks& all) {
  Reducer reducer;
  reducer.writes = all.rank() == 0;
  reducer.reduce = [&all](const std::filesystem::path& path, const CondenseOptions& options,
                          double verify_hz, const CommonOptions& common, StepClock& clock) {
    ranks::set_rank_share(all, common);
    const fe::FeModel model = fe::read_fe_model(path, fe::FeMatrices::kLeftOut);
    fe::require_unknowns(model, "a reduction");
    if (model.size() < kFewestShared) {
      if (all.rank() > 0) return rom::ReducedModel{};
      say(fmt::format("{} DoF: rank 0 reduces alone", model.size()));
      return one_process_reducer().reduce(path, options, verify_hz, common, clock);
    }
    clock.lap(fmt::format("read {} DoF", model.size()));
    const PartitionedModel part = share_part(all, path, model, options.boundary, options.order);
    clock.lap("partition");
    rom::ReducedModel reduced = condense(part, options, clock);
    for (const std::string& text : describe(reduced)) print_result(text);
    if (std::isnan(verify_hz)) return reduced;
    const modes::Comparison compared = verify(reduced, model, verify_hz, solver_of(part));
    clock.lap("verification by the full model");
    if (!compared.modes.empty()) print_result(modes::table_of(compared).back());
    return reduced;
  };
  return reducer;
}

}  // namespace clatter::condense
