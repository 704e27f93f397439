// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/shared_condense.hpp"

#include <fmt/format.h>

#include <cmath>

#include "condense/ranks/shared_part_of_ranks.hpp"
#include "core/base/log.hpp"
#include "core/ranks/rank_share.hpp"

namespace clatter::condense {

Reducer shared_reducer(const ranks::Ranks& all) {
  Reducer reducer;
  reducer.verifies = false;
  reducer.writes = all.rank() == 0;
  reducer.reduce = [&all](const std::filesystem::path& path, const CondenseOptions& options,
                          double /*verify_hz*/, const CommonOptions& common, StepClock& clock) {
    ranks::set_rank_share(all, common);
    const fe::FeModel model = fe::read_fe_model(path, fe::FeMatrices::kLeftOut);
    fe::require_unknowns(model, "a reduction");
    if (model.size() < kFewestShared) {
      if (all.rank() > 0) return rom::ReducedModel{};
      say(fmt::format("{} DoF: rank 0 reduces alone", model.size()));
      return one_process_reducer().reduce(path, options, std::nan(""), common, clock);
    }
    clock.lap(fmt::format("read {} DoF", model.size()));
    const PartitionedModel part = share_part(all, path, model, options.boundary, options.order);
    clock.lap("partition");
    rom::ReducedModel reduced = condense(part, options, clock);
    for (const std::string& text : describe(reduced)) print_result(text);
    return reduced;
  };
  return reducer;
}

}  // namespace clatter::condense
