// SPDX-License-Identifier: GPL-3.0-or-later
// Shells and their properties, as far as skins of solids need them.
#include <algorithm>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

constexpr size_t kFirstGrid = 2;

bool has_grid(const Card& card, size_t i) { return !card.blank(i) && card.text(i) != "0"; }

// With all of its mid-side nodes quadratic, else linear.
FaceType skin_type(const Card& card) {
  const bool triangle = card.name().starts_with("CTRIA");
  const bool quadratic = card.name().ends_with('6') || card.name().ends_with('8');
  const FaceType linear = triangle ? FaceType::kTri3 : FaceType::kQuad4;
  const FaceType full = triangle ? FaceType::kTri6 : FaceType::kQuad8;
  if (!quadratic) return linear;
  for (int i = traits(linear).nodes; i < traits(full).nodes; ++i) {
    if (!has_grid(card, kFirstGrid + static_cast<size_t>(i))) return linear;
  }
  return full;
}

}  // namespace

void read_skin(const Card& card, RawDeck& raw) {
  RawSkin skin;
  skin.kind = card.name();
  skin.origin = card.origin();
  skin.id = card.id(0, "EID");
  skin.property = card.id_or(1, "PID", skin.id);
  skin.type = skin_type(card);
  for (size_t i = 0; i < static_cast<size_t>(traits(skin.type).nodes); ++i) {
    skin.grids[i] = card.id(kFirstGrid + i, "G");
  }
  raw.skins.push_back(std::move(skin));
}

void read_pshell(const Card& card, RawDeck& raw) {
  RawShell shell;
  shell.origin = card.origin();
  shell.card = card.name();
  if (shell.card == "PSHELL") {
    shell.material = card.blank(1) ? 0 : card.id(1, "MID1");
    shell.thickness = card.number_or(2, "T", 0.0);
  }
  if (!raw.shells.emplace(card.id(0, "PID"), shell).second) card.fail(0, "found a second one");
}

}  // namespace clatter::mesh::deck::nastran
