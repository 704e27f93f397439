// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/fe_model.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/fe/fe_checks.hpp"
#include "core/fe/fe_statics_file.hpp"
#include "core/mesh/mesh_file.hpp"

namespace clatter::fe {
namespace {

/// A symmetric positive semidefinite matrix has no negative diagonal entry; where one is zero, the
/// column is zero: a DoF without stiffness or without mass.
void check_lower(const H5File& file, const std::string& dataset, const SparseMatrix& matrix) {
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
    SparseMatrix::InnerIterator entry(matrix, j);
    if (!entry) continue;
    if (entry.row() != j)
      refuse(file, fmt::format("{}, column {}", dataset, j),
             "a column that does not start on the diagonal", "the lower triangle");
    const double diagonal = entry.value();
    bool alone = true;
    while (++entry) alone = alone && entry.value() == 0.0;
    if (!(diagonal > 0.0 || (diagonal == 0.0 && alone)))
      refuse(file, fmt::format("{}, column {}", dataset, j), fmt::format("diagonal {:g}", diagonal),
             "a positive number, or an empty column");
  }
}

/// A matrix of the stored shape without entries.
SparseMatrix shape_of_sparse(const H5File& file, const std::string& group) {
  const std::vector<int64_t> shape = file.get_ints(group, "shape");
  if (shape.size() != 2 || shape[0] < 0 || shape[1] < 0)
    refuse(file, group, fmt::format("a shape of {} numbers", shape.size()), "rows and columns");
  return {shape[0], shape[1]};
}

void check_matrices(const H5File& file, const FeModel& model) {
  const Eigen::Index n = model.K.rows();
  const Eigen::Index n_nodes = model.nodes.rows();
  check_shape(file, "K", model.K, n, n);
  check_shape(file, "M", model.M, n, n);
  if (model.loss.rows() > 0) check_shape(file, "loss", model.loss, n, n);
  check_shape(file, "T", model.T, 3 * n_nodes, n);
  check_shape(file, "nodes", model.nodes, n_nodes, 3);
  check_shape(file, "rigid", model.rigid, n, 6);
  check_finite(file, "nodes", model.nodes);
  check_finite(file, "rigid", model.rigid);
  check_lower(file, "K", model.K);
  check_lower(file, "M", model.M);
}

void read_loads(const H5File& file, FeModel& model) {
  for (const std::string& load : file.list("loads")) {
    const std::string dataset = "loads/" + load;
    Eigen::VectorXd values = file.read_vector(dataset);
    check_shape(file, dataset, values, model.K.rows(), 1);
    check_finite(file, dataset, values);
    model.loads[load] = std::move(values);
    model.load_units[load] = file.get_string(dataset, "unit");
  }
}

constexpr const char* kSheetOfParts = "sheet_of_parts";

void write_parts(H5File& file, const FeParts& parts) {
  for (const FePart& part : parts.list) {
    const std::string at = "parts/" + part.name;
    file.set(at, "certified", static_cast<int64_t>(part.certified ? 1 : 0));
    file.set(at, "valid_to_hz", part.valid_to_hz);
    file.set(at, "accurate_to_hz", part.accurate_to_hz);
    if (part.truncation.rows() > 0) write_sparse(file, at + "/truncation", part.truncation, true);
  }
  if (parts.sheet.rows() > 0) file.write(kSheetOfParts, parts.sheet);
}

FeParts read_parts(const H5File& file, Eigen::Index n, Eigen::Index n_nodes) {
  FeParts parts;
  if (file.has("parts") && file.has_attribute("parts", "count"))
    refuse(file, "parts", "reduced parts as an earlier version stored them",
           "a file that clatter-assembly makes again");
  for (const std::string& name : file.list("parts")) {
    const std::string at = "parts/" + name;
    FePart part{.name = name,
                .certified = file.get_int(at, "certified") != 0,
                .valid_to_hz = file.get_double(at, "valid_to_hz"),
                .accurate_to_hz = file.get_double(at, "accurate_to_hz")};
    if (const std::string matrix = at + "/truncation"; file.has(matrix)) {
      part.truncation = read_sparse(file, matrix);
      check_shape(file, matrix, part.truncation, n, n);
    }
    parts.list.push_back(std::move(part));
  }
  if (file.has(kSheetOfParts)) parts.sheet = file.read_index_matrix(kSheetOfParts);
  if (parts.sheet.size() > 0 &&
      (parts.sheet.cols() != 6 || parts.sheet.minCoeff() < 0 || parts.sheet.maxCoeff() >= n_nodes))
    refuse(file, kSheetOfParts, "faces of other nodes", "quadratic triangles of the model's");
  return parts;
}

double least(const FeParts& parts, double FePart::*value) {
  double least = std::numeric_limits<double>::infinity();
  for (const FePart& part : parts.list) least = std::min(least, part.*value);
  return least;
}

}  // namespace

bool FeParts::certified() const { return std::ranges::all_of(list, &FePart::certified); }
double FeParts::valid_to_hz() const { return least(*this, &FePart::valid_to_hz); }
double FeParts::accurate_to_hz() const { return least(*this, &FePart::accurate_to_hz); }

const rom::DofSet& FeModel::set(const std::string& set_name) const {
  const auto found = sets.find(set_name);
  if (found != sets.end()) return found->second;
  std::vector<std::string> present;
  for (const auto& [key, value] : sets) present.push_back(key);
  throw InputError(fmt::format(
      "{}: set: found \"{}\", expected one of: {}; [[nodes]], [[sensor]], [[point]] or "
      "[[coupling]] "
      "in the fe.toml makes one, [[nodes]] of a node set of the mesh",
      name, set_name, present.empty() ? "none" : fmt::format("{}", fmt::join(present, ", "))));
}

void require_unknowns(const FeModel& model, const std::string& what) {
  if (model.size() > 0) return;
  throw InputError(
      fmt::format("{}: found all {} DoFs supported ({}), expected free DoFs for {}; "
                  "clatter-modal statics gives their reactions",
                  model.name, model.supports.size(), fmt::join(model.supports.names, ", "), what));
}

void write_fe_model(H5File& file, const FeModel& model) {
  file.set("/", "name", model.name);
  write_sparse(file, "M", model.M, true);
  write_sparse(file, "K", model.K, true);
  if (model.loss.rows() > 0) write_sparse(file, "loss", model.loss, true);
  write_sparse(file, "T", model.T, false);
  file.write("nodes", model.nodes);
  file.write("rigid", model.rigid);
  file.set("damping", "alpha", model.alpha);
  file.set("damping", "beta", model.beta);
  rom::write_dof_sets(file, model.sets, model.grids);
  for (const auto& [load, values] : model.loads) {
    file.write("loads/" + load, values);
    const auto unit = model.load_units.find(load);
    file.set("loads/" + load, "unit", unit == model.load_units.end() ? "1" : unit->second);
  }
  mesh::write_surfaces(file, model.surfaces);
  rom::write_mass_properties(file, model.mass);
  write_statics(file, model);
  write_cells(file, model.cells);
  write_parts(file, model.parts);
  write_deck_origin(file, model.deck);
}

FeModel read_fe_model(const std::filesystem::path& path, FeMatrices matrices) {
  const H5File file = open_artefact(path, kFeSchema);
  FeModel model;
  model.name = file.get_string("/", "name");
  const bool complete = matrices == FeMatrices::kRead;
  model.M = complete ? read_sparse(file, "M") : shape_of_sparse(file, "M");
  model.K = complete ? read_sparse(file, "K") : shape_of_sparse(file, "K");
  if (file.has("loss")) model.loss = read_sparse(file, "loss");
  model.T = read_sparse(file, "T");
  model.nodes = file.read_rows("nodes");
  model.rigid = file.read_matrix("rigid");
  check_matrices(file, model);
  model.alpha = file.get_double("damping", "alpha");
  model.beta = file.get_double("damping", "beta");
  if (!(std::isfinite(model.alpha) && model.alpha >= 0.0 && std::isfinite(model.beta) &&
        model.beta >= 0.0))
    refuse(file, "damping", fmt::format("alpha {:g}, beta {:g}", model.alpha, model.beta),
           "numbers not below zero");
  rom::read_dof_sets(file, model.size(), model.sets, model.grids);
  read_loads(file, model);
  model.surfaces = mesh::read_surfaces(file, model.nodes.rows(), path.string());
  model.mass = rom::read_mass_properties(file);
  read_statics(file, model);
  if (model.size() == 0 && model.supports.size() == 0) refuse(file, "K", "no DoF", "at least one");
  model.cells = read_cells(file, model.nodes);
  model.parts = read_parts(file, model.size(), model.nodes.rows());
  model.deck = read_deck_origin(file);
  return model;
}

}  // namespace clatter::fe
