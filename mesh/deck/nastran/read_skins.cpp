// SPDX-License-Identifier: GPL-3.0-or-later
// Two-dimensional cells, which are shells or faces of solids, and their properties.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

/// Fields of a card: its grids begin at 2.
struct SkinFields {
  std::string_view card;
  FaceType linear, type;
  size_t offset, thickness, flag;  // ZOFFS, T1, TFLAG
};

constexpr size_t kFirstGrid = 2;
constexpr std::array<SkinFields, 6> kSkinFields = {{
    {"CQUAD4", FaceType::kQuad4, FaceType::kQuad4, 7, 10, 9},
    {"CQUAD8", FaceType::kQuad4, FaceType::kQuad8, 15, 10, 16},
    {"CQUADR", FaceType::kQuad4, FaceType::kQuad4, 7, 10, 9},
    {"CTRIA3", FaceType::kTri3, FaceType::kTri3, 6, 10, 9},
    {"CTRIA6", FaceType::kTri3, FaceType::kTri6, 9, 10, 13},
    {"CTRIAR", FaceType::kTri3, FaceType::kTri3, 6, 10, 9},
}};

bool has_grid(const Card& card, size_t i) { return !card.blank(i) && card.text(i) != "0"; }

// With all of its mid-side nodes quadratic, else linear.
void take_grids(const Card& card, const SkinFields& fields, RawSkin& skin) {
  const int corners = traits(fields.linear).nodes, all = traits(fields.type).nodes;
  for (int i = corners; i < all; ++i)
    if (!has_grid(card, kFirstGrid + static_cast<size_t>(i))) ++skin.missing;
  skin.type = skin.missing == 0 ? fields.type : fields.linear;
  if (skin.missing == all - corners) skin.missing = 0;
  for (size_t i = 0; i < static_cast<size_t>(traits(skin.type).nodes); ++i)
    skin.grids[i] = card.id(kFirstGrid + i, "G");
}

void take_sheet(const Card& card, RawShell& shell) {
  shell.material = card.blank(1) ? 0 : card.id(1, "MID1");
  shell.thickness = card.number_or(2, "T", 0.0);
  shell.bending = card.integer_or(3, "MID2", 0);
  shell.inertia = card.number_or(4, "12I/T**3", 1.0);
  shell.shear = card.integer_or(5, "MID3", 0);
  shell.shear_ratio = card.number_or(6, "TS/T", 5.0 / 6.0);
  shell.area_mass = card.number_or(7, "NSM", 0.0);
  if (!card.blank(10))
    shell.refusal =
        "MID4 joins stretching to bending, which is not read: ZOFFS of its cells or a PCOMP "
        "replaces it";
  else if (shell.material == 0)
    shell.refusal = "MID1 is blank: a plate that nothing holds in its plane, expected a material";
  else if (shell.bending == -1)
    shell.refusal = "MID2 is -1: plane strain is not read, expected MID2 = MID1 of a sheet";
}

// Blank materials and thicknesses are those of the ply before.
void take_plies(const Card& card, size_t first, size_t fields, size_t each, RawShell& shell) {
  for (size_t i = first; i < card.size(); i += each) {
    bool blank = true;
    for (size_t k = 0; k < fields; ++k) blank = blank && card.blank(i + k);
    if (blank) continue;
    RawPly ply = shell.plies.empty() ? RawPly{} : shell.plies.back();
    if (!card.blank(i) || ply.material == 0) ply.material = card.id(i, "MID");
    if (!card.blank(i + 1) || ply.thickness == 0.0) ply.thickness = card.number(i + 1, "T");
    if (!(ply.thickness > 0.0)) card.fail_expected(i + 1, "T", "more than 0");
    ply.angle = card.number_or(i + 2, "THETA", 0.0);
    shell.plies.push_back(ply);
  }
  if (shell.plies.empty()) card.fail(first, "found no ply, expected MID, T and THETA of each");
}

void take_layers(const Card& card, RawShell& shell) {
  constexpr size_t kFirstPly = 8;
  // A ply of PCOMPG begins with its number and has a line; two of PCOMP are on a line.
  if (shell.card == "PCOMPG")
    take_plies(card, kFirstPly + 1, 3, 8, shell);
  else
    take_plies(card, kFirstPly, 4, 4, shell);
  const std::string_view kind = card.text(7);
  if (kind == "SYM") {
    const std::vector<RawPly> half = shell.plies;
    shell.plies.insert(shell.plies.end(), half.rbegin(), half.rend());
  } else if (!kind.empty()) {
    shell.refusal = fmt::format(
        "LAM is {}: a laminate without part of its stiffness is not read, expected SYM or a blank "
        "field",
        kind);
  }
  for (const RawPly& ply : shell.plies) shell.thickness += ply.thickness;
  shell.material = shell.plies.front().material;
  shell.bottom = card.number_or(1, "Z0", -0.5 * shell.thickness);
  shell.area_mass = card.number_or(2, "NSM", 0.0);
  shell.reference_temperature = card.number_or(5, "TREF", 0.0);
  if (card.blank(6)) return;
  shell.loss_factor = card.number(6, "GE");
  if (!(*shell.loss_factor >= 0.0)) card.fail_expected(6, "GE", "a loss factor of 0 or more");
}

}  // namespace

void read_skin(const Card& card, RawDeck& raw) {
  const SkinFields& fields = *std::ranges::find(kSkinFields, card.name(), &SkinFields::card);
  RawSkin skin;
  skin.kind = card.name();
  skin.origin = card.origin();
  skin.id = card.id(0, "EID");
  skin.property = card.id_or(1, "PID", skin.id);
  take_grids(card, fields, skin);
  const size_t direction = fields.offset - 1;
  if (card.is_integer(direction))
    skin.system = card.integer(direction, "MCID");
  else
    skin.angle = card.number_or(direction, "THETA", 0.0);
  if (skin.system < kNoSystem) card.fail_expected(direction, "MCID", "a coordinate system or 0");
  skin.offset = card.number_or(fields.offset, "ZOFFS", 0.0);
  const int32_t flag = card.integer_or(fields.flag, "TFLAG", 0);
  if (flag != 0 && flag != 1) card.fail_expected(fields.flag, "TFLAG", "0 or 1");
  skin.is_relative = flag == 1;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (size_t i = 0; i < static_cast<size_t>(traits(skin.type).corners); ++i)
    skin.thickness[i] = card.number_or(fields.thickness + i, "T", kNone);
  raw.skins.push_back(std::move(skin));
}

void read_pshell(const Card& card, RawDeck& raw) {
  RawShell shell;
  shell.origin = card.origin();
  shell.card = card.name();
  if (shell.card == "PSHELL")
    take_sheet(card, shell);
  else
    take_layers(card, shell);
  if (!raw.shells.emplace(card.id(0, "PID"), shell).second) card.fail(0, "found a second one");
}

}  // namespace clatter::mesh::deck::nastran
