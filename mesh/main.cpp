// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-mesh: from a part's description, or a deck of another program, to a proved mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/base/artefact.hpp"
#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/plausible.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/whole_file.hpp"
#include "core/mesh/boundary.hpp"
#include "core/mesh/mesh_file.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/msh/reader.hpp"
#include "mesh/deck/recipe/text.hpp"
#include "mesh/exports/mesh_export.hpp"
#include "mesh/faces_command.hpp"
#include "mesh/geometry/bare_cad.hpp"
#include "mesh/geometry/cad_unit.hpp"
#include "mesh/part/mesher.hpp"
#include "mesh/part/metis_partition.hpp"
#include "mesh/part/part_in_child.hpp"
#include "mesh/repair/certify_mesh.hpp"
#include "mesh/repair/poor_cells.hpp"

namespace {

using namespace clatter;
using namespace clatter::mesh;

constexpr const char* kEpilog =
    R"(A part is described in TOML (lengths in length_unit, default mm):

  name = "beam"
  kind = "box"                    # block, piston, box, cylinder or cad
  [box]
  size = [200.0, 20.0, 10.0]
  [mesh]
  element_size_mm = 8.0           # the one number that refines everything
  elements_per_turn = 12          # on a full circle, where surfaces are curved
  [[mesh.local]]
  surface = "x_min"
  factor = 0.5                    # of the element size
  elements_per_turn = 24          # and / or: on the surface's smallest radius (fillets, bores)
  growth = 0.3                    # of the size per distance from the surface
  [surface.clamp]                 # surfaces by position; filters combine
  plane = { normal = [1, 0, 0], height = 0.0 }

A deck of Nastran (.bdf, .nas, .dat) or Abaqus and CalculiX (.inp) is read directly; --recipe writes its materials, couplings, supports and loads to the fe.toml of the next stage:
  clatter-mesh part.inp --units mm-t-s -o part.mesh.h5 --recipe part.fe.toml
  clatter-mesh part.bdf --units m-kg-s --ignore CQUAD4 -o part.mesh.h5
  clatter-mesh part.msh --units mm-t-s -o part.mesh.h5     (Gmsh, MSH 2 or 4: groups are regions,
                                                            surfaces and node sets)
Units: m-kg-s, mm-t-s (N, MPa), mm-kg-ms (kN, GPa), mm-kg-s, cm-g-s, in-lbfs2/in-s. In a
description: kind = "deck" with [deck] source, units, ignore.

Any CAD file: kind = "cad" with [cad] source = "part.step", defeature_below = 0.5 to remove faces
narrower than that (fillets, chamfers, tiny holes); surfaces by
cylinder = { radius, point, axis }, plane = { normal, height }, box = { min, max },
outside = { min, max }.

Examples:
  clatter-mesh --faces part.step                 (lists its faces; -o part.faces.h5 to draw them)
  clatter-mesh part.step -o part.mesh.h5         (writes part.mesh.toml too: change it, run it)
  clatter-mesh block.mesh.toml -o block.mesh.h5 --write-step block.step
  clatter-mesh piston.mesh.toml -o piston.mesh.h5 --export piston.vtu --export piston.inp
  clatter-mesh piston.mesh.h5 --export piston.med --export piston.unv     (of a finished mesh)

See mesh/README.md for each kind's dimensions and surfaces. Next stage: clatter-assembly.)";

struct Arguments {
  std::filesystem::path input, output, step, recipe;
  std::vector<std::filesystem::path> exports;
  std::string units;
  std::vector<std::string> ignore;
  int parts = 0;
  ChildLimits limits;  // of the child processes that run Gmsh
  bool faces = false;
  double element_size_mm = 0.0;  // 0: as in the description
  bool accept_poor_cells = false;
};

/// A mesh and the other files to write.
struct Outcome {
  Mesh mesh;
  QualityReport quality;
  MeshCertificate certificate;
  Provenance provenance;
  std::string recipe;       // fe.toml of a deck
  std::string cad;          // of the geometry, if requested
  std::string description;  // mesh.toml of a CAD file without one
};

void report(const Outcome& result) {
  const auto& c = result.certificate;
  const Measure& angle = result.quality.min_dihedral_deg;
  print_result(fmt::format("mesh: {:.0f} cells, {:.0f} nodes, {:.0f} degrees of freedom", c.cells,
                           c.nodes, c.dofs));
  for (size_t r = 0; r < result.mesh.regions.size(); ++r) {
    print_result(fmt::format("mesh: region {}: volume {:.6g} m3", result.mesh.regions[r],
                             cell_volume(result.mesh, static_cast<int32_t>(r))));
  }
  if (c.volume_against_cad)
    print_result(fmt::format("mesh: volume against CAD {:+.2e}", *c.volume_against_cad));
  print_result(fmt::format("mesh: volume against the surface integral {:.1e}",
                           c.volume_against_surface_integral));
  print_result(
      fmt::format("mesh: smallest dihedral angle {:.1f} deg in cell {} at ({:.4f}, {:.4f}, {:.4f}) "
                  "m, scaled Jacobian {:.3f} in cell {}",
                  angle.worst, angle.label, angle.position.x(), angle.position.y(),
                  angle.position.z(), c.min_scaled_jacobian, result.quality.scaled_jacobian.label));
  if (c.invalid_cells_before_repair)
    print_result(fmt::format("mesh: folded cells before repair: {:.0f}, now 0",
                             *c.invalid_cells_before_repair));
}

/// Geometry meshed by gmsh.
Outcome mesh_geometry(const Arguments& a, const Config& config, const std::string& name,
                      StepClock& clock) {
  const std::string extension = a.step.empty() ? "" : cad_extension(a.step);
  MadePart made = make_part_in_child(
      {&config, name, a.input.string(), extension, 1e-3 * a.element_size_mm}, a.limits);
  clock.adopt(made.steps);
  const MeshSettings settings = read_mesh_settings(config);
  const QualityLimits aims = aims_of(settings);
  const LengthUnit unit = read_length_unit(config);
  const PoorCells poor = find_poor_cells(made.part.mesh, made.part.quality, aims);
  note_poor_cells(poor, made.part.certificate);
  check_poor_cells(poor, made.part.mesh, aims, {unit.name, unit.metres},
                   settings.accept_poor_cells || a.accept_poor_cells);
  Outcome out{std::move(made.part.mesh),
              std::move(made.part.quality),
              std::move(made.part.certificate),
              {kMeshSchema, std::move(made.config), {a.input}},
              {},
              std::move(made.cad),
              {}};
  if (a.element_size_mm > 0.0)
    out.provenance.config += fmt::format("--element-size-mm = {}\n", a.element_size_mm);
  if (config.text("kind") == "cad")
    out.provenance.inputs.push_back(config.table("cad").path("source"));
  return out;
}

/// A deck with its own cells.
Outcome read_mesh_of_deck(const std::filesystem::path& source, const UnitSystem& units,
                          const std::vector<std::string>& ignore, const std::string& name,
                          const ChildLimits& limits, StepClock& clock) {
  deck::Deck found = is_msh(source) ? read_msh(source, units, {ignore}, limits)
                                    : deck::read_deck(source, units, {ignore});
  clock.lap("read");
  for (const auto& [card, count] : found.ignored)
    say(fmt::format("{}: ignored {} ({} times)", source.string(), card, count));
  found.mesh.name = name;
  Outcome out;
  out.recipe = deck::recipe_text(found);
  out.mesh = std::move(found.mesh);
  check_structure(out.mesh, source.string());
  out.quality = measure_quality(out.mesh);
  const PoorCells poor = find_poor_cells(out.mesh, out.quality);
  out.certificate = certify_mesh(out.mesh, out.quality);
  note_poor_cells(poor, out.certificate);
  check_poor_cells(poor, out.mesh, kQualityAims,
                   {units.name.substr(0, units.name.find('-')), units.length},
                   true);  // a mesh of the user is never refused for quality
  const std::string config = fmt::format("source = \"{}\"\nunits = \"{}\"\nignore = [{}]\n",
                                         source.string(), units.name, fmt::join(ignore, ", "));
  out.provenance = {kMeshSchema, config, {}};
  for (const std::string& file : found.files) out.provenance.inputs.emplace_back(file);
  clock.lap("mesh");
  return out;
}

/// A CAD file alone: meshed like the description that is written next to the mesh.
Outcome mesh_bare_cad(const Arguments& a, StepClock& clock) {
  const std::filesystem::path description = description_beside(a.output);
  const double size =
      a.element_size_mm > 0.0 ? a.element_size_mm : default_element_size_mm(a.input, a.limits);
  if (a.element_size_mm == 0.0)
    say(fmt::format(
        "mesh: element size {} mm, from the part's volume (--element-size-mm overrides it)", size));
  const Config config = config_of_cad(a.input, size);
  Outcome out = mesh_geometry(a, config, config.text("name"), clock);
  out.provenance.inputs = {a.input};
  out.description = cad_description(a.input, description, size);
  return out;
}

Outcome make_mesh(const Arguments& a, StepClock& clock) {
  if (is_cad(a.input)) return mesh_bare_cad(a, clock);
  if (deck::is_deck(a.input) || is_msh(a.input)) {
    if (a.units.empty())
      throw InputError(fmt::format("{}: found no --units, expected one (decks have no units)",
                                   a.input.string()));
    return read_mesh_of_deck(a.input, unit_system_named(a.units, "--units"), a.ignore,
                             a.input.stem().string(), a.limits, clock);
  }
  const Config config = Config::load(a.input);
  const std::string name = config.text("name");
  if (config.text("kind") != "deck") return mesh_geometry(a, config, name, clock);
  const Config table = config.table("deck");
  const std::filesystem::path source = table.path("source");
  const auto units = unit_system_named(table.text("units"), table.where() + ": units");
  const std::vector<std::string> ignore = table.texts_or("ignore", {});
  config.finish();
  Outcome out = read_mesh_of_deck(source, units, ignore, name, a.limits, clock);
  out.provenance.config = config.resolved();
  out.provenance.inputs.push_back(a.input);
  return out;
}

void write_partition(H5File& file, const Partition& partition) {
  print_result(
      fmt::format("mesh: {} parts, {} faces between them", partition.parts, partition.cut));
  file.write("partition/part", partition.part);
  file.set("partition", "parts", partition.parts);
  file.set("partition", "cut_faces", partition.cut);
}

/// Exports a finished mesh without meshing again.
int export_file(const Arguments& a, const CommonOptions& common) {
  if (a.exports.empty() || !a.output.empty())
    throw InputError(
        fmt::format("{}: found a mesh, expected one or more --export and no -o", a.input.string()));
  Mesh mesh = read_mesh(a.input);
  for (auto& [name, surface] : mesh.surfaces)  // as after meshing; the file has them by name
    std::sort(surface.faces.begin(), surface.faces.end(),
              [](const FaceBlock& one, const FaceBlock& other) { return one.type < other.type; });
  std::vector<std::string> files;
  for (const auto& path : a.exports) {
    export_mesh(mesh, path);
    files.push_back(json_text(path.string()));
  }
  print_result(fmt::format("{}: {} cells, {} nodes to {}", mesh.name, mesh.cell_count(),
                           mesh.nodes.rows(), fmt::join(files, ", ")));
  write_depfile(common.depfile, a.exports.front(), {a.input});
  if (common.json) print_json({{"files", fmt::format("[{}]", fmt::join(files, ", "))}});
  return 0;
}

int run(const Arguments& a, const CommonOptions& common) {
  if (a.faces) {
    show_faces(a.input, a.output, a.limits, common);
    return 0;
  }
  if (a.input.extension() == ".h5") return export_file(a, common);
  if (a.output.empty()) throw InputError("command line: expected -o part.mesh.h5, or --faces");
  StepClock clock;
  const Outcome result = make_mesh(a, clock);
  report(result);
  const RowMatrix& nodes = result.mesh.nodes;
  warn_implausible(
      a.input.string(),
      {length_warning((nodes.colwise().maxCoeff() - nodes.colwise().minCoeff()).maxCoeff())});
  if (!a.recipe.empty() && result.recipe.empty())
    throw InputError(fmt::format("{}: found no deck, expected one for --recipe", a.input.string()));
  H5File file = H5File::create(a.output);
  write_mesh(file, result.mesh);
  write_quality(file, result.quality);
  if (a.parts > 0) write_partition(file, partition_cells(result.mesh, a.parts));
  write_provenance(file, result.provenance);
  write_certificate(file, result.certificate);
  write_timing(file, clock);
  file.commit();
  if (!a.recipe.empty()) write_whole_file(a.recipe, result.recipe);
  if (!result.cad.empty()) write_whole_file(a.step, result.cad);
  if (!result.description.empty())
    keep_description(description_beside(a.output), result.description);
  for (const auto& path : a.exports) export_mesh(result.mesh, path);
  write_depfile(common.depfile, a.output, result.provenance.inputs);
  if (common.json) {
    const auto& c = result.certificate;
    print_json({{"output", json_text(a.output.string())},
                {"cells", json_number(c.cells)},
                {"predicted_cells", c.predicted_cells ? json_number(*c.predicted_cells) : "null"},
                {"dofs", json_number(c.dofs)},
                {"min_dihedral_deg", json_number(c.min_dihedral_deg)},
                {"seconds", json_number(clock.total_seconds())}});
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return run_guarded("clatter-mesh", [&] {
    Arguments a;
    CommandLine line("clatter-mesh",
                     "Builds or imports a part's geometry and meshes it with quadratic "
                     "tetrahedra, or reads the mesh of a deck; proves it and names its surfaces.",
                     kEpilog);
    line.positional(
        "part", a.input,
        "description of the part (.mesh.toml), CAD (.step, .brep, .iges), a deck (.inp, .bdf, "
        ".nas, .dat, .msh), or with --export a finished mesh (.mesh.h5)");
    line.output("-o,--output", a.output, "mesh file to write (.mesh.h5); with --faces .faces.h5");
    line.flag("--faces", a.faces,
              "list the faces of CAD or a description: number, kind, radius, axis, position, area; "
              "with -o for `clatter plot faces`");
    line.option("--element-size-mm", a.element_size_mm,
                "element size; default: from the description, for CAD alone from its volume");
    line.option("--units", a.units, "units of a deck: mm-t-s, m-kg-s, ... (see below)");
    line.option("--ignore", a.ignore,
                "card, keyword, element kind or group of a deck to skip; may be repeated");
    line.output("--recipe", a.recipe,
                "also write materials, couplings, supports and loads of a deck (.fe.toml)");
    line.option("--parts", a.parts, "also divide the cells into this many connected parts (METIS)");
    line.flag("--accept-poor-cells", a.accept_poor_cells,
              "warn instead of refusing when cells are too poor to be trusted");
    line.output("--write-step", a.step, "also write the geometry (.step or .brep)");
    line.output("--export", a.exports,
                "also write the mesh (.vtu, .msh, .med, .unv, .inp, .bdf); may be repeated");
    line.option("--time-limit", a.limits.seconds,
                "seconds of wall time that gmsh may take; 0: no limit");
    line.memory_limit("gmsh is stopped there with a message");
    if (!line.parse(argc, argv)) return line.exit_code();
    if (!(a.limits.seconds >= 0.0))
      throw InputError(
          fmt::format("--time-limit: found {}, expected seconds or 0", a.limits.seconds));
    return run(a, line.common());
  });
}
