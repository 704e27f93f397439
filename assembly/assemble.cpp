// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/assemble.hpp"

#include <fmt/format.h>

#include <optional>

#include "assembly/import/matrix_import.hpp"
#include "core/base/config.hpp"
#include "core/base/error.hpp"
#include "core/base/plausible.hpp"
#include "core/mesh/mesh_file.hpp"

namespace clatter::assembly {
namespace {

/// One warning for all materials and sizes that suggest a wrong unit.
void warn_of_units(const fe::FeModel& model, const std::string& config) {
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
  warn_implausible(config, doubts);
}

/// "engine" of engine.fe.toml.
std::string name_of(const std::filesystem::path& config) {
  const std::string file = config.filename().string();
  return file.substr(0, file.find('.'));
}

/// Imports matrices of other programs or assembles on the mesh and reduced parts; adds the files
/// read to `inputs`.
BuiltModel make_model(const std::filesystem::path& mesh_path,
                      const std::filesystem::path& config_path, const Config& config,
                      std::vector<std::filesystem::path>& inputs, StepClock& clock) {
  std::optional<mesh::Mesh> mesh;
  if (!mesh_path.empty()) {
    mesh = mesh::read_mesh(mesh_path);
    inputs.push_back(mesh_path);
  }
  if (const auto table = config.find_table("matrices")) {
    const MatrixFiles files = recipe::matrix_files_keys().read(*table);
    config.finish();
    if (mesh.has_value() != files.dofs.empty())
      throw InputError(fmt::format("{}: [matrices]: {}", config.where(),
                                   mesh ? "a mesh and dofs exclude each other: both name the rows"
                                        : "needs a mesh or dofs, which name the rows"));
    inputs.insert(inputs.end(), {files.K, files.M});
    if (!files.dofs.empty()) inputs.push_back(files.dofs);
    BuiltModel built = import_matrices(files, mesh ? &*mesh : nullptr);
    clock.lap("import");
    return built;
  }
  if (!mesh && !config.has("part"))
    throw InputError(
        "command line: expected a mesh (.mesh.h5), or [[part]] tables with reduced parts");
  if (!mesh) {
    mesh.emplace();
    mesh->name = name_of(config_path);
    mesh->nodes.resize(0, 3);
  }
  const Recipe recipe = read_recipe(config, *mesh);
  inputs.insert(inputs.end(), recipe.files.begin(), recipe.files.end());
  clock.lap("read");
  return build_fe_model(*mesh, recipe, clock);
}

}  // namespace

AssembledPart assemble(const std::filesystem::path& mesh_path,
                       const std::filesystem::path& config_path, StepClock& clock) {
  const Config config = Config::load(config_path);
  AssembledPart part;
  part.built = make_model(mesh_path, config_path, config, part.provenance.inputs, clock);
  part.provenance.inputs.push_back(config_path);
  part.provenance.schema = fe::kFeSchema;
  part.provenance.config = config.resolved();
  warn_of_units(part.built.model, config_path.string());
  return part;
}

std::vector<std::string> describe(const fe::FeModel& model) {
  const rom::MassProperties& mass = model.mass;
  const Eigen::Matrix3d& J = mass.inertia;
  return {fmt::format("{}: {} DoFs, {} entries in K, {} sets, {} loads", model.name, model.size(),
                      model.K.nonZeros(), model.sets.size(), model.loads.size()),
          fmt::format("mass {:.6g} kg, centre ({:.6g}, {:.6g}, {:.6g}) m", mass.mass,
                      mass.centre(0), mass.centre(1), mass.centre(2)),
          fmt::format("inertia about it: xx {:.6g} yy {:.6g} zz {:.6g} xy {:.4g} yz {:.4g} zx "
                      "{:.4g} kg m2",
                      J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2), J(2, 0))};
}

JsonMembers json_of(const fe::FeModel& model) {
  return {{"name", json_text(model.name)},
          {"dofs", fmt::format("{}", model.size())},
          {"nonzeros_K", fmt::format("{}", model.K.nonZeros())},
          {"mass_kg", json_number(model.mass.mass)}};
}

}  // namespace clatter::assembly
