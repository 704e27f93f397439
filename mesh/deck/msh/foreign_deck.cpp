// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/msh/foreign_deck.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "mesh/deck/faces_by_nodes.hpp"
#include "mesh/deck/msh/groups.hpp"

namespace clatter::mesh {
namespace {

std::optional<CellType> cell_type_of(int gmsh_type) {
  for (int t = 0; t < kCellTypes; ++t)
    if (traits(static_cast<CellType>(t)).gmsh_type == gmsh_type) return static_cast<CellType>(t);
  return std::nullopt;
}

std::optional<FaceType> face_type_of(int gmsh_type) {
  for (int t = 0; t < kFaceTypes; ++t)
    if (traits(static_cast<FaceType>(t)).gmsh_type == gmsh_type) return static_cast<FaceType>(t);
  return std::nullopt;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, ForeignMesh found, const deck::ReadOptions& options)
      : path_(path.string()),
        scan_(std::move(found.scan)),
        groups_(path_, scan_, options.ignore),
        contents_(std::move(found.contents)),
        regions_(std::move(found.regions)),
        ignored_(std::move(found.ignored)) {
    for (const std::string& warning : contents_.warnings)
      say(fmt::format("{}: Gmsh: {}", path_, warning));
    deck_.materials = std::move(found.materials);
    deck_.notes = std::move(found.notes);
    groups_.learn(contents_);
    deck_.mesh.name = path.stem().string();
    deck_.files = {path_};
  }

  deck::Deck run() {
    number_nodes();
    add_cells();
    sort_nodes();
    add_surfaces();
    add_node_sets();
    deck_.ignored = groups_.ignored();
    deck_.ignored.insert(ignored_.begin(), ignored_.end());
    const int64_t unused =
        scan_.nodes - deck_.mesh.nodes.rows() - static_cast<int64_t>(deck_.points.size());
    if (unused > 0) deck_.ignored["nodes that nothing uses"] = unused;
    return std::move(deck_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", path_, what));
  }

  int32_t id_of(size_t tag) const {
    if (tag == 0 || tag > static_cast<size_t>(std::numeric_limits<int32_t>::max()))
      fail(fmt::format("found number {}, expected 1 to 2147483647", tag));
    return static_cast<int32_t>(tag);
  }

  // Index of each node number among the file's nodes.
  void number_nodes() {
    by_tag_.resize(contents_.node_tags.size());
    for (size_t i = 0; i < by_tag_.size(); ++i) by_tag_[i] = i;
    std::sort(by_tag_.begin(), by_tag_.end(),
              [&](size_t a, size_t b) { return contents_.node_tags[a] < contents_.node_tags[b]; });
    row_.assign(by_tag_.size(), -1);
    used_.assign(by_tag_.size(), 0);
  }

  size_t node_at(size_t tag, size_t element) const {
    const auto at = std::lower_bound(by_tag_.begin(), by_tag_.end(), tag, [&](size_t i, size_t t) {
      return contents_.node_tags[i] < t;
    });
    if (at == by_tag_.end() || contents_.node_tags[*at] != tag)
      fail(fmt::format("element {}: found no node {}", element, tag));
    return *at;
  }

  void refuse_kind(const MshElements& elements, const char* known) const {
    fail(fmt::format("element {} is a {}, expected {}; --ignore \"{}\" skips all of these",
                     elements.tags.front(), elements.kind, known, elements.kind));
  }

  // One block for cells of one type and region, in the file's order.
  void add_cells() {
    std::map<std::pair<int, CellType>, std::vector<std::pair<const MshElements*, size_t>>> blocks;
    for (const MshElements& elements : contents_.elements) {
      if (elements.dim != 3 || elements.tags.empty() || groups_.skips(elements)) continue;
      const auto type = cell_type_of(elements.gmsh_type);
      if (!type) refuse_kind(elements, "tet4/10, hex8/20, wedge6/15 or pyramid5/13");
      for (size_t e = 0; e < elements.tags.size(); ++e)
        if (const auto region = groups_.region_of(elements, e))
          blocks[{*region, *type}].emplace_back(&elements, e);
    }
    std::map<int, int32_t> number_of;
    for (const auto& [key, cells] : blocks) {
      const auto [at, is_new] = number_of.emplace(key.first, deck_.mesh.regions.size());
      if (is_new) {
        const std::string name = groups_.region_name(key.first);
        const auto known = regions_.find(name);
        deck_.mesh.regions.push_back(name);
        deck_.regions.push_back(known == regions_.end() ? deck::Region{{}, {}, path_, {}}
                                                        : known->second);
      }
      add_block(key.second, at->second, cells);
    }
  }

  void add_block(CellType type, int32_t region,
                 const std::vector<std::pair<const MshElements*, size_t>>& cells) {
    CellBlock block{type, region, {}, {}};
    const int n = traits(type).nodes;
    block.nodes.resize(static_cast<Eigen::Index>(cells.size()), n);
    for (size_t c = 0; c < cells.size(); ++c) {
      const auto& [elements, e] = cells[c];
      block.ids.push_back(id_of(elements->tags[e]));
      for (int i = 0; i < n; ++i) {
        const size_t node =
            node_at(elements->nodes[e * static_cast<size_t>(n) + static_cast<size_t>(i)],
                    elements->tags[e]);
        used_[node] = 1;
        block.nodes(static_cast<Eigen::Index>(c), i) = static_cast<int32_t>(node);
      }
    }
    deck_.mesh.cells.push_back(std::move(block));
  }

  Eigen::Vector3d point_at(size_t node) const {
    return Eigen::Vector3d::Map(contents_.coordinates.data() + 3 * node);
  }

  // Rows in ascending order of the numbers; nodes used only by groups of curves and points follow
  // as points.
  void sort_nodes() {
    for (const MshElements& elements : contents_.elements) {
      if (elements.dim > 1 || groups_.skips(elements)) continue;
      for (size_t e = 0; e < elements.tags.size(); ++e) {
        if (groups_.of(elements, e).empty()) continue;
        for (size_t i = 0; i < static_cast<size_t>(elements.nodes_each); ++i) {
          char& used = used_[node_at(
              elements.nodes[e * static_cast<size_t>(elements.nodes_each) + i], elements.tags[e])];
          if (used == 0) used = 2;
        }
      }
    }
    Mesh& mesh = deck_.mesh;
    const auto n = std::count(used_.begin(), used_.end(), 1);
    mesh.nodes.resize(n, 3);
    int32_t row = 0, point = static_cast<int32_t>(n);
    for (size_t node : by_tag_) {
      const int32_t id = used_[node] == 0 ? 0 : id_of(contents_.node_tags[node]);
      if (used_[node] == 1) {
        mesh.nodes.row(row) = point_at(node).transpose();
        mesh.node_ids.push_back(id);
        row_[node] = row++;
      } else if (used_[node] == 2) {
        deck_.points.push_back({id, point_at(node)});
        row_[node] = point++;
      }
    }
    for (CellBlock& block : mesh.cells)
      for (Eigen::Index i = 0; i < block.nodes.size(); ++i)
        block.nodes.data()[i] = row_[block.nodes.data()[i]];
  }

  void add_surfaces() {
    std::map<std::string, SurfaceBuilder> builders;
    std::optional<deck::FacesByNodes> faces;
    for (const MshElements& elements : contents_.elements) {
      if (elements.dim != 2 || elements.tags.empty() || groups_.skips(elements)) continue;
      for (size_t e = 0; e < elements.tags.size(); ++e) {
        const auto names = groups_.of(elements, e);
        if (names.empty()) continue;
        if (!face_type_of(elements.gmsh_type)) refuse_kind(elements, "tri3, tri6, quad4 or quad8");
        if (!faces) faces.emplace(deck_.mesh);
        const BoundaryFace face = face_of(elements, e, names.front(), *faces);
        for (const std::string& name : names) builders[name].add(face.type, face.ids);
      }
    }
    for (const auto& [name, builder] : builders) {
      Surface surface = builder.finish();
      if (name == "skin") {
        check_skin(surface);
      } else {
        deck_.mesh.surfaces[name] = std::move(surface);
      }
    }
  }

  // The cell face of an element.
  BoundaryFace face_of(const MshElements& elements, size_t e, const std::string& group,
                       const deck::FacesByNodes& faces) const {
    using Fit = deck::FacesByNodes::Fit;
    const FaceType type = *face_type_of(elements.gmsh_type);
    std::array<int32_t, kMaxFaceNodes> ids{};
    const auto n = static_cast<size_t>(traits(type).nodes);
    for (size_t i = 0; i < n; ++i)
      ids[i] = row_[node_at(elements.nodes[e * n + i], elements.tags[e])];
    const std::string what =
        fmt::format("element {} ({}) of surface '{}'", elements.tags[e], elements.kind, group);
    const auto [fit, face, has_more_nodes] = faces.find(type, std::span(ids).first(n));
    if (fit == Fit::kNone)
      fail(fmt::format(
          "{} is not a face of a cell; --ignore \"{}\" skips the group, --ignore \"{}\" "
          "all elements of the kind",
          what, group, elements.kind));
    if (fit == Fit::kOtherNodes || has_more_nodes)
      fail(fmt::format("{} has other nodes than the {} of its cell there", what,
                       traits(face.type).name));
    if (fit == Fit::kInside)
      fail(
          fmt::format("{} lies within region '{}', expected a face of the boundary or between "
                      "regions; --ignore \"{}\" skips the group",
                      what, deck_.mesh.regions[deck_.mesh.cells[face.block].region], group));
    return face;
  }

  void check_skin(const Surface& surface) const {
    const Surface entire = skin_of(boundary_faces(deck_.mesh));
    if (surface.face_count() == entire.face_count() && nodes_of(surface) == nodes_of(entire))
      return;
    fail("found a group 'skin' that is not the entire boundary, expected another name");
  }

  void add_node_sets() {
    std::map<std::string, std::set<int32_t>> sets;
    for (const MshElements& elements : contents_.elements) {
      if (elements.dim > 1 || groups_.skips(elements)) continue;
      const auto n = static_cast<size_t>(elements.nodes_each);
      for (size_t e = 0; e < elements.tags.size(); ++e)
        for (const std::string& name : groups_.of(elements, e))
          for (size_t i = 0; i < n; ++i)
            sets[name].insert(row_[node_at(elements.nodes[e * n + i], elements.tags[e])]);
    }
    for (const auto& [name, node_indices] : sets) {
      const std::vector<int32_t> list(node_indices.begin(), node_indices.end());
      if (list.back() < deck_.mesh.nodes.rows())
        deck_.mesh.node_sets[name] = list;
      else
        deck_.sets[name] = list;
    }
  }

  std::string path_;
  MshScan scan_;
  MshGroups groups_;
  MshContents contents_;
  std::map<std::string, deck::Region> regions_;  // of the file, by name
  std::map<std::string, int64_t> ignored_;
  deck::Deck deck_;
  std::vector<size_t> by_tag_;
  std::vector<int32_t> row_;
  std::vector<char> used_;  // 1: by a cell, 2: by a group of curves or points only
};

}  // namespace

deck::Deck deck_of(ForeignMesh found, const std::filesystem::path& path,
                   const deck::ReadOptions& options) {
  return Reader(path, std::move(found), options).run();
}

}  // namespace clatter::mesh
