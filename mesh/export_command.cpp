// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/export_command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/write_artefact.hpp"
#include "core/mesh/mesh_file.hpp"
#include "mesh/exports/mesh_export.hpp"

namespace clatter::mesh {
namespace {

struct ExportArguments {
  std::filesystem::path mesh;
  std::vector<std::filesystem::path> outputs;
};

void export_finished_mesh(const ExportArguments& a, const CommonOptions& common) {
  Mesh mesh = read_mesh(a.mesh);
  for (auto& [name, surface] : mesh.surfaces)  // as after meshing; the file has them by name
    std::sort(surface.faces.begin(), surface.faces.end(),
              [](const FaceBlock& one, const FaceBlock& other) { return one.type < other.type; });
  write_exports({a.outputs.front(), a.outputs, {a.mesh}}, common, [&] {
    for (const auto& path : a.outputs) export_mesh(mesh, path);
    return fmt::format("{}: {} cells, {} nodes", mesh.name, mesh.cell_count(), mesh.nodes.rows());
  });
}

}  // namespace

void declare_export(CommandLine& program) {
  CommandLine& line =
      program.command("export", "Writes a finished mesh for other programs.",
                      "samples: clatter-mesh export piston.mesh.h5 piston.vtu\n"
                      "         clatter-mesh export piston.mesh.h5 piston.med piston.unv");
  const auto a = std::make_shared<ExportArguments>();
  line.positional("mesh", a->mesh, "mesh of a part (.mesh.h5)");
  line.output("output", a->outputs,
              "files to write, any number: .vtu, .msh, .med, .unv, .inp, .bdf", true);
  line.action([a](const CommonOptions& common) { export_finished_mesh(*a, common); });
}

}  // namespace clatter::mesh
