// clatter-mesh: from a part's description, or a deck of another program, to a proved mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/artefact.hpp"
#include "core/command_line.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/stopwatch.hpp"
#include "core/whole_file.hpp"
#include "mesh/boundary.hpp"
#include "mesh/certify_mesh.hpp"
#include "mesh/deck/import.hpp"
#include "mesh/deck/recipe_text.hpp"
#include "mesh/mesh_export.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/mesher.hpp"
#include "mesh/metis_partition.hpp"
#include "mesh/msh_reader.hpp"
#include "mesh/poor_cells.hpp"

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
  [surface.clamp]                 # surfaces by where they lie; filters combine
  plane = { normal = [1, 0, 0], height = 0.0 }

A deck of Nastran (.bdf, .nas, .dat) or Abaqus and CalculiX (.inp) is read as it is; what it says
beside its mesh (materials, couplings, supports, loads) goes to the fe.toml of the next stage:
  clatter-mesh part.inp --units mm-t-s -o part.mesh.h5 --recipe part.fe.toml
  clatter-mesh part.bdf --units m-kg-s --ignore CQUAD4 -o part.mesh.h5
  clatter-mesh part.msh --units mm-t-s -o part.mesh.h5     (Gmsh, MSH 2 or 4: groups are regions,
                                                            surfaces and node sets)
Units: m-kg-s, mm-t-s (N, MPa), mm-kg-ms (kN, GPa), mm-kg-s, cm-g-s, in-lbfs2/in-s. In a
description: kind = "deck" with [deck] source, units, ignore.

Any CAD file: kind = "cad" with [cad] source = "part.step", defeature_below = 0.5 to take out faces
narrower than that (fillets, chamfers, tiny holes); surfaces by
cylinder = { radius, point, axis }, plane = { normal, height }, box = { min, max },
outside = { min, max }.

Examples:
  clatter-mesh block.mesh.toml -o block.mesh.h5 --write-step block.step
  clatter-mesh piston.mesh.toml -o piston.mesh.h5 --export piston.vtu --export piston.inp

See mesh/README.md for each kind's dimensions and surfaces. Next stage: clatter-assembly.)";

struct Arguments {
  std::filesystem::path input, output, step, recipe;
  std::vector<std::filesystem::path> exports;
  std::string units;
  std::vector<std::string> ignore;
  int parts = 0;
  bool accept_poor_cells = false;
};

/// A mesh with what is written beside it.
struct Outcome {
  Mesh mesh;
  QualityReport quality;
  std::map<std::string, double> certificate;
  Provenance provenance;
  std::string recipe;  // fe.toml of a deck
};

void report(const Outcome& result) {
  const auto& c = result.certificate;
  const Measure& angle = result.quality.min_dihedral_deg;
  say(fmt::format("mesh: {:.0f} cells, {:.0f} nodes, {:.0f} degrees of freedom", c.at("cells"),
                  c.at("nodes"), c.at("dofs")));
  for (size_t r = 0; r < result.mesh.regions.size(); ++r) {
    say(fmt::format("mesh: region {}: volume {:.6g} m3", result.mesh.regions[r],
                    cell_volume(result.mesh, static_cast<int32_t>(r))));
  }
  if (c.contains("volume_against_cad"))
    say(fmt::format("mesh: volume against CAD {:+.2e}", c.at("volume_against_cad")));
  say(fmt::format("mesh: volume against the surface integral {:.1e}",
                  c.at("volume_against_surface_integral")));
  say(
      fmt::format("mesh: smallest dihedral angle {:.1f} deg in cell {} at ({:.4f}, {:.4f}, {:.4f}) "
                  "m, scaled Jacobian {:.3f} in cell {}",
                  angle.worst, angle.label, angle.place.x(), angle.place.y(), angle.place.z(),
                  c.at("min_scaled_jacobian"), result.quality.scaled_jacobian.label));
  if (c.contains("invalid_cells_before_repair"))
    say(fmt::format("mesh: folded cells before repair: {:.0f}, now 0",
                    c.at("invalid_cells_before_repair")));
}

/// Geometry meshed by gmsh.
Outcome mesh_geometry(const Arguments& a, const Config& config, const std::string& name,
                      StepClock& clock) {
  const LengthUnit unit = read_length_unit(config);
  const MeshSettings settings = read_mesh_settings(config);
  GmshSession session(name);
  const PartGeometry part = build_part(session, config);
  config.finish();
  clock.lap("geometry");
  if (!a.step.empty()) session.write_cad(a.step, unit.name);
  PartMesh made = mesh_part(session, part, settings, unit.metres, name, a.input.string());
  const QualityLimits aims = aims_of(settings);
  const PoorCells poor = find_poor_cells(made.mesh, made.quality, aims);
  note_poor_cells(poor, made.certificate);
  judge_poor_cells(poor, made.mesh, aims, {unit.name, unit.metres},
                   settings.accept_poor_cells || a.accept_poor_cells);
  clock.lap("mesh");
  Outcome out{std::move(made.mesh),
              std::move(made.quality),
              std::move(made.certificate),
              {kMeshSchema, config.resolved(), {a.input}},
              {}};
  if (config.text("kind") == "cad")
    out.provenance.inputs.push_back(config.table("cad").path("source"));
  return out;
}

/// A deck with its own cells.
Outcome read_mesh_of_deck(const std::filesystem::path& source, const deck::UnitSystem& units,
                          const std::vector<std::string>& ignore, const std::string& name,
                          StepClock& clock) {
  deck::Deck found =
      is_msh(source) ? read_msh(source, units, {ignore}) : deck::read_deck(source, units, {ignore});
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
  judge_poor_cells(poor, out.mesh, kQualityAims,
                   {units.name.substr(0, units.name.find('-')), units.length},
                   true);  // the mesh is the user's: never refused by quality
  const std::string config = fmt::format("source = \"{}\"\nunits = \"{}\"\nignore = [{}]\n",
                                         source.string(), units.name, fmt::join(ignore, ", "));
  out.provenance = {kMeshSchema, config, {}};
  for (const std::string& file : found.files) out.provenance.inputs.emplace_back(file);
  clock.lap("mesh");
  return out;
}

Outcome make_mesh(const Arguments& a, StepClock& clock) {
  if (deck::is_deck(a.input) || is_msh(a.input)) {
    if (a.units.empty())
      throw InputError(
          fmt::format("{}: found no --units, expected one (decks do not say: clatter "
                      "does not guess)",
                      a.input.string()));
    return read_mesh_of_deck(a.input, deck::unit_system_named(a.units, "--units"), a.ignore,
                             a.input.stem().string(), clock);
  }
  const Config config = Config::load(a.input);
  const std::string name = config.text("name");
  if (config.text("kind") != "deck") return mesh_geometry(a, config, name, clock);
  const Config table = config.table("deck");
  const std::filesystem::path source = table.path("source");
  const auto units = deck::unit_system_named(table.text("units"), table.where() + ": units");
  const std::vector<std::string> ignore = table.texts_or("ignore", {});
  config.finish();
  Outcome out = read_mesh_of_deck(source, units, ignore, name, clock);
  out.provenance.config = config.resolved();
  out.provenance.inputs.push_back(a.input);
  return out;
}

void write_partition(H5File& file, const Partition& partition) {
  say(fmt::format("mesh: {} parts, {} faces between them", partition.parts, partition.cut));
  file.write("partition/part", partition.part);
  file.set("partition", "parts", partition.parts);
  file.set("partition", "cut_faces", partition.cut);
}

int run(const Arguments& a, const CommonOptions& common) {
  StepClock clock;
  const Outcome result = make_mesh(a, clock);
  report(result);
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
  for (const auto& path : a.exports) export_mesh(result.mesh, path);
  write_depfile(common.depfile, a.output, result.provenance.inputs);
  if (common.json) {
    print_json({{"output", json_text(a.output.string())},
                {"cells", json_number(result.certificate.at("cells"))},
                {"dofs", json_number(result.certificate.at("dofs"))},
                {"min_dihedral_deg", json_number(result.certificate.at("min_dihedral_deg"))},
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
        "description of the part (.mesh.toml), or a deck (.inp, .bdf, .nas, .dat, .msh)");
    line.option("-o,--output", a.output, "mesh file to write (.mesh.h5)", true);
    line.option("--units", a.units, "of a deck: mm-t-s, m-kg-s, ... (see below)");
    line.option("--ignore", a.ignore,
                "card, keyword, element kind or group of a deck to skip; may be repeated");
    line.option("--recipe", a.recipe, "also write what a deck says beside its mesh (.fe.toml)");
    line.option("--parts", a.parts, "also divide the cells into this many connected parts (METIS)");
    line.flag("--accept-poor-cells", a.accept_poor_cells,
              "warn, do not refuse, where cells are too poor to be trusted");
    line.option("--write-step", a.step, "also write the geometry (.step or .brep)");
    line.option("--export", a.exports,
                "also write the mesh (.vtu, .msh, .inp, .bdf); may be repeated");
    if (!line.parse(argc, argv)) return line.exit_code();
    return run(a, line.common());
  });
}
