// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/beam_ends.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/shell_joints.hpp"

namespace clatter::mesh::deck {

void settle_beam_ends(Deck& deck) {
  const std::vector<bool> turns = turning_flags(deck.mesh);
  const auto on_solids = [&](NodeIndex end) {
    return end < deck.mesh.nodes.rows() && !turns[static_cast<size_t>(end)];
  };
  std::vector<const Beam*> hinged;
  for (Beam& beam : deck.beams) {
    const auto ends = std::ranges::count_if(beam.ends, on_solids);
    if (ends == 2)
      for (recipe::BeamSection& section : beam.sections) section.J = 0.0;
    if (ends > 0 && beam.sections[0].I1 + beam.sections[0].I2 > 0.0) hinged.push_back(&beam);
  }
  if (!hinged.empty())
    deck.notes.push_back(
        fmt::format("{}: {} of {} bars end on nodes of solids, which turn freely: as hinges, the "
                    "first is {}; an RBE3 or RBE2 of the nodes around clamps an end",
                    hinged[0]->source.where(), hinged.size(), deck.beams.size(), hinged[0]->name));
  const auto heated =
      std::ranges::find_if(deck.steps, [](const Step& step) { return !step.temperature.empty(); });
  if (heated != deck.steps.end() && !deck.beams.empty())
    deck.notes.push_back(
        fmt::format("{}: its temperatures expand solids and shells: the {} bars do not",
                    heated->where, deck.beams.size()));
}

}  // namespace clatter::mesh::deck
