// SPDX-License-Identifier: GPL-3.0-or-later
// SET1, and surfaces from comments.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void sort_unique(std::vector<NodeIndex>& node_indices) {
  std::sort(node_indices.begin(), node_indices.end());
  node_indices.erase(std::unique(node_indices.begin(), node_indices.end()), node_indices.end());
}

// Nodes go to the mesh; a set that also contains points is complete in Deck::sets.
void add_set(Model& model, const std::string& name, std::vector<NodeIndex> node_indices,
             Origin origin) {
  if (model.deck.sets.contains(name) || model.deck.mesh.node_sets.contains(name)) {
    model.source.fail(origin, fmt::format("found a second set {}", shown(name)));
  }
  sort_unique(node_indices);
  const auto points = std::lower_bound(node_indices.begin(), node_indices.end(), model.node_count);
  if (points != node_indices.end()) model.deck.sets[name] = node_indices;
  if (points != node_indices.begin()) {
    node_indices.erase(points, node_indices.end());
    model.deck.mesh.node_sets[name] = std::move(node_indices);
  }
}

void add_surface(Model& model, const Bulk::NamedSurface& raw) {
  SurfaceBuilder surface;
  std::array<int32_t, kMaxFaceNodes> face{};
  for (size_t i = 0; i < raw.types.size(); ++i) {
    const auto nodes = static_cast<size_t>(traits(raw.types[i]).nodes);
    for (size_t k = 0; k < nodes; ++k) {
      const int32_t grid = raw.nodes[kMaxFaceNodes * i + k];
      face[k] = model.find(grid, raw.origin);
      if (face[k] >= 0 && model.is_node(face[k])) continue;
      model.source.fail(raw.origin, fmt::format("surface {}: node {} belongs to no solid",
                                                shown(raw.name), grid));
    }
    surface.add(raw.types[i], face);
  }
  if (!model.deck.mesh.surfaces.emplace(raw.name, surface.finish()).second) {
    model.source.fail(raw.origin, fmt::format("found a second surface {}", shown(raw.name)));
  }
}

}  // namespace

void build_sets(Model& model) {
  for (const auto& [id, set] : model.bulk.node_sets) {
    const auto named = model.bulk.set_names.find(id);
    const std::string name =
        named == model.bulk.set_names.end() ? fmt::format("set_{}", id) : named->second;
    model.refusals.attempt([&, &one = set] {
      add_set(model, name, model.node_indices(one.grids, one.origin, false), one.origin);
    });
  }
  for (const auto& surface : model.bulk.surfaces) {
    model.refusals.attempt([&] { add_surface(model, surface); });
  }
}

}  // namespace clatter::mesh::deck::nastran
