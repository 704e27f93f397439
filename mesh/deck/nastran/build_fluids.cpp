// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of fluids: PSOLID with FCTN = PFLUID or FFLUID, or with a MAT10.
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr const char* kFluids = "PFLUID";

bool is_fluid(const RawDeck& raw, const RawSolid& solid) {
  const auto other = raw.other_materials.find(solid.material);
  return solid.fluid || (other != raw.other_materials.end() && other->second == "MAT10");
}

}  // namespace

void leave_out_fluids(Model& model, Ignore& ignore) {
  RawDeck& raw = model.raw;
  for (const auto& [property, solid] : raw.solids) {
    if (!is_fluid(raw, solid)) continue;
    int64_t count = 0;
    for (const RawBlock& block : raw.blocks)
      if (block.property == property) count += static_cast<int64_t>(block.ids.size());
    if (count == 0) continue;
    if (!ignore.skips(kFluids, count))
      model.source.fail(
          solid.origin,
          fmt::format("PSOLID {}: {} cells of a fluid (FCTN or MAT10), expected solids; ignore = "
                      "[\"{}\"] leaves them out: a [[point_mass]] of the fe.toml stands for mass "
                      "that moves with the structure",
                      property, count, kFluids));
    for (RawBlock& block : raw.blocks) {
      if (block.property != property) continue;
      block.nodes.drain([&](int32_t grid) { raw.lost_grids.push_back(grid); });
    }
    std::erase_if(raw.blocks, [of = property](const RawBlock& b) { return b.property == of; });
  }
  std::sort(raw.lost_grids.begin(), raw.lost_grids.end());
}

}  // namespace clatter::mesh::deck::nastran
