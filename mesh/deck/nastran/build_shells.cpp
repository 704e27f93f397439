// SPDX-License-Identifier: GPL-3.0-or-later
// Shells with their PSHELL.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// Poisson's ratios of stretching and bending that differ by no more are the same.
constexpr double kSameRatio = 1e-6;

// Of properties without materials, as our writer has them.
bool is_mere_mesh(const Model& model) {
  return model.raw.materials.empty() && model.raw.other_materials.empty();
}

class ShellProperties {
 public:
  explicit ShellProperties(Model& model) : model_(model) {}

  /// Index into Mesh::regions.
  int32_t region_of(const RawSkin& cell) {
    const auto [at, fresh] = regions_.try_emplace(cell.property, -1);
    if (fresh) at->second = add_region(cell);
    if (at->second < 0) throw FollowUp();
    return at->second;
  }

  void note_shear() const {
    if (without_shear_ > 0)
      model_.deck.notes.push_back(fmt::format(
          "{}: MID3 of {} PSHELL is blank, rigid in shear across the sheet in Nastran: here 5/6 of "
          "the shear stiffness of MID2",
          model_.source.where(first_without_shear_), without_shear_));
  }

 private:
  int32_t add_region(const RawSkin& cell) {
    const int32_t property = cell.property;
    Mesh& mesh = model_.deck.mesh;
    const auto named = model_.raw.region_names.find(property);
    const std::string name =
        named == model_.raw.region_names.end() ? fmt::format("pid_{}", property) : named->second;
    if (std::ranges::find(mesh.regions, name) != mesh.regions.end())
      model_.source.fail(cell.origin, fmt::format("{} {}: {} is a region of solids, expected a "
                                                  "property of shells alone",
                                                  cell.kind, cell.id, shown(name)));
    Region region;
    const auto shell = model_.raw.shells.find(property);
    if (shell != model_.raw.shells.end()) {
      region.where = model_.source.where(shell->second.origin);
      model_.deck.shells.push_back({recipe::Source(region.where), {name}, {}});
      model_.deck.shells.back().section = section_of(property, shell->second);
      region.material = use_material(model_, shell->second.material, shell->second.origin);
    } else if (!model_.raw.shells.empty() || !model_.raw.solids.empty()) {
      model_.source.fail(cell.origin,
                         fmt::format("{} {}: found no PSHELL {}", cell.kind, cell.id, property));
    }
    mesh.regions.push_back(name);
    model_.deck.regions.push_back(std::move(region));
    return static_cast<int32_t>(mesh.regions.size()) - 1;
  }

  fe::ShellSection section_of(int32_t property, const RawShell& raw) {
    const auto fail = [&](const std::string& message) {
      model_.source.fail(raw.origin, fmt::format("{} {}: {}", raw.card, property, message));
    };
    if (!raw.refusal.empty())
      fail(raw.refusal + "; ignore = [\"CQUAD4\"] and the like leave cells out");
    const Material sheet = isotropic(property, raw, raw.material);
    const Material bending = isotropic(property, raw, raw.bending);
    if (std::abs(sheet.constants[1] - bending.constants[1]) > kSameRatio)
      fail(fmt::format("MID2 has NU = {}, expected {} as MID1", bending.constants[1],
                       sheet.constants[1]));
    const auto shear_of = [](const Material& material) {
      return material.constants[0] / (2.0 * (1.0 + material.constants[1]));
    };
    fe::ShellSection section;
    section.thickness = raw.thickness;
    section.bending = raw.inertia * bending.constants[0] / sheet.constants[0];
    if (raw.shear == 0) {
      if (without_shear_++ == 0) first_without_shear_ = raw.origin;
      section.shear = 5.0 / 6.0 * shear_of(bending) / shear_of(sheet);
    } else {
      section.shear =
          raw.shear_ratio * shear_of(isotropic(property, raw, raw.shear)) / shear_of(sheet);
    }
    section.area_mass = raw.area_mass * model_.raw.control.mass_factor;
    if (!(section.thickness >= 0.0) || !(section.bending > 0.0) || !(section.shear > 0.0) ||
        !(section.area_mass >= 0.0))
      fail("found a T, 12I/T**3, TS/T or NSM below 0, or a stiffness of 0");
    return section;
  }

  // In a mesh without materials all of a property are the same.
  Material isotropic(int32_t property, const RawShell& raw, int32_t id) const {
    if (is_mere_mesh(model_)) {
      Material any;
      any.constants = {1.0, 0.0};
      return any;
    }
    const auto found = model_.raw.materials.find(id);
    const auto other = model_.raw.other_materials.find(id);
    std::string card;
    if (other != model_.raw.other_materials.end()) card = other->second;
    if (found != model_.raw.materials.end())
      card = found->second.kind == Material::Kind::kIsotropic ? "MAT1" : "MAT9";
    if (card == "MAT1") return material_of(model_, id);
    model_.source.fail(
        raw.origin, card.empty() ? fmt::format("PSHELL {}: found no material {}", property, id)
                                 : fmt::format("PSHELL {}: material {} is a {}, expected a MAT1: "
                                               "sheets of isotropic material are read",
                                               property, id, card));
  }

  Model& model_;
  std::map<int32_t, int32_t> regions_;  // by property; -1: refused
  int64_t without_shear_ = 0;
  Origin first_without_shear_ = 0;
};

class ShellReader {
 public:
  explicit ShellReader(Model& model) : model_(model), properties_(model) {}

  ShellCell read(const RawSkin& raw) {
    ShellCell cell;
    cell.kind = raw.kind;
    cell.id = raw.id;
    cell.region = properties_.region_of(raw);
    cell.offset = raw.offset;
    cell.face = face_of_shell(model_, raw);
    const auto shell = model_.raw.shells.find(raw.property);
    if (shell != model_.raw.shells.end()) take_thickness(raw, shell->second.thickness, cell);
    return cell;
  }

  void note() const { properties_.note_shear(); }

 private:
  void take_thickness(const RawSkin& raw, double usual, ShellCell& cell) const {
    for (size_t i = 0; i < static_cast<size_t>(traits(raw.type).corners); ++i) {
      const double own = raw.thickness[i];
      const double t = std::isnan(own) ? usual : raw.is_relative ? own * usual : own;
      if (!(t > 0.0) && !(t == 0.0 && is_mere_mesh(model_)))
        model_.source.fail(raw.origin,
                           fmt::format("{} {}: found a thickness of {:g}, expected more than 0: T "
                                       "of its PSHELL, or T1 to T{}",
                                       raw.kind, raw.id, t, traits(raw.type).corners));
      cell.face.values[i] = t;
    }
  }

  Model& model_;
  ShellProperties properties_;
};

void check_shell_numbers(const Model& model) {
  const auto& cells = model.raw.shell_cells;
  std::vector<int32_t> ids;
  for (const RawSkin& cell : cells) ids.push_back(cell.id);
  const IdIndex index(ids);
  if (index.duplicates().empty()) return;
  const auto& [first, second] = index.duplicates().front();
  model.source.fail(cells[second].origin,
                    fmt::format("cell {}: found another one with this number at {}", ids[second],
                                model.source.where(cells[first].origin)));
}

}  // namespace

ShellFace face_of_shell(const Model& model, const RawSkin& raw) {
  ShellFace face{.type = raw.type};
  for (size_t i = 0; i < static_cast<size_t>(traits(raw.type).nodes); ++i)
    face.nodes[i] = model.find(raw.grids[i], raw.origin);
  if (raw.centre != kNoRow) face.centre = model.node_map.find(static_cast<size_t>(raw.centre));
  return face;
}

void build_shells(Model& model) {
  if (model.raw.shell_cells.empty()) return;
  check_shell_numbers(model);
  ShellReader reader(model);
  std::vector<ShellCell> cells;
  std::vector<Origin> origins;
  for (const RawSkin& raw : model.raw.shell_cells)
    if (model.refusals.attempt([&] { cells.push_back(reader.read(raw)); }))
      origins.push_back(raw.origin);
  model.hinges = add_shells(
      model.deck, cells, [&](size_t i) { return model.source.where(origins[i]); }, model.refusals);
  reader.note();
}

}  // namespace clatter::mesh::deck::nastran
