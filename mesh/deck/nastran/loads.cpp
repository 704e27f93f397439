// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/loads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Vector3d;

}  // namespace

void Loads::build_surfaces() {
  for (const auto& [id, set] : raw_.loads) {
    std::map<double, std::string>& names = pressure_names_[id];
    for (const RawPressure& pressure : set.pressures) names[pressure.value];
    size_t count = 0;
    for (auto& [value, name] : names) {
      name = names.size() == 1 ? fmt::format("pload4_{}", id)
                               : fmt::format("pload4_{}_{}", id, ++count);
    }
    std::map<double, SurfaceBuilder> surfaces;
    for (const RawPressure& pressure : set.pressures) {
      add_face(model_, pressure, surfaces[pressure.value]);
    }
    for (const auto& [value, surface] : surfaces) {
      model_.deck.mesh.surfaces[names[value]] = surface.finish();
    }
  }
}

std::set<int32_t> Loads::top_loads() const {
  std::set<int32_t> top;
  for (const auto& [id, set] : raw_.loads) top.insert(id);
  for (const auto& [id, sum] : raw_.load_sums) {
    for (const auto& [factor, set] : sum.terms) top.erase(set);
  }
  for (const auto& [id, sum] : raw_.load_sums) top.insert(id);
  return top;
}

Origin Loads::origin_of(int32_t load) const {
  const auto sum = raw_.load_sums.find(load);
  return sum != raw_.load_sums.end() ? sum->second.origin : raw_.loads.at(load).origin;
}

void Loads::list(Step& step, int32_t load, Origin origin) {
  const auto sum = raw_.load_sums.find(load);
  if (sum == raw_.load_sums.end()) return list_set(step, load, 1.0, origin);
  for (const auto& [factor, set] : sum->second.terms) {
    list_set(step, set, factor, sum->second.origin);
  }
}

void Loads::list_set(Step& step, int32_t id, double factor, Origin origin) {
  const auto at = raw_.loads.find(id);
  if (at == raw_.loads.end()) {
    model_.source.fail(origin, fmt::format("LOAD: found no loads of set {}", id));
  }
  for (const RawForce& force : at->second.forces) list_force(step, force, factor);
  for (const RawGravity& raw : at->second.gravity) list_gravity(step, raw, factor);
  for (const RawRotation& raw : at->second.rotations) list_rotation(step, raw, factor);
  if (!step.acceleration.allFinite()) {
    model_.source.fail(at->second.origin, "GRAV: its numbers are too large");
  }
  for (const auto& [value, name] : pressure_names_[id]) {
    model_.spend(128, origin);
    step.pressures.push_back({name, factor * value});
  }
}

void Loads::list_gravity(Step& step, const RawGravity& raw, double factor) {
  const System& system = model_.systems.get(raw.system, raw.origin);
  if (system.kind != System::Kind::kRectangular) {
    model_.source.fail(raw.origin, "GRAV: expected a rectangular coordinate system");
  }
  step.acceleration += factor * (system.axes * vector(raw.vector));
}

// A revolutions per second about an axis through a grid or the basic origin.
void Loads::list_rotation(Step& step, const RawRotation& raw, double factor) {
  const System& system = model_.systems.get(raw.system, raw.origin);
  if (system.kind != System::Kind::kRectangular) {
    model_.source.fail(raw.origin, "RFORCE: expected a rectangular coordinate system");
  }
  Step::Rotation rotation;
  rotation.axis = system.axes * vector(raw.axis);
  const double omega = 2.0 * std::numbers::pi * raw.turns;
  rotation.omega_squared = factor * omega * omega;
  if (raw.grid != 0) {
    const int32_t row = model_.grids.find(raw.grid);
    if (row < 0) model_.source.fail(raw.origin, fmt::format("found no GRID {}", raw.grid));
    rotation.point = vector(raw_.grids.at[static_cast<size_t>(row)]);
  }
  step.rotations.push_back(rotation);
}

void Loads::list_force(Step& step, const RawForce& raw, double factor) {
  const NodeIndex node_index = model_.find(raw.grid, raw.origin);
  const char* card = raw.moment ? "MOMENT" : "FORCE";
  if (node_index < 0) {
    model_.source.fail(
        raw.origin, fmt::format("{}: grid {} belongs to no solid and no coupling", card, raw.grid));
  }
  if (raw.moment && !model_.node_map.is_point(node_index)) {
    model_.source.fail(raw.origin,
                       fmt::format("MOMENT: node {} of solids has no rotations", raw.grid));
  }
  const Vector3d force =
      factor *
      (model_.systems.directions(raw.system, model_.node_map.position(node_index), raw.origin) *
       vector(raw.vector));
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(force[k])) {
      model_.source.fail(raw.origin, fmt::format("{}: its numbers are too large", card));
    }
    if (force[k] == 0.0) continue;
    model_.spend(64, raw.origin);
    step.forces.push_back({node_index, (raw.moment ? 3 : 0) + k, force[k], {}});
  }
}

void Loads::list_temperature(Step& step, int32_t id, Origin origin) {
  const auto at = raw_.temperatures.find(id);
  if (at == raw_.temperatures.end()) {
    model_.source.fail(origin, fmt::format("TEMPERATURE = {}: found no TEMP or TEMPD", id));
  }
  step.temperature = fmt::format("temperature_{}", id);
  const auto [field, fresh] = model_.deck.mesh.fields.try_emplace(step.temperature);
  if (fresh) field->second = temperatures(id, at->second);
}

RowMatrix Loads::temperatures(int32_t id, const TemperatureSet& set) {
  model_.spend(8 * model_.node_map.node_count(), set.origin);
  const double none = set.has_default ? set.default_value : std::nan("");
  RowMatrix values = RowMatrix::Constant(model_.node_map.node_count(), 1, none);
  for (const auto& entry : set.values) {
    const NodeIndex node_index = model_.find(entry.grid, entry.origin);
    if (node_index >= 0 && !model_.node_map.is_point(node_index))
      values(node_index, 0) = entry.value;
  }
  for (NodeIndex node = 0; node < model_.node_map.node_count(); ++node) {
    if (!std::isnan(values(node, 0))) continue;
    model_.source.fail(set.origin,
                       fmt::format("temperature set {}: found no TEMP of node {} and no TEMPD", id,
                                   model_.deck.mesh.node_ids[static_cast<size_t>(node)]));
  }
  return values;
}

}  // namespace clatter::mesh::deck::nastran
