// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces from comments, and faces of loads.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <span>

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

namespace {

[[noreturn]] void refuse(const Model& model, const RawPressure& raw, const std::string& message) {
  model.source.fail(raw.origin, fmt::format("{}: {}", raw.cell == 0 ? "PLOAD" : "PLOAD4", message));
}

// All corners of the cell that are the grid: several in a hexahedron with repeated nodes; -1 alone
// for a blank field.
int corner_of(const Model& model, const RawPressure& raw, std::span<const int32_t> corners,
              int32_t grid) {
  if (grid == 0) return -1;
  const NodeIndex node_index = model.find(grid, raw.origin);
  const auto at = std::find(corners.begin(), corners.end(), node_index);
  if (at == corners.end())
    refuse(model, raw, fmt::format("node {} is not a corner of cell {}", grid, raw.cell));
  return static_cast<int>(at - corners.begin());
}

// The face that G1 and G3 or G4 define, null if there is none. A triangle of a wedge, pyramid or
// tetrahedron that was a hexahedron with repeated nodes has both.
const CellFace* meant_face(const CellTraits& cell, int g1, int g34) {
  if (g1 == g34 || g1 < 0) return nullptr;
  for (const CellFace& face : cell.faces)
    if (is_meant(cell, face, g1, g34)) return &face;
  if (cell.corners == 8 || g34 < 0) return nullptr;
  for (const CellFace& face : cell.faces)
    if (traits(face.type).corners == 3 && corner_in(face, g1) >= 0 && corner_in(face, g34) >= 0)
      return cell.corners == 6 ? &face : nullptr;
  return nullptr;
}

std::pair<const CellBlock*, Eigen::Index> cell_of(const Model& model, const RawPressure& raw) {
  Eigen::Index row = model.cells.find(raw.cell);
  if (row < 0) refuse(model, raw, fmt::format("found no solid {}", raw.cell));
  auto block = model.deck.mesh.cells.begin();
  for (; row >= block->nodes.rows(); ++block) row -= block->nodes.rows();
  return {&*block, row};
}

LoadedFace loaded(const CellBlock& block, Eigen::Index row, const CellFace& face, int g1) {
  LoadedFace out{face.type, {}, corner_in(face, g1)};
  for (int i = 0; i < traits(face.type).nodes; ++i) {
    const auto at = static_cast<size_t>(i);
    out.nodes[at] = block.nodes(row, face.nodes[at]);
  }
  return out;
}

}  // namespace

LoadedFace face_of_corners(Model& model, const RawPressure& raw,
                           const std::array<int32_t, 3>& grids) {
  const auto [block, row] = cell_of(model, raw);
  const CellTraits& cell = traits(block->type);
  const std::span corners(block->nodes.row(row).data(), static_cast<size_t>(cell.corners));
  std::array<int, 3> at{};
  for (size_t k = 0; k < 3; ++k) at[k] = corner_of(model, raw, corners, grids[k]);
  for (const CellFace& face : cell.faces)
    if (std::all_of(at.begin(), at.end(), [&](int c) { return corner_in(face, c) >= 0; }))
      return loaded(*block, row, face, at[0]);
  refuse(model, raw,
         fmt::format("grids {} lie on no face of cell {}", fmt::join(grids, ", "), raw.cell));
}

LoadedFace face_of_cell(Model& model, const RawPressure& raw) {
  const auto [block, row] = cell_of(model, raw);
  const CellTraits& cell = traits(block->type);
  const std::span corners(block->nodes.row(row).data(), static_cast<size_t>(cell.corners));
  const int g1 = corner_of(model, raw, corners, raw.g1),
            g34 = corner_of(model, raw, corners, raw.g34);
  const CellFace* face = meant_face(cell, g1, g34);
  if (face == nullptr)
    refuse(model, raw,
           fmt::format("G1 = {} and G3 or G4 = {} define no face of cell {}",
                       raw.g1 == 0 ? "blank" : std::to_string(raw.g1),
                       raw.g34 == 0 ? "blank" : std::to_string(raw.g34), raw.cell));
  return loaded(*block, row, *face, g1);
}

std::optional<LoadedFace> boundary_face(Model& model, std::span<const int32_t> grids,
                                        Origin origin) {
  std::vector<int32_t> nodes;
  for (const int32_t grid : grids) {
    const NodeIndex node_index = model.find(grid, origin);
    if (node_index < 0 || model.node_map.is_point(node_index)) return std::nullopt;
    nodes.push_back(node_index);
  }
  const FaceType type = nodes.size() == 3 ? FaceType::kTri3 : FaceType::kQuad4;
  const auto found = model.boundary().find(face_key(type, nodes));
  if (found == model.boundary().end()) return std::nullopt;
  const BoundaryFace& face = found->second;
  const auto corners = face.nodes().first(nodes.size());
  const auto first = std::find(corners.begin(), corners.end(), nodes[0]) - corners.begin();
  LoadedFace out{face.type, face.ids, static_cast<int>(first)};
  // The order of the grids is outward when the second follows the first.
  out.outward = corners[static_cast<size_t>(first + 1) % nodes.size()] == nodes[1];
  return out;
}

LoadedFace face_of_grids(Model& model, const RawPressure& raw) {
  const std::span grids(raw.corners.data(), raw.corners[3] == 0 ? 3U : 4U);
  if (const auto face = boundary_face(model, grids, raw.origin)) return *face;
  LoadedFace out{grids.size() == 3 ? FaceType::kTri3 : FaceType::kQuad4, {}, 0};
  out.on_solid = false;
  for (size_t k = 0; k < grids.size(); ++k) {
    out.nodes[k] = model.find(grids[k], raw.origin);
    if (out.nodes[k] < 0 || model.node_map.is_point(out.nodes[k]))
      refuse(model, raw, fmt::format("grid {} belongs to no solid", grids[k]));
  }
  return out;
}

}  // namespace clatter::mesh::deck::nastran
