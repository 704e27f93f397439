// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/mesh_command.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"
#include "core/keys/schema_line.hpp"
#include "core/mesh/mesh_file.hpp"
#include "mesh/deck/check.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "mesh/geometry/bare_cad.hpp"
#include "mesh/limits_option.hpp"
#include "mesh/make_mesh.hpp"
#include "mesh/part/metis_partition.hpp"

namespace clatter::mesh {
namespace {

struct MeshArguments {
  MeshRequest request;
  std::filesystem::path recipe;
  std::vector<std::filesystem::path> exports;
  int parts = 0;
  bool check = false;
};

void write_partition(H5File& file, const Partition& partition) {
  print_result(
      fmt::format("mesh: {} parts, {} faces between them", partition.parts, partition.cut));
  file.write("partition/part", partition.part);
  file.set("partition", "parts", partition.parts);
  file.set("partition", "cut_faces", partition.cut);
}

// Prints what the deck holds; InputError when something is refused.
void check_only(const MeshArguments& a, const CommonOptions& common) {
  const deck::CheckedDeck checked = deck::check_deck(a.request.input, a.request.ignore);
  for (const std::string& line : deck::table_of(checked)) print_result(line);
  if (common.json) print_json(deck::json_of(checked));
  if (checked.refused > 0)
    throw InputError(fmt::format(
        "{}: {} refused, see the table", a.request.input.string(),
        checked.refused == 1 ? "1 row is" : fmt::format("{} rows are", checked.refused)));
  print_result(fmt::format("{}: is read: {}", a.request.input.string(), checked.summary));
}

void write_new_mesh(const MeshArguments& a, const CommonOptions& common) {
  const MeshRequest& request = a.request;
  if (a.check) return check_only(a, common);
  if (request.output.empty()) throw InputError("-o,--output is required (see clatter-mesh --help)");
  check_limits(request.limits);
  if (request.input.extension() == ".h5")
    throw InputError(fmt::format(
        "{0}: found .h5, expected a description, CAD or a deck; `clatter-mesh export {0} FILE` "
        "exports a finished mesh",
        request.input.string()));
  for (const auto& path : a.exports) check_export(path);
  StepClock clock;
  const NewMesh made = make_mesh(request, clock);
  for (const std::string& line : describe(made)) print_result(line);
  if (!a.recipe.empty() && !made.recipe)
    throw InputError(fmt::format("{}: --recipe needs a deck", request.input.string()));
  const auto content = [&](H5File& file) {
    write_mesh(file, made.mesh);
    write_quality(file, made.quality);
    if (a.parts > 0) write_partition(file, partition_cells(made.mesh, a.parts));
    write_certificate(file, made.certificate);
  };
  const auto companions = [&] {
    if (!a.recipe.empty())
      write_whole_file(a.recipe, keys::schema_line("fe") + made.recipe->text());
    if (!made.cad.empty()) write_whole_file(request.step, made.cad);
    if (!made.description.empty())
      keep_description(description_beside(request.output), made.description);
    for (const auto& path : a.exports) export_mesh(made.mesh, path);
  };
  write_artefact(request.output, made.provenance, clock, common, content, companions);
  print_json_result(request.output, json_of(made), clock, common);
}

}  // namespace

void declare_mesh(CommandLine& line) {
  const auto a = std::make_shared<MeshArguments>();
  MeshRequest& request = a->request;
  line.positional("part", request.input,
                  "description of the part (.mesh.toml), CAD (.step, .brep, .iges), or a deck "
                  "(.inp, .bdf, .nas, .dat, .fem, .msh, .med, .unv, .cdb)");
  line.output("-o,--output", request.output, "mesh file to write (.mesh.h5)");
  line.flag("--check", a->check,
            "list all that a deck holds: read, passed over, refused with its line; writes nothing");
  line.option("--element-size-mm", request.element_size_mm,
              "element size; default: from the description, for CAD alone from its volume");
  line.option("--units", request.units, "units of a deck: mm-t-s, m-kg-s, ... (see below)");
  line.option("--ignore", request.ignore,
              "card, keyword, element kind or group of a deck to skip; may be repeated");
  line.option("--mass", request.mass,
              "mass matrix in the recipe of a deck: as in the deck (default), consistent, lumped");
  line.output("--recipe", a->recipe,
              "also write materials, couplings, supports and loads of a deck (.fe.toml)");
  line.option("--parts", a->parts, "also divide the cells into this many connected parts (METIS)");
  line.flag("--accept-poor-cells", request.accept_poor_cells,
            "warn instead of refusing when cells are too poor to be trusted");
  line.output("--write-step", request.step, "also write the geometry (.step or .brep)");
  line.output("--export", a->exports,
              "also write the mesh (.vtu, .msh, .med, .unv, .inp, .bdf); may be repeated");
  declare_limits(line, request.limits);
  line.action([a](const CommonOptions& common) { write_new_mesh(*a, common); });
}

}  // namespace clatter::mesh
