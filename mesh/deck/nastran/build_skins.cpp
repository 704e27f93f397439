// SPDX-License-Identifier: GPL-3.0-or-later
// CQUAD4, CTRIA3 and the like with all corners on solids. Those on faces of solids (for loads,
// radiation, stresses) are surfaces of the mesh.
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

// Others have stiffness, unless the deck is a mesh without properties. What hangs on grids of
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
        "{}: found {} {} whose corners all belong to solids and that are no outer face: nodes of "
        "solids do not turn, so as shells they hang on hinges; ignore = [\"{}\"] leaves out their "
        "stiffness and mass, nodes of their own with an RBE2 or RBE3 to the solid clamp them",
        model.source.where(count.second), count.first, kind, kind));
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

}  // namespace clatter::mesh::deck::nastran
