// clatter-mesh: from a part's description to a proved mesh.
#include <fmt/format.h>

#include "core/artefact.hpp"
#include "core/command_line.hpp"
#include "core/error.hpp"
#include "core/log.hpp"
#include "core/stopwatch.hpp"
#include "mesh/boundary.hpp"
#include "mesh/mesh_export.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/mesher.hpp"

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
  [surface.clamp]                 # surfaces by where they lie; filters combine
  plane = { normal = [1, 0, 0], height = 0.0 }

Any CAD file: kind = "cad" with [cad] source = "part.step"; surfaces by
cylinder = { radius, point, axis }, plane = { normal, height }, box = { min, max },
outside = { min, max }.

Examples:
  clatter-mesh block.mesh.toml -o block.mesh.h5 --write-step block.step
  clatter-mesh piston.mesh.toml -o piston.mesh.h5 --export piston.vtu --export piston.inp

See mesh/README.md for each kind's dimensions and surfaces. Next stage: clatter-assembly.)";

struct Arguments {
  std::filesystem::path input, output, step;
  std::vector<std::filesystem::path> exports;
};

void report(const PartMesh& result) {
  const auto& c = result.certificate;
  const Eigen::Vector3d worst = result.quality.min_dihedral_deg.place;
  say(fmt::format("mesh: {:.0f} cells, {:.0f} nodes, {:.0f} degrees of freedom", c.at("cells"),
                  c.at("nodes"), c.at("dofs")));
  for (size_t r = 0; r < result.mesh.regions.size(); ++r) {
    say(fmt::format("mesh: region {}: volume {:.6g} m3", result.mesh.regions[r],
                    cell_volume(result.mesh, static_cast<int32_t>(r))));
  }
  say(fmt::format("mesh: volume against CAD {:+.2e}, against the surface integral {:.1e}",
                  c.at("volume_against_cad"), c.at("volume_against_surface_integral")));
  say(fmt::format(
      "mesh: smallest dihedral angle {:.1f} deg at ({:.4f}, {:.4f}, {:.4f}) m, scaled "
      "Jacobian {:.3f}, radius ratio {:.3f}; folded cells before repair: {:.0f}, now 0",
      c.at("min_dihedral_deg"), worst.x(), worst.y(), worst.z(), c.at("min_scaled_jacobian"),
      c.at("min_radius_ratio"), c.at("invalid_cells_before_repair")));
}

int run(const Arguments& a, const CommonOptions& common) {
  StepClock clock;
  const Config config = Config::load(a.input);
  const std::string name = config.text("name");
  const LengthUnit unit = read_length_unit(config);
  const MeshSettings settings = read_mesh_settings(config);
  GmshSession session(name);
  const PartGeometry part = build_part(session, config);
  config.finish();
  clock.lap("geometry");
  if (!a.step.empty()) session.write_cad(a.step, unit.name);

  const PartMesh result = mesh_part(session, part, settings, unit.metres, name, a.input.string());
  clock.lap("mesh");
  report(result);

  Provenance provenance{kMeshSchema, config.resolved(), {a.input}};
  if (config.text("kind") == "cad") {
    provenance.inputs.push_back(config.table("cad").path("source"));
  }
  H5File file = H5File::create(a.output);
  write_mesh(file, result.mesh);
  write_quality(file, result.quality);
  write_provenance(file, provenance);
  write_certificate(file, result.certificate);
  write_timing(file, clock);
  file.commit();
  for (const auto& path : a.exports) export_mesh(result.mesh, path);
  write_depfile(common.depfile, a.output, provenance.inputs);
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
                     "Builds or imports a part's geometry, meshes it with quadratic "
                     "tetrahedra, proves the mesh and names its surfaces.",
                     kEpilog);
    line.positional("part", a.input, "description of the part (.mesh.toml)");
    line.option("-o,--output", a.output, "mesh file to write (.mesh.h5)", true);
    line.option("--write-step", a.step, "also write the geometry (.step or .brep)");
    line.option("--export", a.exports, "also write the mesh (.vtu, .inp or .msh); may be repeated");
    if (!line.parse(argc, argv)) return line.exit_code();
    return run(a, line.common());
  });
}
