#include "mesh/mesh_file.hpp"

#include <fmt/format.h>

#include "core/artefact.hpp"
#include "core/error.hpp"
#include "mesh/validity.hpp"

namespace clatter::mesh {
namespace {

CellBlock read_block(const H5File& file, const std::string& group, const std::string& where) {
  CellBlock block;
  block.type = cell_type_named(file.get_string(group, "type"), where + ": " + group);
  block.region = static_cast<int32_t>(file.get_int(group, "region"));
  block.nodes = file.read_index_matrix(group + "/nodes");
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
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const CellBlock& block = mesh.cells[b];
    const std::string group = fmt::format("cells/{}", b);
    file.write(group + "/nodes", block.nodes);
    file.set(group, "type", std::string(traits(block.type).name));
    file.set(group, "region", static_cast<int64_t>(block.region));
  }
  for (const auto& [name, surface] : mesh.surfaces) {
    file.write("surfaces/" + name, surface.triangles);
  }
  for (const auto& [name, ids] : mesh.node_sets) file.write("node_sets/" + name, ids);
}

Mesh read_mesh(const std::filesystem::path& path) {
  const H5File file = open_artefact(path, kMeshSchema);
  const std::string where = path.string();
  Mesh mesh;
  mesh.name = file.get_string("/", "name");
  mesh.nodes = file.read_rows("nodes");
  mesh.regions = file.read_strings("regions");
  const size_t n_blocks = file.list("cells").size();
  for (size_t b = 0; b < n_blocks; ++b) {
    mesh.cells.push_back(read_block(file, fmt::format("cells/{}", b), where));
  }
  for (const std::string& name : file.list("surfaces")) {
    mesh.surfaces[name].triangles = file.read_index_matrix("surfaces/" + name);
  }
  for (const std::string& name : file.list("node_sets")) {
    mesh.node_sets[name] = file.read_ints("node_sets/" + name);
  }
  check_structure(mesh, where);
  refuse_invalid_cells(mesh, where);
  return mesh;
}

}  // namespace clatter::mesh
