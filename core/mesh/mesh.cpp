// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/named.hpp"

namespace clatter::mesh {
namespace {

void check_range(const IndexMatrix& ids, int64_t n_nodes, const std::string& where) {
  if (ids.size() == 0) return;
  const auto low = ids.minCoeff(), high = ids.maxCoeff();
  if (low < 0 || high >= n_nodes) {
    throw InputError(fmt::format("{}: found node {}, expected 0 to {}", where, low < 0 ? low : high,
                                 n_nodes - 1));
  }
}

/// Of solids or shells. @param group of the file.
template <class Blocks>
void check_cells(const Mesh& mesh, const Blocks& blocks, const std::string& group,
                 std::vector<bool>& used) {
  for (size_t b = 0; b < blocks.size(); ++b) {
    const auto& block = blocks[b];
    const std::string block_name = fmt::format("{}/{}", group, b);
    if (block.region < 0 || block.region >= static_cast<int32_t>(mesh.regions.size())) {
      throw InputError(fmt::format("{}: found region {}, expected 0 to {}", block_name,
                                   block.region, static_cast<int>(mesh.regions.size()) - 1));
    }
    if (block.nodes.cols() != traits(block.type).nodes) {
      throw InputError(fmt::format("{}: found {} nodes per cell, expected {} for {}", block_name,
                                   block.nodes.cols(), traits(block.type).nodes,
                                   traits(block.type).name));
    }
    check_range(block.nodes, mesh.nodes.rows(), block_name);
    for (Eigen::Index i = 0; i < block.nodes.size(); ++i) {
      used[block.nodes.data()[i]] = true;
    }
  }
}

void check_shells(const Mesh& mesh, const std::string& where) {
  std::vector<bool> solid(mesh.regions.size(), false);
  for (const CellBlock& block : mesh.cells) solid[block.region] = true;
  for (size_t b = 0; b < mesh.shells.size(); ++b) {
    const ShellBlock& block = mesh.shells[b];
    const auto fail = [&](const std::string& found, const std::string& expected) {
      throw InputError(
          fmt::format("{}: shells/{}: found {}, expected {}", where, b, found, expected));
    };
    if (solid[block.region])
      fail(fmt::format("region \"{}\", which has solids too", mesh.regions[block.region]),
           "regions of one kind");
    const bool own = block.thickness.size() > 0;
    if (own && (block.thickness.rows() != block.nodes.rows() ||
                block.thickness.cols() != block.nodes.cols() ||
                !(block.thickness.minCoeff() > 0.0) || !block.thickness.allFinite()))
      fail(fmt::format("{} x {} thicknesses", block.thickness.rows(), block.thickness.cols()),
           "one for each node of each cell, above 0");
    if (block.offset.size() > 0 &&
        (block.offset.size() != block.nodes.rows() || !block.offset.allFinite()))
      fail(fmt::format("{} offsets", block.offset.size()), "one for each cell");
    if (block.axis.size() > 0 &&
        (block.axis.rows() != block.nodes.rows() || block.axis.cols() != 3 ||
         !block.axis.allFinite() || !(block.axis.rowwise().norm().minCoeff() > 0.0)))
      fail(fmt::format("{} x {} numbers of axes", block.axis.rows(), block.axis.cols()),
           "a direction for each cell");
  }
}

}  // namespace

void check_surface(const Surface& surface, int64_t n_nodes, const std::string& where) {
  for (const FaceBlock& block : surface.faces) {
    const FaceTraits& face = traits(block.type);
    if (block.nodes.cols() != face.nodes)
      throw InputError(fmt::format("{}: found {} nodes per face, expected {} for {}", where,
                                   block.nodes.cols(), face.nodes, face.name));
    check_range(block.nodes, n_nodes, where);
  }
}

namespace {

/// Names become dataset paths.
template <class Map>
void check_names(const Map& named, const std::string& what, const std::string& where) {
  for (const auto& [name, value] : named)
    if (name.empty() || name.find('/') != std::string::npos)
      throw InputError(
          fmt::format("{}: {}: found the name '{}', expected one without '/'", where, what, name));
}

void check_sets(const Mesh& mesh, const std::string& where) {
  check_names(mesh.surfaces, "surfaces", where);
  check_names(mesh.node_sets, "node_sets", where);
  check_names(mesh.fields, "fields", where);
  for (const auto& [name, surface] : mesh.surfaces)
    check_surface(surface, mesh.nodes.rows(), where + ": surfaces/" + name);
  for (const auto& [name, ids] : mesh.node_sets) {
    const IndexMatrix row =
        Eigen::Map<const IndexMatrix>(ids.data(), 1, static_cast<Eigen::Index>(ids.size()));
    check_range(row, mesh.nodes.rows(), where + ": node_sets/" + name);
  }
  for (const auto& [name, values] : mesh.fields) {
    if (values.rows() != mesh.nodes.rows() || values.cols() < 1 || !values.allFinite())
      throw InputError(
          fmt::format("{}: fields/{}: found {} x {} values, expected finite ones at "
                      "each of {} nodes",
                      where, name, values.rows(), values.cols(), mesh.nodes.rows()));
  }
}

void check_ids(const Mesh& mesh, const std::string& where) {
  const auto check = [&](size_t found, Eigen::Index expected, const std::string& dataset) {
    if (found != 0 && found != static_cast<size_t>(expected))
      throw InputError(
          fmt::format("{}: {}: found {} numbers, expected {}", where, dataset, found, expected));
  };
  check(mesh.node_ids.size(), mesh.nodes.rows(), "node_ids");
  for (size_t b = 0; b < mesh.cells.size(); ++b)
    check(mesh.cells[b].ids.size(), mesh.cells[b].nodes.rows(), fmt::format("cells/{}/ids", b));
  for (size_t b = 0; b < mesh.shells.size(); ++b)
    check(mesh.shells[b].ids.size(), mesh.shells[b].nodes.rows(), fmt::format("shells/{}/ids", b));
}

}  // namespace

int64_t Mesh::cell_count() const {
  int64_t count = 0;
  for (const CellBlock& block : cells) count += block.nodes.rows();
  for (const ShellBlock& block : shells) count += block.nodes.rows();
  return count;
}

std::vector<int32_t> turning_nodes(const Mesh& mesh) {
  std::vector<bool> turns(static_cast<size_t>(mesh.nodes.rows()), false);
  for (const ShellBlock& block : mesh.shells)
    for (const int32_t node : block.nodes.reshaped()) turns[node] = true;
  for (const int32_t node : mesh.turning) turns[node] = true;
  std::vector<int32_t> nodes;
  for (size_t node = 0; node < turns.size(); ++node)
    if (turns[node]) nodes.push_back(static_cast<int32_t>(node));
  return nodes;
}

const Surface& Mesh::surface(const std::string& surface_name) const {
  return find_named(surfaces, "mesh '" + name + "'", "surface", surface_name);
}

const std::vector<int32_t>& Mesh::node_set(const std::string& set_name) const {
  return find_named(node_sets, "mesh '" + name + "'", "node set", set_name);
}

int64_t Surface::face_count() const {
  int64_t count = 0;
  for (const FaceBlock& block : faces) count += block.nodes.rows();
  return count;
}

void SurfaceBuilder::add(FaceType type, std::span<const int32_t> face) {
  const auto nodes = face.first(static_cast<size_t>(traits(type).nodes));
  std::vector<int32_t>& all = nodes_[static_cast<size_t>(type)];
  all.insert(all.end(), nodes.begin(), nodes.end());
}

Surface SurfaceBuilder::finish() const {
  Surface surface;
  for (size_t t = 0; t < nodes_.size(); ++t) {
    if (nodes_[t].empty()) continue;
    const auto type = static_cast<FaceType>(t);
    const Eigen::Index columns = traits(type).nodes;
    surface.faces.push_back(
        {type,
         Eigen::Map<const IndexMatrix>(
             nodes_[t].data(), static_cast<Eigen::Index>(nodes_[t].size()) / columns, columns)});
  }
  return surface;
}

std::vector<int32_t> nodes_of(const Surface& surface) {
  std::vector<int32_t> ids;
  for (const FaceBlock& block : surface.faces)
    ids.insert(ids.end(), block.nodes.data(), block.nodes.data() + block.nodes.size());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

void check_structure(const Mesh& mesh, const std::string& where) {
  if ((mesh.nodes.rows() == 0) != (mesh.cell_count() == 0)) {
    throw InputError(
        fmt::format("{}: found {} nodes and {} cells, expected at least one of each, or "
                    "neither (points and springs alone)",
                    where, mesh.nodes.rows(), mesh.cell_count()));
  }
  if (mesh.nodes.cols() != 3) {
    throw InputError(
        fmt::format("{}: nodes: found {} columns, expected 3", where, mesh.nodes.cols()));
  }
  for (Eigen::Index i = 0; i < mesh.nodes.rows(); ++i) {
    if (!mesh.nodes.row(i).allFinite()) {
      throw InputError(fmt::format("{}: nodes: row {} is not finite", where, i));
    }
  }
  std::vector<bool> used(static_cast<size_t>(mesh.nodes.rows()), false);
  check_cells(mesh, mesh.cells, where + ": cells", used);
  check_cells(mesh, mesh.shells, where + ": shells", used);
  check_shells(mesh, where);
  const auto lone = std::find(used.begin(), used.end(), false);
  if (lone != used.end()) {
    const auto row = static_cast<size_t>(lone - used.begin());
    const bool numbered = mesh.node_ids.size() == used.size();
    throw InputError(fmt::format("{}: node {} belongs to no cell: it has no stiffness", where,
                                 numbered ? mesh.node_ids[row] : static_cast<int64_t>(row)));
  }
  check_ids(mesh, where);
  check_sets(mesh, where);
  if (mesh.cell_count() > 0) mesh.surface("skin");
}

}  // namespace clatter::mesh
