// SPDX-License-Identifier: GPL-3.0-or-later
// Cells and nodes: deck numbers are rows already; nodes without cells are skipped.
#include <fmt/format.h>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/shell_shape.hpp"
#include "mesh/deck/skins.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Numbers the nodes that cells and shells use, in the order of the deck, and copies them.
std::vector<int32_t> take_nodes(const Numbering& numbering, const ShellParts& shells, Mesh& mesh) {
  std::vector<int32_t> node(static_cast<size_t>(numbering.nodes()), NodeMap::kNone);
  for (const FlatTable& table : numbering.tables()) {
    for (const int32_t row : table.nodes) node[row] = 0;
  }
  for (size_t t = 0; t < numbering.thin().size(); ++t) {
    if (shells.section(static_cast<int32_t>(t)) < 0) continue;
    const ThinElement& shell = numbering.thin()[t];
    ShellFace face{.type = *shell.face, .nodes = shell.nodes};
    drop_repeated_corner(face);  // and the node between equal corners
    for (int i = 0; i < traits(face.type).nodes; ++i) node[face.nodes[static_cast<size_t>(i)]] = 0;
  }
  int32_t count = 0;
  for (int32_t& n : node) {
    if (n == 0) n = count++;
  }
  mesh.nodes.resize(count, 3);
  mesh.node_ids.resize(count);
  mesh.deck.largest_node = numbering.highest_node();
  mesh.deck.largest_element = numbering.highest_element();
  for (size_t row = 0; row < node.size(); ++row) {
    if (node[row] == NodeMap::kNone) continue;
    mesh.nodes.row(node[row]) = numbering.at(static_cast<int32_t>(row));
    mesh.node_ids[node[row]] = numbering.node_ids()[row];
  }
  return node;
}

// Cells of one type and region form one block, in the order of the deck.
class Blocks {
 public:
  Blocks(const Model& model, Mesh& mesh)
      : numbering_(model.numbering),
        region_(model.region_of_cell),
        node_map_(model.node_map),
        mesh_(mesh) {}

  void run() {
    struct Size {
      Origin origin = 0;
      int64_t cells = 0;
    };
    std::map<Key, Size> sizes;
    for_each_cell([&](const FlatTable& table, size_t cell, const Key& key) {
      Size& size = sizes[key];
      if (size.cells++ == 0) size.origin = table.origins[cell];
    });
    std::map<std::pair<Origin, Key>, int64_t> in_order;
    for (const auto& [key, size] : sizes) in_order[{size.origin, key}] = size.cells;
    mesh_.cells.reserve(in_order.size());
    std::map<Key, CellBlock*> blocks;
    for (const auto& [at, cells] : in_order) {
      CellBlock& block = mesh_.cells.emplace_back();
      block.region = at.second.first;
      block.type = at.second.second;
      block.nodes.resize(cells, traits(block.type).nodes);
      block.ids.reserve(cells);
      blocks[at.second] = &block;
    }
    for_each_cell([&](const FlatTable& table, size_t cell, const Key& key) {
      add(table, cell, *blocks[key]);
    });
  }

 private:
  using Key = std::pair<int32_t, CellType>;

  template <class Body>
  void for_each_cell(const Body& body) const {
    for (const FlatTable& table : numbering_.tables()) {
      for (size_t c = 0; c < table.ids.size(); ++c) {
        body(table, c, Key{region_[static_cast<size_t>(table.first) + c], table.type});
      }
    }
  }

  void add(const FlatTable& table, size_t cell, CellBlock& block) const {
    const std::span<const int> p = traits(table.type).to_abaqus;
    const auto row = static_cast<Eigen::Index>(block.ids.size());
    for (size_t i = 0; i < p.size(); ++i) {
      const int32_t from = table.nodes[cell * p.size() + i];
      block.nodes(row, p[i]) =
          node_map_.mesh_node_of(table.first + static_cast<int32_t>(cell), from);
    }
    block.ids.push_back(table.ids[cell]);
  }

  const Numbering& numbering_;
  const std::vector<int32_t>& region_;
  const NodeMap& node_map_;
  Mesh& mesh_;
};

}  // namespace

void build_mesh(Model& model) {
  const bool has_lines =
      std::ranges::any_of(model.numbering.thin(), [](const ThinElement& one) { return !one.face; });
  find_shells(model);
  const bool has_shells =
      std::ranges::any_of(model.shells.section_of, [](int32_t section) { return section >= 0; });
  if (model.numbering.cells() == 0 && !has_lines && !has_shells) {
    model.refusals.raise();
    std::map<std::string, int64_t> others;
    for (const ThinElement& one : model.numbering.thin()) ++others[one.type];
    throw InputError(
        fmt::format("{}: found no solid elements, beams and shells with a section{}, expected "
                    "some of C3D4 C3D5 C3D6 "
                    "C3D8 C3D8I C3D8R C3D10 C3D15 C3D20 C3D20R",
                    model.source.where(model.source.origin()),
                    others.empty() ? "" : fmt::format(" but {}", counted(others))));
  }
  build_regions(model);
  model.node_map.set_mesh_nodes(take_nodes(model.numbering, model.shells, model.deck.mesh));
  cut_bolts(model);
  let_shells_turn(model);
  Blocks(model, model.deck.mesh).run();
  build_shells(model);
}

}  // namespace clatter::mesh::deck::abaqus
