// SPDX-License-Identifier: GPL-3.0-or-later
// Cells and nodes: deck numbers become rows; grids without cells are skipped.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "mesh/deck/cell_repair.hpp"
#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/shell_shape.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void check_cell_numbers(Model& model) {
  std::vector<int32_t> ids;
  std::vector<Origin> origins;
  for (const RawBlock& block : model.raw.blocks) {
    ids.insert(ids.end(), block.ids.begin(), block.ids.end());
    origins.insert(origins.end(), block.origins.begin(), block.origins.end());
  }
  model.cells = IdIndex(ids);
  if (model.cells.duplicates().empty()) return;
  const auto& [first, second] = model.cells.duplicates().front();
  const Origin here = origins[second];
  model.source.fail(here, fmt::format("cell {}: found another one with this number at {}",
                                      ids[second], model.source.where(origins[first])));
}

// GRID numbers of the cells become rows of the GRID table. 0 for the rows that cells use.
std::vector<int32_t> find_rows(Model& model) {
  std::vector<int32_t> mesh_node(model.raw.grids.size(), NodeMap::kNone);
  for (RawBlock& block : model.raw.blocks) {
    const auto per_cell = static_cast<size_t>(traits(block.type).nodes);
    for (size_t i = 0; i < block.nodes.size(); ++i) {
      if (block.nodes[i] == 0) {
        block.nodes[i] = kNoRow;
        continue;
      }
      const int32_t row = model.grids.find(block.nodes[i]);
      if (row < 0) {
        const size_t cell = i / per_cell;
        model.source.fail(block.origins[cell], fmt::format("cell {}: found no GRID {}",
                                                           block.ids[cell], block.nodes[i]));
      }
      block.nodes[i] = row;
      mesh_node[row] = 0;
    }
    block.origins = {};
  }
  return mesh_node;
}

// Nodes of shells have rotations.
void let_shells_turn(Model& model) {
  std::vector<bool> turns(static_cast<size_t>(model.node_map.node_count()), false);
  for (const RawSkin& shell : model.raw.shell_cells) {
    ShellFace face = face_of_shell(model, shell);
    drop_repeated_corner(face);
    for (int i = 0; i < traits(face.type).nodes; ++i)
      turns[static_cast<size_t>(face.nodes[static_cast<size_t>(i)])] = true;
  }
  model.node_map.set_turning(std::move(turns));
}

// Faces of loads are looked up in the cells as they are afterwards.
void repair(Model& model) {
  const std::string& deck = model.source.files().front();
  model.deck.renumbered = repair_cells(model.deck.mesh, deck);
  if (model.deck.renumbered.empty()) return;
  std::vector<int32_t> ids;
  for (const CellBlock& block : model.deck.mesh.cells)
    ids.insert(ids.end(), block.ids.begin(), block.ids.end());
  model.cells = IdIndex(ids);
}

}  // namespace

void build_mesh(Model& model, const Ignore& ignore) {
  check_cell_numbers(model);
  std::vector<int32_t> properties;  // of the regions, ascending
  std::set<int32_t> found;
  for (const RawBlock& block : model.raw.blocks) found.insert(block.property);
  properties.assign(found.begin(), found.end());
  build_regions(model, properties);
  std::vector<int32_t> mesh_node = find_rows(model);
  const std::vector<int32_t> hanging_rows = complete_cells(model, mesh_node);
  find_shells(model, ignore, mesh_node);

  const Grids& grids = model.raw.grids;
  Mesh& mesh = model.deck.mesh;
  int32_t count = 0;
  for (int32_t& node : mesh_node) {
    if (node != NodeMap::kNone) node = count++;
  }
  for (RawBlock& block : model.raw.blocks) {
    CellBlock cells;
    cells.type = block.type;
    const auto at = std::lower_bound(properties.begin(), properties.end(), block.property);
    cells.region = static_cast<int32_t>(at - properties.begin());
    cells.ids = std::move(block.ids);
    cells.nodes.resize(static_cast<Eigen::Index>(cells.ids.size()), traits(block.type).nodes);
    int32_t* node = cells.nodes.data();
    block.nodes.drain([&](int32_t row) { *node++ = mesh_node[row]; });
    mesh.cells.push_back(std::move(cells));
  }
  for (const int32_t id : grids.ids) mesh.deck.largest_node = std::max(mesh.deck.largest_node, id);
  mesh.nodes.resize(count, 3);
  mesh.node_ids.resize(count);
  for (size_t row = 0; row < grids.size(); ++row) {
    const int32_t node = mesh_node[row];
    if (node == NodeMap::kNone) continue;
    mesh.nodes.row(node) << grids.at[row][0], grids.at[row][1], grids.at[row][2];
    mesh.node_ids[node] = grids.ids[row];
  }
  for (const int32_t row : hanging_rows)
    mesh.node_sets[kHangingMidSideNodes].push_back(mesh_node[row]);
  model.node_map.set_mesh_nodes(std::move(mesh_node));
  let_shells_turn(model);
  repair(model);
}

}  // namespace clatter::mesh::deck::nastran
