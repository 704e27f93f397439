// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/reduced_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/named.hpp"

namespace clatter::rom {
namespace {

const std::string kUnits = "SI: m kg s N rad";

/// Reads a matrix; refuses an unexpected shape or values that are not finite.
void check(const H5File& file, const std::string& name, const Eigen::MatrixXd& matrix,
           Eigen::Index rows, Eigen::Index columns) {
  if (matrix.rows() != rows || matrix.cols() != columns) {
    throw InputError(fmt::format("{}: {}: found {} x {}, expected {} x {}", file.path().string(),
                                 name, matrix.rows(), matrix.cols(), rows, columns));
  }
  if (!matrix.allFinite()) {
    throw InputError(
        fmt::format("{}: {}: found a value that is not finite", file.path().string(), name));
  }
}

Eigen::MatrixXd read_checked(const H5File& file, const std::string& name, Eigen::Index rows,
                             Eigen::Index columns) {
  Eigen::MatrixXd matrix = file.read_matrix(name);
  check(file, name, matrix, rows, columns);
  return matrix;
}

Eigen::MatrixXd read_symmetric(const H5File& file, const std::string& name, Eigen::Index size) {
  Eigen::MatrixXd matrix = read_checked(file, name, size, size);
  const double skew = (matrix - matrix.transpose()).cwiseAbs().maxCoeff();
  // We write exactly symmetric matrices; files of other programs may have rounding errors.
  if (skew > 1e-9 * matrix.cwiseAbs().maxCoeff()) {
    throw InputError(fmt::format("{}: {}: not symmetric, largest difference {:.3g}",
                                 file.path().string(), name, skew));
  }
  return matrix;
}

void write_grid(H5File& file, const std::string& at, const ContactGrid& grid) {
  file.write(at + "/axis_point", Eigen::VectorXd(grid.axis_point));
  file.write(at + "/axis", Eigen::VectorXd(grid.axis));
  file.write(at + "/zero_angle", Eigen::VectorXd(grid.zero_angle));
  file.write(at + "/angle", grid.angle);
  file.write(at + "/axial", grid.axial);
  file.write(at + "/angle_edges", grid.angle_edges);
  file.write(at + "/axial_edges", grid.axial_edges);
  file.set(at, "radius", grid.radius);
}

Eigen::VectorXd read_sized(const H5File& file, const std::string& name, Eigen::Index size) {
  Eigen::VectorXd values = file.read_vector(name);
  check(file, name, values, size, 1);
  return values;
}

ContactGrid read_grid(const H5File& file, const std::string& at) {
  ContactGrid grid;
  grid.axis_point = read_sized(file, at + "/axis_point", 3);
  grid.axis = read_sized(file, at + "/axis", 3);
  grid.zero_angle = read_sized(file, at + "/zero_angle", 3);
  grid.angle = file.read_vector(at + "/angle");
  grid.axial = file.read_vector(at + "/axial");
  grid.angle_edges = read_sized(file, at + "/angle_edges", 2 * grid.angle.size());
  grid.axial_edges = read_sized(file, at + "/axial_edges", grid.axial.size() + 1);
  grid.radius = file.get_double(at, "radius");
  return grid;
}

DofSet read_dof_set(const H5File& file, const std::string& at, int n_dofs) {
  DofSet set;
  set.kind = file.get_string(at, "kind");
  set.dofs = file.read_ints(at + "/dofs");
  set.labels = file.read_strings(at + "/labels");
  const auto count = static_cast<Eigen::Index>(set.dofs.size());
  set.position = read_checked(file, at + "/position", count, 3);
  set.direction = read_checked(file, at + "/direction", count, 3);
  set.is_rotation = file.read_ints(at + "/is_rotation");
  if (file.has(at + "/node_ids")) set.node_ids = file.read_ints(at + "/node_ids");
  if (!set.node_ids.empty() && set.node_ids.size() != set.dofs.size())
    throw InputError(fmt::format("{}: {}/node_ids: found {} for {} degrees of freedom",
                                 file.path().string(), at, set.node_ids.size(), set.dofs.size()));
  if (file.has(at + "/components")) set.components = file.read_ints(at + "/components");
  if (!set.components.empty() && set.components.size() != set.dofs.size())
    throw InputError(fmt::format("{}: {}/components: found {} for {} degrees of freedom",
                                 file.path().string(), at, set.components.size(), set.dofs.size()));
  set.sheet = file.has_attribute(at, "sheet") && file.get_int(at, "sheet") != 0;
  const auto nodes = static_cast<int32_t>(nodes_of_set(set).size());
  for (const std::string& type : file.list(at + "/faces")) {
    IndexMatrix faces = file.read_index_matrix(at + "/faces/" + type);
    if (faces.size() > 0 && (faces.minCoeff() < 0 || faces.maxCoeff() >= nodes))
      throw InputError(fmt::format("{}: {}/faces/{}: found node {} of {}", file.path().string(), at,
                                   type, faces.maxCoeff(), nodes));
    set.faces[type] = std::move(faces);
  }
  for (const int32_t component : set.components)
    if (component < 0 || component > 6)
      throw InputError(fmt::format("{}: {}/components: found {}, expected 0 to 6",
                                   file.path().string(), at, component));
  if (set.labels.size() != set.dofs.size() || set.is_rotation.size() != set.dofs.size()) {
    throw InputError(fmt::format("{}: {}: found {} labels for {} degrees of freedom",
                                 file.path().string(), at, set.labels.size(), set.dofs.size()));
  }
  for (const int32_t dof : set.dofs) {
    if (dof < 0 || dof >= n_dofs) {
      throw InputError(fmt::format("{}: {}/dofs: found {}, expected 0 to {}", file.path().string(),
                                   at, dof, n_dofs - 1));
    }
  }
  return set;
}

void write_skin(H5File& file, const Skin& skin) {
  file.write("skin/nodes", skin.nodes);
  file.write("skin/triangles", skin.triangles);
  file.write("skin/T", skin.T);
  file.write("skin/surfaces", skin.surfaces);
  for (const auto& [name, faces] : skin.faces) file.write("skin/faces/" + name, faces);
  if (!skin.sheet.empty()) file.write("skin/sheet", skin.sheet);
}

[[noreturn]] void refuse_skin(const H5File& file, const std::string& what) {
  throw InputError(fmt::format("{}: skin: {}", file.path().string(), what));
}

std::vector<int32_t> read_faces(const H5File& file, const std::string& name, Eigen::Index count) {
  std::vector<int32_t> faces = file.read_ints(name);
  for (size_t k = 0; k < faces.size(); ++k)
    if (faces[k] < 0 || faces[k] >= count || (k > 0 && faces[k] <= faces[k - 1]))
      throw InputError(
          fmt::format("{}: {}: found triangle {} at {}, expected ascending numbers below {}",
                      file.path().string(), name, faces[k], k, count));
  return faces;
}

/// All of the skin but T, whose shape alone is checked.
Skin read_geometry(const H5File& file, Eigen::Index size) {
  Skin skin;
  skin.nodes = file.read_rows("skin/nodes");
  skin.triangles = file.read_index_matrix("skin/triangles");
  if (file.has("skin/surfaces")) skin.surfaces = file.read_strings("skin/surfaces");
  for (const std::string& name : file.list("skin/faces"))
    skin.faces[name] = read_faces(file, "skin/faces/" + name, skin.triangles.rows());
  if (file.has("skin/sheet")) skin.sheet = read_faces(file, "skin/sheet", skin.triangles.rows());
  if (skin.nodes.cols() != 3 || skin.triangles.cols() != 6) {
    refuse_skin(file, fmt::format("found {} coordinates and {} nodes a triangle, expected 3 and 6",
                                  skin.nodes.cols(), skin.triangles.cols()));
  }
  if (const auto shape = file.shape("skin/T");
      shape.size() != 2 || shape[0] != 3 * skin.nodes.rows() || shape[1] != size) {
    refuse_skin(file, fmt::format("T is {}, expected {} x {}", fmt::join(shape, " x "),
                                  3 * skin.nodes.rows(), size));
  }
  if (skin.triangles.size() > 0 &&
      (skin.triangles.minCoeff() < 0 || skin.triangles.maxCoeff() >= skin.nodes.rows())) {
    refuse_skin(file, fmt::format("a triangle refers to node {}, but there are {} nodes",
                                  skin.triangles.maxCoeff(), skin.nodes.rows()));
  }
  if (!skin.nodes.allFinite()) refuse_skin(file, "found a value that is not finite");
  return skin;
}

Skin read_skin(const H5File& file, Eigen::Index size) {
  Skin skin = read_geometry(file, size);
  skin.T = file.read_rows("skin/T");
  if (!skin.T.allFinite()) refuse_skin(file, "found a value that is not finite");
  return skin;
}

}  // namespace

std::vector<int32_t> nodes_of_set(const DofSet& set) {
  std::vector<int32_t> first;
  for (Eigen::Index k = 0; k < set.position.rows(); ++k)
    if (k == 0 || set.position.row(k) != set.position.row(k - 1))
      first.push_back(static_cast<int32_t>(k));
  return first;
}

const DofSet& ReducedModel::set(const std::string& set_name) const {
  return find_named(sets, name, "set", set_name);
}

const ContactGrid& ReducedModel::grid(const std::string& grid_name) const {
  return find_named(grids, name, "contact grid", grid_name);
}

Eigen::VectorXd ReducedModel::damping_rates(const Eigen::VectorXd& omega_squared,
                                            const Eigen::MatrixXd& modes) const {
  Eigen::VectorXd rates = alpha * omega_squared.array() + beta;
  rates += modal_damping.rates(omega_squared);
  if (loss.rows() == 0) return rates;
  const Eigen::VectorXd energy = modes.cwiseProduct(loss * modes).colwise().sum();
  for (Eigen::Index k = 0; k < rates.size(); ++k)
    if (omega_squared[k] > 0.0) rates[k] += std::max(0.0, energy[k]) / std::sqrt(omega_squared[k]);
  return rates;
}

Eigen::RowVectorXd ReducedModel::row_of(int dof) const {
  if (dof >= size()) return combined.row(dof - size());
  return Eigen::RowVectorXd::Unit(size(), dof);
}

void write_dof_sets(H5File& file, const std::map<std::string, DofSet>& sets,
                    const std::map<std::string, ContactGrid>& grids) {
  for (const auto& [name, set] : sets) {
    const std::string at = "sets/" + name;
    file.write(at + "/dofs", set.dofs);
    file.write(at + "/labels", set.labels);
    file.write(at + "/position", set.position);
    file.write(at + "/direction", set.direction);
    file.write(at + "/is_rotation", set.is_rotation);
    file.set(at, "kind", set.kind);
    if (!set.node_ids.empty()) file.write(at + "/node_ids", set.node_ids);
    if (!set.components.empty()) file.write(at + "/components", set.components);
    for (const auto& [type, faces] : set.faces) file.write(at + "/faces/" + type, faces);
    if (set.sheet) file.set(at, "sheet", int64_t{1});
  }
  for (const auto& [name, grid] : grids) write_grid(file, "grids/" + name, grid);
}

void read_dof_sets(const H5File& file, int n_dofs, std::map<std::string, DofSet>& sets,
                   std::map<std::string, ContactGrid>& grids) {
  for (const auto& name : file.list("sets")) {
    sets[name] = read_dof_set(file, "sets/" + name, n_dofs);
  }
  for (const auto& name : file.list("grids")) {
    const ContactGrid grid = read_grid(file, "grids/" + name);
    const auto patches = static_cast<size_t>(grid.angle.size() * grid.axial.size());
    const auto at = sets.find(name);
    if (at == sets.end() || at->second.dofs.size() != patches) {
      throw InputError(fmt::format("{}: grids/{}: found {} patches, expected a set with as many",
                                   file.path().string(), name, patches));
    }
    grids[name] = grid;
  }
}

void write_mass_properties(H5File& file, const MassProperties& mass) {
  file.write("mass/centre", Eigen::VectorXd(mass.centre));
  file.write("mass/inertia", Eigen::MatrixXd(mass.inertia));
  file.set("mass", "mass", mass.mass);
}

MassProperties read_mass_properties(const H5File& file) {
  MassProperties mass;
  mass.mass = file.get_double("mass", "mass");
  mass.centre = read_sized(file, "mass/centre", 3);
  mass.inertia = read_checked(file, "mass/inertia", 3, 3);
  return mass;
}

void write_reduced_model(H5File& file, const ReducedModel& model) {
  file.set("/", "name", model.name);
  file.set("/", "method", model.method);
  file.set("/", "n_boundary", model.n_boundary);
  file.set("/", "alpha", model.alpha);
  file.set("/", "beta", model.beta);
  file.set("/", "valid_to_hz", model.valid_to_hz);
  file.set("/", "units", kUnits);
  write_damping_table(file, model.modal_damping);
  file.write("M_rr", model.M_rr);
  file.write("K_rr", model.K_rr);
  if (model.loss.rows() > 0) file.write("loss", model.loss);
  if (model.truncation.rows() > 0) file.write("truncation", model.truncation);
  file.write("rigid", model.rigid);
  if (model.inertia_force.rows() > 0) file.write("inertia_force", model.inertia_force);
  file.write("fixed_interface_hz", model.fixed_interface_hz);
  for (const auto& [name, load] : model.loads) file.write("loads/" + name, load);
  write_dof_sets(file, model.sets, model.grids);
  write_mass_properties(file, model.mass);
  write_inertia_invariants(file, model.inertia);
  if (model.combined.rows() > 0) file.write("combined", model.combined);
  if (!model.recovered_sets.empty()) file.write("recovered_sets", model.recovered_sets);
  write_elimination_order(file, model.elimination);
  if (model.skin.nodes.rows() > 0) write_skin(file, model.skin);
  write_certificate(file, model.certificate);
  write_deck_origin(file, model.deck);
}

ReducedModel read_reduced_model(const std::filesystem::path& path, bool with_skin) {
  const H5File file = open_artefact(path, kRomSchema);
  ReducedModel model;
  model.name = file.get_string("/", "name");
  model.method = file.get_string("/", "method");
  model.n_boundary = static_cast<int>(file.get_int("/", "n_boundary"));
  model.alpha = file.get_double("/", "alpha");
  model.beta = file.get_double("/", "beta");
  model.valid_to_hz = file.get_double("/", "valid_to_hz");
  model.modal_damping = read_damping_table(file);
  const auto size = file.shape("M_rr").at(0);
  model.M_rr = read_symmetric(file, "M_rr", size);
  model.K_rr = read_symmetric(file, "K_rr", size);
  if (file.has("loss")) model.loss = read_symmetric(file, "loss", size);
  if (file.has("truncation")) model.truncation = read_symmetric(file, "truncation", size);
  model.rigid = read_checked(file, "rigid", size, 6);
  if (file.has("inertia_force")) model.inertia_force = read_checked(file, "inertia_force", size, 6);
  model.fixed_interface_hz = file.read_vector("fixed_interface_hz");
  for (const auto& name : file.list("loads")) {
    model.loads[name] = read_sized(file, "loads/" + name, size);
  }
  model.combined.resize(0, static_cast<Eigen::Index>(size));
  if (file.has("combined"))
    model.combined = read_checked(file, "combined", file.shape("combined").at(0), size);
  if (file.has("recovered_sets")) model.recovered_sets = file.read_strings("recovered_sets");
  read_dof_sets(file, model.dof_count(), model.sets, model.grids);
  model.inertia = read_inertia_invariants(file, model.M_rr);
  model.mass = read_mass_properties(file);
  if (with_skin && file.has("skin")) model.skin = read_skin(file, size);
  model.certificate = read_certificate<ReducedCertificate>(file);
  model.deck = read_deck_origin(file);
  if (model.n_boundary < 0 || model.n_boundary > size) {
    throw InputError(fmt::format("{}: n_boundary: found {}, expected 0 to {}", path.string(),
                                 model.n_boundary, size));
  }
  return model;
}

Skin read_skin_geometry(const std::filesystem::path& path) {
  const H5File file = open_artefact(path, kRomSchema);
  return file.has("skin") ? read_geometry(file, file.shape("M_rr").at(0)) : Skin{};
}

}  // namespace clatter::rom
