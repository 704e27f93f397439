// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace clatter::mesh::deck::nastran {
namespace {

// Limit of the effort for lists: about a second of visits, or half a gigabyte of entries.
constexpr int64_t kMostEffort = 500'000'000, kMostEffortPerGrid = 2000;

// Blank fields of GRID get GRDSET's values.
void fill_defaults(RawDeck& raw) {
  Grids& grids = raw.grids;
  const auto fill = [&](auto& column, auto blank, auto zero, auto value) {
    if (value != blank) column.resize(grids.size(), blank);
    for (auto& entry : column) entry = entry == blank ? value : entry == zero ? blank : entry;
  };
  fill(grids.cp, kBlank, kZero, raw.defaults.cp);
  fill(grids.cd, kBlank, kZero, raw.defaults.cd);
  fill(grids.held, DofMask{0}, kNoneHeld, raw.defaults.held);
}

// Decks that include the same grids twice are common; they must agree.
IdIndex grid_index(const Grids& grids, const Source& source) {
  IdIndex index(grids.ids);
  for (const auto& [a, b] : index.duplicates()) {
    const auto i = static_cast<size_t>(a), j = static_cast<size_t>(b);
    const bool same = grids.at[i] == grids.at[j] &&
                      column_at(grids.cp, i) == column_at(grids.cp, j) &&
                      column_at(grids.cd, i) == column_at(grids.cd, j) &&
                      column_at(grids.held, i) == column_at(grids.held, j);
    if (same) continue;
    source.fail(grids.origins[j], fmt::format("GRID {}: found another one with this number at {}",
                                              grids.ids[j], source.where(grids.origins[i])));
  }
  return index;
}

// A scalar point is a point at the origin that moves along x alone.
void add_scalar_points(RawDeck& raw) {
  constexpr DofMask kAllButX = kAllDofs & ~DofMask{1};
  Grids& grids = raw.grids;
  for (const int32_t id : raw.scalar_points) {
    grids.ids.push_back(id);
    grids.at.push_back({});
    grids.origins.push_back(0);
    grids.held.resize(grids.size());
    grids.held.back() = kAllButX;
  }
}

RawDeck with_defaults(RawDeck raw) {
  fill_defaults(raw);
  add_scalar_points(raw);
  return raw;
}

}  // namespace

Model::Model(const Source& deck_source, RawDeck cards, Refusals& all_refusals)
    : source(deck_source),
      refusals(all_refusals),
      raw(with_defaults(std::move(cards))),
      grids(grid_index(raw.grids, source)),
      systems(raw, grids, source),
      node_map(raw, deck) {
  for (size_t row = 0; row < raw.grids.cp.size(); ++row) {
    Eigen::Map<Eigen::Vector3d> at(raw.grids.at[row].data());
    at = systems.to_basic(raw.grids.cp[row], at, raw.grids.origins[row]);
  }
}

size_t Model::row_of(int32_t grid, Origin origin) const {
  const int32_t row = grids.find(grid);
  if (row < 0) source.fail(origin, fmt::format("found no GRID {}", grid));
  return static_cast<size_t>(row);
}

NodeIndex Model::require_row(size_t row, Origin origin) {
  if (node_map.find(row) == NodeMap::kNone) spend(16, origin);
  return node_map.require(row);
}

NodeIndex Model::require(int32_t grid, Origin origin) {
  return require_row(row_of(grid, origin), origin);
}

bool Model::is_lost(int32_t grid) const {
  return std::binary_search(raw.lost_grids.begin(), raw.lost_grids.end(), grid);
}

NodeIndex Model::add_point(const Eigen::Vector3d& at, Origin origin) {
  Grids& table = raw.grids;
  const int32_t largest = *std::max_element(table.ids.begin(), table.ids.end());
  if (largest == std::numeric_limits<int32_t>::max())
    source.fail(origin, "found no free number above the largest GRID");
  spend(64, origin);
  table.ids.push_back(largest + 1);
  table.at.push_back({at[0], at[1], at[2]});
  table.origins.push_back(origin);
  return node_map.add_row();
}

int Model::direction_at(int32_t grid, int direction, Origin origin) const {
  const bool scalar = raw.scalar_points.contains(grid);
  if (scalar && direction <= 0) return 0;
  if (!scalar && direction >= 0) return direction;
  if (scalar)
    source.fail(origin,
                fmt::format("found a component of scalar point {}, expected 0 or none", grid));
  source.fail(origin, fmt::format("C: found nothing for grid {}, expected one digit 1 to 6", grid));
}

const BoundaryFaces& Model::boundary() {
  if (!boundary_) boundary_ = boundary_faces(deck.mesh);
  return *boundary_;
}

NodeIndex Model::find(int32_t grid, Origin origin) const {
  return node_map.find(row_of(grid, origin));
}

std::vector<NodeIndex> Model::node_indices(const IdList& list, Origin origin, bool make_points) {
  std::vector<NodeIndex> out;
  for_each_grid(list, origin, [&](size_t row) {
    const NodeIndex node_index = make_points ? require_row(row, origin) : node_map.find(row);
    if (node_index == NodeMap::kNone) return;
    spend(16, origin);
    out.push_back(node_index);
  });
  return out;
}

std::string Model::system_name(int32_t system, Origin origin) {
  if (system == 0) return {};
  const System& found = systems.get(system, origin);
  deck.systems[found.name] = found;
  return found.name;
}

void Model::spend(int64_t effort, Origin origin) {
  effort_ += effort;
  const auto grid_count = static_cast<int64_t>(raw.grids.size());
  if (effort_ > std::max(kMostEffort, kMostEffortPerGrid * grid_count)) {
    source.fail(origin, "the lists of this deck repeat the same grids too often");
  }
}

void add_term(std::vector<Equation::Term>& terms, NodeIndex node_index, int direction,
              double coefficient) {
  if (coefficient != 0.0) terms.push_back({node_index, direction, coefficient});
}

void count_unused(Model& model) {
  int64_t scalars = 0;
  for (const int32_t id : model.raw.scalar_points)
    scalars += model.find(id, 0) == NodeMap::kNone ? 1 : 0;
  const int64_t unused = model.node_map.unused() - scalars;
  if (unused > 0) model.deck.ignored["GRID (of no solid and no coupling)"] = unused;
  if (scalars > 0) model.deck.ignored["SPOINT (of no spring, mass or equation)"] = scalars;
}

void pass_damping(Model& model) {
  for (const auto& [field, found] : model.raw.damping)
    model.refusals.contents().pass("field", field, model.source, found.origin, "damping",
                                   found.count);
}

void choose_mass(Model& model) {
  const bool has_properties = !model.raw.solids.empty() || !model.raw.shell_cells.empty() ||
                              !model.raw.bar_properties.empty();
  const bool analysis = has_properties && !model.raw.materials.empty();  // no mere mesh
  if (analysis && !model.raw.control.coupled_mass) model.deck.mass = MassForm::kLumped;
}

void take_damping(Model& model) {
  const Control& control = model.raw.control;
  if (control.mass_damping != 0.0 || control.stiffness_damping != 0.0)
    model.deck.damping.push_back({model.source.files().front(), "PARAM, ALPHA1 and ALPHA2",
                                  control.mass_damping, control.stiffness_damping});
  const double loss = control.loss_factor;
  if (loss == 0.0) return;
  Deck& deck = model.deck;
  for (auto& [name, material] : deck.materials) material.loss_factor += loss;
  for (Spring& spring : deck.springs) spring.loss_factor += loss;
  for (Beam& beam : deck.beams) beam.loss_factor += loss;
  for (NodalMatrix& matrix : deck.matrices) matrix.loss_factor += matrix.is_mass ? 0.0 : loss;
  deck.notes.push_back(
      fmt::format("{}: PARAM, G: {:g} is added to the loss factors of all stiffness",
                  model.source.files().front(), loss));
}

void note_solution(Model& model) {
  const Control& control = model.raw.control;
  const std::string& deck = model.source.files().front();
  constexpr std::array kNonlinear = {106, 129, 153, 400, 401, 402, 600, 601, 700, 701};
  if (std::ranges::count(kNonlinear, control.solution) > 0)
    model.deck.notes.push_back(
        fmt::format("{}: SOL {} is nonlinear: the linear model of the part without load is read",
                    deck, control.solution));
  if (control.inertia_relief)
    model.deck.notes.push_back(
        fmt::format("{}: PARAM INREL is left out: supports are those of SPC alone, and "
                    "clatter-modal statics needs supports that hold the part",
                    deck));
  for (const Origin origin : control.preloads)
    model.deck.notes.push_back(
        fmt::format("{}: STATSUB is left out: the part is that without the stress of its preload; "
                    "[prestress] of the fe.toml takes it from results of clatter-modal statics",
                    model.source.where(origin)));
  for (const Origin origin : control.material_temperatures)
    model.deck.notes.push_back(
        fmt::format("{}: TEMPERATURE(MATERIAL) is left out: constants are those of MAT1 and the "
                    "like, without MATT1",
                    model.source.where(origin)));
  for (const Origin origin : control.combinations)
    model.deck.notes.push_back(
        fmt::format("{}: SUBCOM is left out: a [[case]] of the fe.toml sums loads with factors",
                    model.source.where(origin)));
}

}  // namespace clatter::mesh::deck::nastran
