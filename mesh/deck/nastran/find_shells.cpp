// SPDX-License-Identifier: GPL-3.0-or-later
// Which of CQUAD4, CTRIA3 and the like are shells: those with a corner on no solid, and those with
// a section between corners of solids that are no face.
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/open_faces.hpp"
#include "mesh/deck/shell_shape.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

class ShellFinder {
 public:
  ShellFinder(Model& model, std::vector<int32_t>& mesh_node)
      : model_(model), mesh_node_(mesh_node), solids_(mesh_node) {}

  bool is_shell(const RawSkin& skin) const {
    return is_off_solids(skin) || open_.is_open(rows_of(skin));
  }

  /// Of a skin that may be a shell.
  void add(const RawSkin& skin) {
    if (model_.raw.shells.contains(skin.property) && !is_off_solids(skin)) open_.add(rows_of(skin));
  }

  /// After all skins.
  void add_solids() {
    if (open_.empty()) return;
    std::vector<int32_t> nodes;
    for (const RawBlock& block : model_.raw.blocks) {
      const auto each = static_cast<size_t>(traits(block.type).nodes);
      nodes.resize(each);
      for (size_t first = 0; first < block.nodes.size(); first += each) {
        for (size_t i = 0; i < each; ++i) nodes[i] = block.nodes[first + i] + 1;
        open_.close(block.type, nodes);
      }
    }
  }

  // The nodes of a shell are nodes of the mesh, without that of a side between equal corners.
  void take(RawSkin& skin) {
    if (skin.missing > 0)
      fail(skin,
           fmt::format("found {} of its mid-side grids blank, expected all or none", skin.missing));
    ShellFace face{.type = skin.type};
    const auto nodes = static_cast<size_t>(traits(skin.type).nodes);
    std::copy_n(skin.grids.begin(), nodes, face.nodes.begin());
    for (size_t i = 0; i < nodes; ++i) (void)row_of(skin, skin.grids[i]);
    drop_repeated_corner(face);
    for (size_t i = 0; i < static_cast<size_t>(traits(face.type).nodes); ++i)
      mesh_node_[row_of(skin, face.nodes[i])] = 0;
  }

 private:
  static std::span<const int32_t> corners_of(const RawSkin& skin) {
    return std::span(skin.grids).first(static_cast<size_t>(traits(skin.type).corners));
  }

  // Of its corners, from 1.
  std::vector<int32_t> rows_of(const RawSkin& skin) const {
    std::vector<int32_t> rows;
    for (const int32_t grid : corners_of(skin))
      rows.push_back(static_cast<int32_t>(row_of(skin, grid)) + 1);
    return rows;
  }

  bool is_off_solids(const RawSkin& skin) const {
    return std::ranges::any_of(corners_of(skin), [&](int32_t grid) {
      return solids_[row_of(skin, grid)] == NodeMap::kNone;
    });
  }

  size_t row_of(const RawSkin& skin, int32_t grid) const {
    const int32_t row = model_.grids.find(grid);
    if (row < 0) fail(skin, fmt::format("found no GRID {}", grid));
    return static_cast<size_t>(row);
  }

  [[noreturn]] void fail(const RawSkin& skin, const std::string& message) const {
    model_.source.fail(skin.origin, fmt::format("{} {}: {}", skin.kind, skin.id, message));
  }

  Model& model_;
  std::vector<int32_t>& mesh_node_;
  std::vector<int32_t> solids_;
  OpenFaces open_;
};

}  // namespace

void find_shells(Model& model, const Ignore& ignore, std::vector<int32_t>& mesh_node) {
  RawDeck& raw = model.raw;
  const bool is_skin_of_mesh = raw.solids.empty() && raw.shells.empty() && !raw.blocks.empty();
  if (raw.skins.empty() || is_skin_of_mesh) return;
  ShellFinder finder(model, mesh_node);
  for (const RawSkin& skin : raw.skins)
    if (!ignore.lists(skin.kind)) finder.add(skin);
  finder.add_solids();
  std::vector<RawSkin> skins;
  for (RawSkin& skin : raw.skins) {
    const bool is_shell = !ignore.lists(skin.kind) && finder.is_shell(skin);
    if (is_shell) finder.take(skin);
    (is_shell ? raw.shell_cells : skins).push_back(std::move(skin));
  }
  raw.skins = std::move(skins);
}

}  // namespace clatter::mesh::deck::nastran
