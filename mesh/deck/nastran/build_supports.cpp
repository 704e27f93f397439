// SPDX-License-Identifier: GPL-3.0-or-later
// SPC, SPC1, SPCADD, permanent constraints of GRID, ASET and BSET.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "mesh/deck/nastran/set_choice.hpp"
#include "mesh/deck/nastran/supports.hpp"

namespace clatter::mesh::deck::nastran {

std::vector<Support> supports_of(Model& model, int32_t set, Origin origin) {
  Supports supports(model, fmt::format("spc_{}", set));
  for (const int32_t part :
       members_of(model, "SPC", set, model.raw.spc, model.raw.spc_sums, origin)) {
    for (const RawHold& hold : model.raw.spc.at(part)) supports.read(hold);
  }
  return supports.list();
}

void build_supports(Model& model) {
  const auto append = [](std::vector<Support>& to, std::vector<Support> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  Supports permanent(model, "ps");
  for (size_t row = 0; row < model.raw.grids.held.size(); ++row) {
    permanent.add_node(model.node_map.find(row), model.raw.grids.held[row], 0.0,
                       model.raw.grids.origins[row]);
  }
  append(model.deck.supports, permanent.list());

  // Sets selected by all subcases belong to the model, others to their steps (build_steps).
  const Control& control = model.raw.control;
  int32_t set = 0;
  Origin origin = 0;
  if (control.has_cases) {
    const Subcase& first = control.subcases.front();
    const bool same =
        std::all_of(control.subcases.begin(), control.subcases.end(),
                    [&](const Subcase& subcase) { return subcase.choice.spc == first.choice.spc; });
    if (same) set = first.choice.spc;
    origin = first.origin;
  } else {
    set = only_set(model, "SPC", model.raw.spc, model.raw.spc_sums);
  }
  if (set != 0) append(model.deck.supports, supports_of(model, set, origin));

  Supports retained(model, "aset");
  for (const RawHold& hold : model.raw.retained) retained.read(hold);
  append(model.deck.retained, retained.list());
  if (retained.unused() > 0)
    model.deck.notes.push_back(
        fmt::format("{}: {} retained grids (ASET, BSET, CSET) belong to no solid, coupling or "
                    "spring: they are left out",
                    model.source.where(model.raw.retained.front().origin), retained.unused()));
}

}  // namespace clatter::mesh::deck::nastran
