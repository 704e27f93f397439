// SPDX-License-Identifier: GPL-3.0-or-later
// CQUAD4, CTRIA3 and the like. Those on faces of solids (for loads, radiation, stresses) are
// surfaces of the mesh; others are shells.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/skins.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

std::vector<SkinCell> cells_of(const Model& model) {
  std::vector<SkinCell> cells;
  for (const RawSkin& raw : model.raw.skins) {
    SkinCell& cell = cells.emplace_back();
    cell.kind = raw.kind;
    cell.type = raw.type;
    for (size_t i = 0; i < static_cast<size_t>(traits(raw.type).nodes); ++i) {
      const NodeIndex node = model.find(raw.grids[i], raw.origin);
      cell.nodes[i] = node >= 0 && model.node_map.is_point(node) ? -1 : node;
    }
  }
  return cells;
}

// A shell has stiffness, unless the deck is a mesh without properties. What hangs on grids of
// shells that the user ignores hangs on nothing.
bool leave_out_shells(Model& model, Ignore& ignore, const Skins& skins) {
  const bool mere_mesh = model.raw.solids.empty() && model.raw.shells.empty();
  std::map<std::string, std::pair<int64_t, Origin>> found;
  for (size_t c = 0; c < skins.size(); ++c) {
    const RawSkin& raw = model.raw.skins[c];
    if (skins.is_surface(c)) continue;
    ++found.try_emplace(raw.kind, 0, raw.origin).first->second.first;
    if (!ignore.lists(raw.kind)) continue;
    const auto* grids = raw.grids.begin();
    model.raw.lost_grids.insert(model.raw.lost_grids.end(), grids, grids + traits(raw.type).nodes);
  }
  bool refused = false;
  for (const auto& [kind, count] : found) {
    if (ignore.skips(kind, count.first) || mere_mesh) continue;
    refused = true;
    model.refusals.add(fmt::format(
        "{}: card {} is not supported (no shells yet): {} of them are not the face of a solid; "
        "ignore = [\"{}\"] leaves out their stiffness and mass: [[spring]], [[coupling]] and "
        "[[point_mass]] of the recipe replace them",
        model.source.where(count.second), kind, count.first, kind));
  }
  return !refused;
}

void note_property(Model& model, const Skins& skins, const RawShell& shell, int32_t property,
                   const std::vector<size_t>& cells) {
  if (shell.card == "PSHELL" && shell.material == 0) return;  // without membrane
  double area = 0.0;
  for (const size_t c : cells) {
    if (skins.is_surface(c)) area += skins.area(c);
  }
  if (area == 0.0) return;
  const auto material = model.raw.materials.find(shell.material);
  const double density = material == model.raw.materials.end() ? 0.0 : material->second.density;
  model.deck.notes.push_back(
      fmt::format("{}: {}", model.source.where(shell.origin),
                  skin_loss(fmt::format("{} {}", shell.card, property), shell.thickness,
                            area * shell.thickness * density)));
}

}  // namespace

void build_skins(Model& model, Ignore& ignore) {
  if (!model.raw.skins.empty()) {
    Skins skins(model.deck, cells_of(model));
    if (!leave_out_shells(model, ignore, skins)) return;
    std::map<int32_t, std::vector<size_t>> groups;
    for (size_t c = 0; c < skins.size(); ++c) groups[model.raw.skins[c].property].push_back(c);
    for (const auto& [property, cells] : groups) {
      const auto named = model.raw.region_names.find(property);
      skins.add_surface(
          named == model.raw.region_names.end() ? fmt::format("pid_{}", property) : named->second,
          cells);
    }
    skins.note(model.source.where(model.raw.skins.front().origin));
    for (const auto& [property, cells] : groups) {
      const auto shell = model.raw.shells.find(property);
      if (shell != model.raw.shells.end())
        note_property(model, skins, shell->second, property, cells);
    }
  }
  std::sort(model.raw.lost_grids.begin(), model.raw.lost_grids.end());
}

std::vector<LoadedFace> faces_of_skins(Model& model, const RawSkinPressure& raw) {
  const auto& skins = model.raw.skins;
  if (!model.skins) {
    std::vector<int32_t> ids;
    for (const RawSkin& one : skins) ids.push_back(one.id);
    model.skins = IdIndex(ids);
  }
  std::vector<LoadedFace> faces;
  model.spend(model.skins->effort(raw.cells.first, raw.cells.last), raw.origin);
  model.skins->for_each(raw.cells.first, raw.cells.last, raw.cells.step, [&](int32_t row) {
    const RawSkin& one = skins[row];
    const auto corners = std::span(one.grids).first(static_cast<size_t>(traits(one.type).corners));
    model.spend(16, raw.origin);
    if (const auto face = boundary_face(model, corners, raw.origin)) faces.push_back(*face);
  });
  if (faces.empty())
    model.source.fail(
        raw.origin,
        model.cells.find(raw.cells.first) >= 0
            ? fmt::format("PLOAD4: G1 of solid {}: found nothing, expected a grid", raw.cells.first)
            : fmt::format("found no two-dimensional cell {} on a face of a solid",
                          raw.cells.first));
  return faces;
}

}  // namespace clatter::mesh::deck::nastran
