// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/skin/sensors.hpp"

#include <fmt/format.h>

#include <set>

#include "core/base/error.hpp"
#include "core/base/near_position.hpp"

namespace clatter::recover {
namespace {

Sensor from_set(const std::string& name, const rom::DofSet& set, const rom::ReducedModel& model) {
  const Eigen::Index channels = static_cast<Eigen::Index>(set.dofs.size());
  Sensor sensor{name, set.kind, set.labels, set.position, set.direction, set.is_rotation, {}};
  sensor.rows = Eigen::MatrixXd::Zero(channels, model.size());
  for (Eigen::Index c = 0; c < channels; ++c) sensor.rows.row(c) = model.row_of(set.dofs[c]);
  return sensor;
}

Sensor from_point(const SensorRule& rule, const rom::Skin& skin, const rom::SkinRows& T,
                  const SkinGeometry& geometry) {
  Eigen::Index node;
  (skin.nodes.rowwise() - rule.position->transpose()).rowwise().squaredNorm().minCoeff(&node);
  require_near(fmt::format("sensor '{}': the nearest node of the skin", rule.name), *rule.position,
               skin.nodes.row(node).transpose(),
               size_around(skin.nodes, skin.triangles, static_cast<int32_t>(node)), "metres");
  std::vector<Eigen::Vector3d> directions;
  Sensor sensor{.name = rule.name, .kind = "skin"};
  if (rule.direction) {
    directions = {rule.direction->normalized()};
    sensor.labels = {rule.name};
  } else {
    directions = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ(),
                  geometry.node_normal.row(node).transpose()};
    for (const char* axis : {"x", "y", "z", "normal"})
      sensor.labels.push_back(rule.name + "." + axis);
  }
  const Eigen::Index channels = static_cast<Eigen::Index>(directions.size());
  const RowMatrix rows = T.of_nodes({static_cast<int32_t>(node)});
  sensor.position = skin.nodes.row(node).replicate(channels, 1);
  sensor.direction.resize(channels, 3);
  sensor.rows.resize(channels, T.cols());
  sensor.is_rotation.assign(directions.size(), 0);
  for (Eigen::Index c = 0; c < channels; ++c) {
    const Eigen::Vector3d& direction = directions[c];
    sensor.direction.row(c) = direction;
    sensor.rows.row(c) = direction.transpose() * rows;
  }
  return sensor;
}

}  // namespace

std::vector<Sensor> find_sensors(const std::vector<SensorRule>& rules,
                                 const rom::ReducedModel& model, const rom::SkinRows& T,
                                 const SkinGeometry& geometry) {
  std::vector<Sensor> sensors;
  if (rules.empty())
    for (const auto& [name, set] : model.sets)
      if (set.kind == "sensor") sensors.push_back(from_set(name, set, model));
  std::set<std::string> names;
  for (const SensorRule& rule : rules) {
    if (!names.insert(rule.name).second)
      throw InputError(
          fmt::format("sensor '{}': found twice, expected different names", rule.name));
    sensors.push_back(rule.set.empty() ? from_point(rule, model.skin, T, geometry)
                                       : from_set(rule.name, model.set(rule.set), model));
  }
  return sensors;
}

}  // namespace clatter::recover
