// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/fe_statics_file.hpp"

#include <fmt/format.h>

#include "core/fe/fe_checks.hpp"

namespace clatter::fe {
namespace {

template <typename Matrix>
void check_dense(const H5File& file, const std::string& dataset, const Matrix& matrix,
                 Eigen::Index rows, Eigen::Index cols) {
  check_shape(file, dataset, matrix, rows, cols);
  check_finite(file, dataset, matrix);
}

void write_supports(H5File& file, const FeSupports& supports) {
  if (supports.names.empty()) return;
  write_supported(file, supports);
  file.write("supports/rigid", supports.rigid);
  write_sparse(file, "supports/T_s", supports.T, false);
  write_sparse(file, "supports/K_sq", supports.K_sq, false);
  write_sparse(file, "supports/K_ss", supports.K_ss, true);
  write_sparse(file, "supports/M_sq", supports.M_sq, false);
}

void read_supports(const H5File& file, FeModel& model) {
  FeSupports& supports = model.supports;
  const Eigen::Index nodal = 3 * model.nodes.rows();
  supports.set.kind = "support";
  if (!file.has("supports")) {
    supports.T.resize(nodal, 0);
    supports.K_sq.resize(0, model.size());
    supports.M_sq.resize(0, model.size());
    supports.rigid.resize(0, 6);
    return;
  }
  supports.names = file.read_strings("supports/names");
  supports.support = file.read_ints("supports/support");
  const Eigen::Index n = supports.size();
  for (const int32_t s : supports.support)
    if (s < 0 || static_cast<size_t>(s) >= supports.names.size())
      refuse(file, "supports/support", fmt::format("{}", s),
             fmt::format("0 to {}", supports.names.size() - 1));
  supports.set.labels = file.read_strings("supports/labels");
  supports.set.is_rotation = file.read_ints("supports/is_rotation");
  const auto count = static_cast<size_t>(n);
  if (supports.set.labels.size() != count || supports.set.is_rotation.size() != count)
    refuse(file, "supports/labels", fmt::format("{} entries", supports.set.labels.size()),
           fmt::format("{}", n));
  for (Eigen::Index k = 0; k < n; ++k) supports.set.dofs.push_back(static_cast<int32_t>(k));
  supports.set.position = file.read_matrix("supports/position");
  supports.set.direction = file.read_matrix("supports/direction");
  supports.rigid = file.read_matrix("supports/rigid");
  check_dense(file, "supports/position", supports.set.position, n, 3);
  check_dense(file, "supports/direction", supports.set.direction, n, 3);
  check_dense(file, "supports/rigid", supports.rigid, n, 6);
  supports.T = read_sparse(file, "supports/T_s");
  supports.K_sq = read_sparse(file, "supports/K_sq");
  supports.K_ss = read_sparse(file, "supports/K_ss");
  supports.M_sq.resize(n, model.size());
  if (file.has("supports/M_sq")) supports.M_sq = read_sparse(file, "supports/M_sq");
  check_shape(file, "supports/T_s", supports.T, nodal, n);
  check_shape(file, "supports/K_sq", supports.K_sq, n, model.size());
  check_shape(file, "supports/K_ss", supports.K_ss, n, n);
  check_shape(file, "supports/M_sq", supports.M_sq, n, model.size());
}

void read_points(const H5File& file, FeModel& model) {
  FePoints& points = model.points;
  if (file.has("points")) {
    points.names = file.read_strings("points/names");
    points.position = file.read_rows("points/position");
    points.T = read_sparse(file, "points/T");
    points.T_s = read_sparse(file, "points/T_s");
  } else {
    points.position.resize(0, 3);
    points.T.resize(0, model.size());
    points.T_s.resize(0, model.supports.size());
  }
  const auto n = static_cast<Eigen::Index>(points.names.size());
  check_dense(file, "points/position", points.position, n, 3);
  check_shape(file, "points/T", points.T, 6 * n, model.size());
  check_shape(file, "points/T_s", points.T_s, 6 * n, model.supports.size());
}

void read_rotations(const H5File& file, FeModel& model) {
  FeRotations& rotations = model.rotations;
  rotations.T.resize(0, model.size());
  rotations.T_s.resize(0, model.supports.size());
  if (!file.has("rotations")) return;
  rotations.nodes = file.read_ints("rotations/nodes");
  for (const int32_t node : rotations.nodes)
    if (node < 0 || node >= model.nodes.rows())
      refuse(file, "rotations/nodes", fmt::format("{}", node),
             fmt::format("0 to {}", model.nodes.rows() - 1));
  rotations.T = read_sparse(file, "rotations/T");
  rotations.T_s = read_sparse(file, "rotations/T_s");
  const auto n = static_cast<Eigen::Index>(rotations.nodes.size());
  check_shape(file, "rotations/T", rotations.T, 3 * n, model.size());
  check_shape(file, "rotations/T_s", rotations.T_s, 3 * n, model.supports.size());
}

/// Optional data of loads in addition to forces.
void read_of_loads(const H5File& file, const std::string& group, const FeModel& model,
                   Eigen::Index size, std::map<std::string, Eigen::VectorXd>& out) {
  for (const std::string& load : file.list(group)) {
    const std::string dataset = group + "/" + load;
    if (!model.loads.contains(load))
      refuse(file, dataset, "no load of that name", "a load of the model");
    out[load] = file.read_vector(dataset);
    check_dense(file, dataset, out[load], size, 1);
  }
}

void write_heat(H5File& file, const FeModel& model) {
  for (const auto& [name, field] : model.heat) {
    const std::string group = "heat/" + name;
    file.write(group + "/temperature", field.temperature);
    file.write(group + "/boundaries", field.boundaries);
    file.write(group + "/heat", field.heat);
    file.set(group, "balance", field.balance);
  }
}

void read_heat(const H5File& file, FeModel& model) {
  for (const std::string& name : file.list("heat")) {
    const std::string group = "heat/" + name;
    HeatField& field = model.heat[name];
    field.temperature = file.read_vector(group + "/temperature");
    check_dense(file, group + "/temperature", field.temperature, model.nodes.rows(), 1);
    field.boundaries = file.read_strings(group + "/boundaries");
    field.heat = file.read_vector(group + "/heat");
    check_dense(file, group + "/heat", field.heat,
                static_cast<Eigen::Index>(field.boundaries.size()), 1);
    field.balance = file.get_double(group, "balance");
  }
}

}  // namespace

void write_supported(H5File& file, const FeSupports& supports) {
  file.write("supports/names", supports.names);
  file.write("supports/support", supports.support);
  file.write("supports/labels", supports.set.labels);
  file.write("supports/position", supports.set.position);
  file.write("supports/direction", supports.set.direction);
  file.write("supports/is_rotation", supports.set.is_rotation);
}

void write_statics(H5File& file, const FeModel& model) {
  write_supports(file, model.supports);
  if (!model.points.names.empty()) {
    file.write("points/names", model.points.names);
    file.write("points/position", model.points.position);
    write_sparse(file, "points/T", model.points.T, false);
    write_sparse(file, "points/T_s", model.points.T_s, false);
  }
  if (!model.rotations.nodes.empty()) {
    file.write("rotations/nodes", model.rotations.nodes);
    write_sparse(file, "rotations/T", model.rotations.T, false);
    write_sparse(file, "rotations/T_s", model.rotations.T_s, false);
  }
  for (const auto& [load, values] : model.support_loads)
    file.write("support_loads/" + load, values);
  for (const auto& [load, values] : model.prescribed) file.write("prescribed/" + load, values);
  for (const auto& [load, values] : model.temperature_rise)
    file.write("temperature_rise/" + load, values);
  write_heat(file, model);
  write_gaskets(file, model.gaskets);
  for (const auto& [name, factors] : model.cases)
    for (const auto& [load, factor] : factors) file.set("cases/" + name, load, factor);
}

void read_statics(const H5File& file, FeModel& model) {
  read_supports(file, model);
  read_points(file, model);
  read_rotations(file, model);
  read_of_loads(file, "support_loads", model, model.supports.size(), model.support_loads);
  read_of_loads(file, "prescribed", model, model.supports.size(), model.prescribed);
  read_of_loads(file, "temperature_rise", model, model.nodes.rows(), model.temperature_rise);
  read_heat(file, model);
  model.gaskets = read_gaskets(file, model.size(), model.supports.size());
  for (const std::string& name : file.list("cases"))
    for (const std::string& load : file.attributes("cases/" + name)) {
      const std::string group = "cases/" + name;
      if (!model.loads.contains(load))
        refuse(file, group, fmt::format("load \"{}\"", load), "a load of the model");
      model.cases[name][load] = file.get_double(group, load);
    }
}

}  // namespace clatter::fe
