// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-assembly: from a mesh to sparse mass and stiffness matrices.
#include <fmt/format.h>

#include <optional>

#include "assembly/import/matrix_import.hpp"
#include "assembly/model/build.hpp"
#include "core/base/artefact.hpp"
#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/plausible.hpp"
#include "core/mesh/mesh_file.hpp"

namespace {

constexpr const char* kSummary =
    "Assembles a part's mass and stiffness matrices, adds couplings, supports and contact patches, "
    "and builds unit load cases.";

constexpr const char* kEpilog = R"(Sample:
  clatter-assembly block.mesh.h5 -c block.fe.toml -o block.fe.h5

The smallest fe.toml has a material for each region of the mesh:
  [material.cast_iron]
  regions = ["block"]
  E_gpa = 110.0        # or E [Pa]
  nu = 0.26
  rho = 7200.0         # [kg/m3]

Further tables, any number of each:
  [damping]       ratio at at_hz, or alpha and beta:  D = alpha K + beta M
  [system.NAME]   rectangular, cylindrical or spherical axes for directions
  [[point]]       reference node with 6 DoFs of its own
  [[support]]     surface, node_set or point held at zero
  [[coupling]]    reference node that follows a surface (RBE3) or that nodes follow (RBE2)
  [[equation]]    linear relation of displacements
  [[tie]]         non-matching surfaces;  [[bolt]]  a cut shank with its tension
  [[contact]]     grid of patches on a cylinder surface, one radial DoF each
  [[mean]]        mean displacement of a surface along a direction
  [[sensor]]      node of a surface nearest to a point;  [[nodes]]  a node set
  [[point_mass]]  mass and inertia on a point, coupling, sensor or node set
  [[load]]        pressure, resultant, force, gravity, centrifugal, nodal field, prescribed displacement
  [[case]]        a sum of loads

Matrices that another program assembled, instead of all these tables:
  [matrices]
  K = "stiffness.mtx"  # Matrix Market, or lines "i j value" as Abaqus writes
  M = "mass.mtx"
  dofs = "dofs.tsv"    # meaning of each row (docs/formats.md); default: x y z of the mesh's nodes
  units = "mm-t-s"     # of K and M, default "m-kg-s"

assembly/README.md documents every key; samples/truck_diesel/block.fe.toml is a complete sample.
Next: clatter-modal block.fe.h5 (modes; --static for load cases),
 clatter-condense block.fe.h5 -c block.rom.toml -o block.rom.h5)";

void print_summary(const clatter::fe::FeModel& model, double seconds, bool json) {
  const clatter::rom::MassProperties& mass = model.mass;
  clatter::print_result(fmt::format("{}: {} DoFs, {} entries in K, {} sets, {} loads", model.name,
                                    model.size(), model.K.nonZeros(), model.sets.size(),
                                    model.loads.size()));
  clatter::print_result(fmt::format("mass {:.6g} kg, centre ({:.6g}, {:.6g}, {:.6g}) m", mass.mass,
                                    mass.centre(0), mass.centre(1), mass.centre(2)));
  const Eigen::Matrix3d& J = mass.inertia;
  clatter::print_result(
      fmt::format("inertia about it: xx {:.6g} yy {:.6g} zz {:.6g} xy {:.4g} yz {:.4g} zx "
                  "{:.4g} kg m2",
                  J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2), J(2, 0)));
  if (!json) return;
  clatter::print_json({{"name", clatter::json_text(model.name)},
                       {"dofs", fmt::format("{}", model.size())},
                       {"nonzeros_K", fmt::format("{}", model.K.nonZeros())},
                       {"mass_kg", clatter::json_number(mass.mass)},
                       {"seconds", clatter::json_number(seconds)}});
}

/// One warning for all materials and sizes that suggest a wrong unit.
void warn_of_units(const clatter::fe::FeModel& model, const std::filesystem::path& config) {
  using namespace clatter;
  std::vector<std::string> doubts;
  for (const fe::Material& material : model.cells.materials) {
    doubts.push_back(density_warning(material.density));
    if (!material.is_isotropic()) continue;
    doubts.push_back(modulus_warning(material.youngs, material.density));
    doubts.push_back(poisson_warning(material.poisson));
  }
  if (model.nodes.rows() > 1)
    doubts.push_back(length_warning(
        (model.nodes.colwise().maxCoeff() - model.nodes.colwise().minCoeff()).maxCoeff()));
  warn_implausible(config.string(), doubts);
}

/// Imports matrices of other programs or assembles on the mesh; adds the files read to `inputs`.
clatter::assembly::BuiltModel make_model(const std::filesystem::path& mesh_path,
                                         const clatter::Config& config,
                                         std::vector<std::filesystem::path>& inputs,
                                         clatter::StepClock& clock) {
  using namespace clatter;
  std::optional<mesh::Mesh> mesh;
  if (!mesh_path.empty()) {
    mesh = mesh::read_mesh(mesh_path);
    inputs.push_back(mesh_path);
  }
  if (const auto files = assembly::read_matrix_files(config)) {
    if (mesh.has_value() != files->dofs.empty())
      throw InputError(fmt::format("{}: [matrices]: found {}, expected one of the two",
                                   config.where(),
                                   mesh ? "a mesh and dofs" : "neither a mesh nor dofs"));
    inputs.insert(inputs.end(), {files->K, files->M});
    if (!files->dofs.empty()) inputs.push_back(files->dofs);
    assembly::BuiltModel built = assembly::import_matrices(*files, mesh ? &*mesh : nullptr);
    clock.lap("import");
    return built;
  }
  if (!mesh) throw InputError("command line: expected a mesh (.mesh.h5)");
  const assembly::Recipe recipe = assembly::read_recipe(config, *mesh);
  clock.lap("read");
  return assembly::build_fe_model(*mesh, recipe, clock);
}

int run(int argc, char** argv) {
  using namespace clatter;
  std::filesystem::path mesh_path, config_path, output_path;
  CommandLine line("clatter-assembly", kSummary, kEpilog);
  line.positional("mesh", mesh_path, "mesh of the part (.mesh.h5); none with [matrices] and dofs",
                  false);
  line.option("-c,--config", config_path, "materials, couplings, sets, loads (.fe.toml)", true);
  line.output("-o,--output", output_path, "the model to write (.fe.h5)", true);
  if (!line.parse(argc, argv)) return line.exit_code();

  StepClock clock;
  const Config config = Config::load(config_path);
  std::vector<std::filesystem::path> inputs;
  const assembly::BuiltModel built = make_model(mesh_path, config, inputs, clock);
  inputs.push_back(config_path);
  warn_of_units(built.model, config_path);
  print_summary(built.model, clock.total_seconds(), line.common().json);

  H5File file = H5File::create(output_path);
  write_provenance(file, {fe::kFeSchema, config.resolved(), inputs});
  fe::write_fe_model(file, built.model);
  write_certificate(file, built.certificate);
  clock.lap("write");
  write_timing(file, clock);
  file.commit();
  write_depfile(line.common().depfile, output_path, inputs);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return clatter::run_guarded("clatter-assembly", [&] { return run(argc, argv); });
}
