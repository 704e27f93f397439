// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/mesh_file.hpp"

#include <fmt/format.h>

#include <map>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/mesh/validity.hpp"

namespace clatter::mesh {
namespace {

/// What cells and shells have alike.
template <class Block>
void read_block(const H5File& file, const std::string& group, Block& block) {
  block.region = static_cast<int32_t>(file.get_int(group, "region"));
  block.nodes = file.read_index_matrix(group + "/nodes");
  if (file.has(group + "/ids")) block.ids = file.read_ints(group + "/ids");
}

template <class Block>
void write_block(H5File& file, const Block& block, const std::string& group) {
  file.write(group + "/nodes", block.nodes);
  file.set(group, "type", std::string(traits(block.type).name));
  file.set(group, "region", static_cast<int64_t>(block.region));
  if (!block.ids.empty()) file.write(group + "/ids", block.ids);
}

CellBlock read_cell_block(const H5File& file, const std::string& group, const std::string& where) {
  CellBlock block;
  block.type = cell_type_named(file.get_string(group, "type"), where + ": " + group);
  read_block(file, group, block);
  return block;
}

ShellBlock read_shell_block(const H5File& file, const std::string& group,
                            const std::string& where) {
  ShellBlock block;
  block.type = face_type_named(file.get_string(group, "type"), where + ": " + group);
  read_block(file, group, block);
  if (file.has(group + "/thickness")) block.thickness = file.read_rows(group + "/thickness");
  if (file.has(group + "/offset")) block.offset = file.read_vector(group + "/offset");
  if (file.has(group + "/axis")) block.axis = file.read_rows(group + "/axis");
  return block;
}

void refuse_invalid_cells(const Mesh& mesh, const std::string& where) {
  const ValidityReport report = check_validity(mesh);
  if (report.invalid.empty()) return;
  throw InputError(fmt::format("{}: {} of {} cells are inverted or folded, expected det J > 0; {}",
                               where, report.invalid.size(), mesh.cell_count(),
                               describe_invalid(report, 1)));
}

}  // namespace

void write_mesh(H5File& file, const Mesh& mesh) {
  file.set("/", "name", mesh.name);
  file.write("nodes", mesh.nodes);
  file.write("regions", mesh.regions);
  write_cells(file, mesh.cells);
  write_shells(file, mesh.shells);
  write_surfaces(file, mesh.surfaces);
  for (const auto& [name, ids] : mesh.node_sets) file.write("node_sets/" + name, ids);
  for (const auto& [name, values] : mesh.fields) file.write("fields/" + name, values);
  if (!mesh.node_ids.empty()) file.write("node_ids", mesh.node_ids);
  write_deck_origin(file, mesh.deck);
}

void write_cells(H5File& file, const std::vector<CellBlock>& cells) {
  for (size_t b = 0; b < cells.size(); ++b) write_block(file, cells[b], fmt::format("cells/{}", b));
}

std::vector<CellBlock> read_cells(const H5File& file) {
  std::vector<CellBlock> cells;
  const size_t n_blocks = file.list("cells").size();
  for (size_t b = 0; b < n_blocks; ++b)
    cells.push_back(read_cell_block(file, fmt::format("cells/{}", b), file.path().string()));
  return cells;
}

void write_shells(H5File& file, const std::vector<ShellBlock>& shells) {
  for (size_t b = 0; b < shells.size(); ++b) {
    const std::string group = fmt::format("shells/{}", b);
    write_block(file, shells[b], group);
    if (shells[b].thickness.size() > 0) file.write(group + "/thickness", shells[b].thickness);
    if (shells[b].offset.size() > 0) file.write(group + "/offset", shells[b].offset);
    if (shells[b].axis.size() > 0) file.write(group + "/axis", shells[b].axis);
  }
}

std::vector<ShellBlock> read_shells(const H5File& file) {
  std::vector<ShellBlock> shells;
  const size_t n_blocks = file.list("shells").size();
  for (size_t b = 0; b < n_blocks; ++b)
    shells.push_back(read_shell_block(file, fmt::format("shells/{}", b), file.path().string()));
  return shells;
}

void write_surfaces(H5File& file, const std::map<std::string, Surface>& surfaces) {
  for (const auto& [name, surface] : surfaces) {
    file.set("surfaces/" + name, "faces", surface.face_count());
    for (const FaceBlock& block : surface.faces)
      file.write(fmt::format("surfaces/{}/{}", name, traits(block.type).name), block.nodes);
  }
}

std::map<std::string, Surface> read_surfaces(const H5File& file, int64_t n_nodes,
                                             const std::string& where) {
  std::map<std::string, Surface> surfaces;
  for (const std::string& name : file.list("surfaces")) {
    const std::string group = "surfaces/" + name;
    Surface& surface = surfaces[name];
    for (const std::string& type : file.list(group))
      surface.faces.push_back({face_type_named(type, where + ": " + group),
                               file.read_index_matrix(group + "/" + type)});
    check_surface(surface, n_nodes, where + ": " + group);
  }
  return surfaces;
}

Mesh read_mesh(const std::filesystem::path& path) {
  const H5File file = open_artefact(path, kMeshSchema);
  const std::string where = path.string();
  Mesh mesh;
  mesh.name = file.get_string("/", "name");
  mesh.nodes = file.read_rows("nodes");
  mesh.regions = file.read_strings("regions");
  mesh.cells = read_cells(file);
  mesh.shells = read_shells(file);
  mesh.surfaces = read_surfaces(file, mesh.nodes.rows(), where);
  for (const std::string& name : file.list("node_sets")) {
    mesh.node_sets[name] = file.read_ints("node_sets/" + name);
  }
  for (const std::string& name : file.list("fields"))
    mesh.fields[name] = file.read_rows("fields/" + name);
  if (file.has("node_ids")) mesh.node_ids = file.read_ints("node_ids");
  mesh.deck = read_deck_origin(file);
  check_structure(mesh, where);
  refuse_invalid_cells(mesh, where);
  return mesh;
}

}  // namespace clatter::mesh
