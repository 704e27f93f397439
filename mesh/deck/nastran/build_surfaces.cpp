// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces from comments, and faces of PLOAD4.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

// Index of a corner among the face's corners, -1 if it is none of them.
int corner_in(const CellFace& face, int corner) {
  const auto* begin = face.nodes.begin();
  const auto* end = begin + traits(face.type).corners;
  const auto* at = std::find(begin, end, corner);
  return at == end ? -1 : static_cast<int>(at - begin);
}

// Whether G1 and G3 or G4 (local corners, -1: blank) define the face:
//   tetrahedron             G1 on the face, G4 the corner that is not
//   triangle of a wedge     G1 alone
//   quadrangle              G1 and G3 at the ends of a diagonal
//   triangle of a pyramid   G1 and G3 at the ends of its edge on the base
bool is_meant(const CellTraits& cell, const CellFace& face, int g1, int g34) {
  const int first = corner_in(face, g1), second = g34 < 0 ? -1 : corner_in(face, g34);
  if (first < 0) return false;
  if (traits(face.type).corners == 4) return second >= 0 && (first - second) % 2 == 0;
  if (cell.corners == 4) return g34 >= 0 && second < 0;
  if (cell.corners == 6) return g34 < 0;
  return second >= 0 && g1 < 4 && g34 < 4;
}

void add_surface(Model& model, const RawDeck::NamedSurface& raw) {
  SurfaceBuilder surface;
  std::array<int32_t, kMaxFaceNodes> face{};
  for (size_t i = 0; i < raw.types.size(); ++i) {
    const auto nodes = static_cast<size_t>(traits(raw.types[i]).nodes);
    for (size_t k = 0; k < nodes; ++k) {
      const int32_t grid = raw.nodes[kMaxFaceNodes * i + k];
      face[k] = model.find(grid, raw.origin);
      if (face[k] >= 0 && !model.node_map.is_point(face[k])) continue;
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

void build_surfaces(Model& model) {
  for (const auto& surface : model.raw.surfaces) {
    model.refusals.attempt([&] { add_surface(model, surface); });
  }
}

void add_face(Model& model, const RawPressure& raw, SurfaceBuilder& surface) {
  const auto refuse = [&](const std::string& message) {
    model.source.fail(raw.origin, fmt::format("PLOAD4: {}", message));
  };
  Eigen::Index row = model.cells.find(raw.cell);
  if (row < 0) refuse(fmt::format("found no solid {}", raw.cell));
  auto block = model.deck.mesh.cells.begin();
  for (; row >= block->nodes.rows(); ++block) row -= block->nodes.rows();
  const CellTraits& cell = traits(block->type);
  const auto corner_of = [&](int32_t grid) {
    if (grid == 0) return -1;
    const NodeIndex node_index = model.find(grid, raw.origin);
    for (int i = 0; i < cell.corners; ++i) {
      if (block->nodes(row, i) == node_index) return i;
    }
    refuse(fmt::format("node {} is not a corner of cell {}", grid, raw.cell));
    return -1;
  };
  const int g1 = corner_of(raw.g1), g34 = corner_of(raw.g34);
  for (const CellFace& face : cell.faces) {
    if (g1 == g34 || !is_meant(cell, face, g1, g34)) continue;
    std::array<int32_t, kMaxFaceNodes> nodes{};
    for (int i = 0; i < traits(face.type).nodes; ++i) {
      const auto at = static_cast<size_t>(i);
      nodes[at] = block->nodes(row, face.nodes[at]);
    }
    return surface.add(face.type, nodes);
  }
  refuse(fmt::format("G1 = {} and G3 or G4 = {} define no face of cell {}", raw.g1,
                     raw.g34 == 0 ? "blank" : std::to_string(raw.g34), raw.cell));
}

}  // namespace clatter::mesh::deck::nastran
