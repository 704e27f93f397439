// SPDX-License-Identifier: GPL-3.0-or-later
// Cards of nodes, coordinate systems and cells.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/deck/nastran/cards.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

template <class T>
void set_column(std::vector<T>& column, size_t row, T value) {
  if (value == T{}) return;
  column.resize(row + 1, T{});
  column[row] = value;
}

// A system number: 0 is the basic system; -1 means something else on some cards.
int32_t system_number(const Card& card, size_t i, const char* what) {
  const int32_t number = card.integer(i, what);
  if (number < 0) card.fail_expected(i, what, "a coordinate system, 0 or more");
  return number;
}

System::Kind kind_of(const Card& card) {
  switch (card.name().back()) {
    case 'C':
      return System::Kind::kCylindrical;
    case 'S':
      return System::Kind::kSpherical;
    default:
      return System::Kind::kRectangular;
  }
}

void add_system(const Card& card, RawDeck& raw, int32_t id, const RawSystem& system) {
  if (!raw.systems.emplace(id, system).second) {
    card.fail(0, fmt::format("found a second coordinate system {}", id));
  }
}

struct Family {
  std::string_view card;
  CellType linear, quadratic;
};

constexpr Family kFamilies[] = {
    {"CTETRA", CellType::kTet4, CellType::kTet10},
    {"CHEXA", CellType::kHex8, CellType::kHex20},
    {"CPENTA", CellType::kWedge6, CellType::kWedge15},
    {"CPYRAM", CellType::kPyramid5, CellType::kPyramid13},
    {"CPYRA", CellType::kPyramid5, CellType::kPyramid13},
};

constexpr size_t kFirstNode = 2;

bool has_node(const Card& card, size_t i) { return !card.blank(i) && card.text(i) != "0"; }

// Linear without mid-side nodes, else quadratic.
CellType type_of(const Card& card) {
  const Family& family = *std::find_if(std::begin(kFamilies), std::end(kFamilies),
                                       [&](const Family& f) { return f.card == card.name(); });
  const auto corners = static_cast<size_t>(traits(family.linear).nodes);
  const auto all = static_cast<size_t>(traits(family.quadratic).nodes);
  card.at_most(kFirstNode + all);
  for (size_t i = corners; i < all; ++i)
    if (has_node(card, kFirstNode + i)) return family.quadratic;
  return family.linear;
}

RawBlock& block_of(RawDeck& raw, CellType type, int32_t property) {
  if (!raw.blocks.empty() && raw.blocks.back().type == type &&
      raw.blocks.back().property == property) {
    return raw.blocks.back();
  }
  const auto [at, fresh] = raw.block_index.emplace(std::pair(type, property), raw.blocks.size());
  if (fresh) {
    raw.blocks.emplace_back();
    raw.blocks.back().type = type;
    raw.blocks.back().property = property;
  }
  return raw.blocks[at->second];
}

// Sixteen columns hold at least this many digits of a coordinate.
constexpr double kColumnPrecision = 1e-10;

// Full coordinates from a comment, if the card has the same in fewer digits.
void take_exact(RawDeck& raw, int32_t id, std::array<double, 3>& at) {
  if (raw.exact.empty()) return;
  const auto found = raw.exact.find(id);
  if (found == raw.exact.end()) return;
  for (size_t k = 0; k < 3; ++k) {
    const double exact = found->second[k];
    if (std::abs(exact - at[k]) <= kColumnPrecision * std::abs(exact)) at[k] = exact;
  }
  raw.exact.erase(found);
}

}  // namespace

void read_grid(const Card& card, RawDeck& raw) {
  Grids& grids = raw.grids;
  const size_t row = grids.size();
  grids.ids.push_back(card.id(0, "ID"));
  grids.origins.push_back(card.origin());
  std::array<double, 3> at{};
  for (size_t k = 0; k < 3; ++k) at[k] = card.number_or(2 + k, "coordinate", 0.0);
  take_exact(raw, grids.ids.back(), at);
  grids.at.push_back(at);
  const auto system = [&](size_t i, const char* what) {
    if (card.blank(i)) return kBlank;
    if (card.text(i) == "-1" && i == 5) return kZero;  // a grid of a fluid
    const int32_t number = system_number(card, i, what);
    return number == 0 ? kZero : number;
  };
  set_column(grids.cp, row, system(1, "CP"));
  set_column(grids.cd, row, system(5, "CD"));
  if (!card.blank(6)) {
    const DofMask held = card.components_or_none(6, "PS");
    set_column(grids.held, row, held == 0 ? kNoneHeld : held);
  }
  if (card.integer_or(7, "SEID", 0) != 0) card.fail(7, "superelements are not supported");
}

void read_grdset(const Card& card, RawDeck& raw) {
  if (raw.has_defaults) card.fail(0, "found a second one");
  raw.has_defaults = true;
  raw.defaults.cp = card.blank(1) ? 0 : system_number(card, 1, "CP");
  raw.defaults.cd = card.blank(5) ? 0 : system_number(card, 5, "CD");
  raw.defaults.held = card.blank(6) ? DofMask{0} : card.components_or_none(6, "PS");
  if (card.integer_or(7, "SEID", 0) != 0) card.fail(7, "superelements are not supported");
}

void read_cord1(const Card& card, RawDeck& raw) {
  for (const size_t first : {size_t{0}, size_t{4}}) {
    if (first > 0 && card.blank_from(first)) break;
    RawSystem system;
    system.kind = kind_of(card);
    system.origin = card.origin();
    system.by_grids = true;
    const int32_t id = card.id(first, "CID");
    for (size_t k = 0; k < 3; ++k) system.grids[k] = card.id(first + 1 + k, "G");
    add_system(card, raw, id, system);
  }
}

void read_cord2(const Card& card, RawDeck& raw) {
  RawSystem system;
  system.kind = kind_of(card);
  system.origin = card.origin();
  const int32_t id = card.id(0, "CID");
  system.reference = card.blank(1) ? 0 : system_number(card, 1, "RID");
  for (size_t k = 0; k < 9; ++k) system.points[k] = card.number_or(2 + k, "A, B or C", 0.0);
  card.at_most(11);
  add_system(card, raw, id, system);
}

void read_cell(const Card& card, RawDeck& raw) {
  const int32_t id = card.id(0, "EID");
  const CellType type = type_of(card);
  RawBlock& block = block_of(raw, type, card.id_or(1, "PID", id));
  const CellTraits& cell = traits(type);
  std::array<int32_t, kMaxCellNodes> nodes{};
  for (size_t i = 0; i < cell.to_nastran.size(); ++i) {
    const bool middle = static_cast<int>(i) >= cell.corners;
    if (middle && !has_node(card, kFirstNode + i)) continue;  // complete_cells() adds it
    const int32_t node = card.id(kFirstNode + i, "G");
    nodes[cell.to_nastran[i]] = node;
  }
  for (int i = 0; i < cell.nodes; ++i) block.nodes.push_back(nodes[i]);
  block.ids.push_back(id);
  block.origins.push_back(card.origin());
}

}  // namespace clatter::mesh::deck::nastran
