// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/shared_condense.hpp"

#include <fmt/format.h>

#include "condense/ranks/shared_part.hpp"
#include "core/base/log.hpp"
#include "core/ranks/rank_share.hpp"

namespace clatter::condense {

PartSource shared_source(const ranks::Ranks& all) {
  PartSource source;
  source.writes = all.rank() == 0;
  source.memory_advice.clear();
  source.read = [&all](const std::filesystem::path& path,
                       const CommonOptions& common) -> std::optional<fe::FeModel> {
    ranks::set_rank_share(all, common);
    fe::FeModel model = fe::read_fe_model(path, fe::FeMatrices::kLeftOut);
    fe::require_unknowns(model, "a reduction");
    if (model.size() >= kFewestShared) return model;
    if (all.rank() > 0) return {};
    say(fmt::format("{} DoF: rank 0 reduces alone", model.size()));
    return PartSource{}.read(path, common);
  };
  source.partition =
      [&all](const std::filesystem::path& path, const fe::FeModel& model,
             const CondenseOptions& options) -> std::unique_ptr<const PartitionedModel> {
    if (model.size() < kFewestShared) return PartSource{}.partition(path, model, options);
    return std::make_unique<SharedPart>(all, path, model, options.boundary, options.order);
  };
  return source;
}

}  // namespace clatter::condense
