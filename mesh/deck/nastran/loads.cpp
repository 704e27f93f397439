// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/nastran/loads.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/deck/nastran/supports.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Vector3d;

constexpr size_t kMostPressures = 10'000;  // surfaces of one load set

}  // namespace

void Loads::build_surfaces() {
  for (const auto& [id, set] : raw_.loads) {
    std::map<double, SurfaceBuilder> surfaces;  // by pressure: compression is positive
    const auto add = [&, this, of = id](const RawPressure& pressure, const LoadedFace& face,
                                        double value) {
      surfaces[value].add(face.type, face.nodes);
      if (surfaces.size() > kMostPressures)
        model_.source.fail(pressure.origin, fmt::format("load set {}: found more than {} different "
                                                        "pressures",
                                                        of, kMostPressures));
    };
    const auto push = [&, this, of = id](const RawPressure& pressure, const LoadedFace& face,
                                         double sign) {
      for (Step::NodalForce force : forces_on_face(model_, pressure, face)) {
        force.value *= sign;
        face_forces_[of].push_back(std::move(force));
      }
    };
    for (const RawPressure& pressure : set.pressures) {
      if (pressure.cell == 0) {
        const LoadedFace face = face_of_grids(model_, pressure);
        if (face.on_solid)
          add(pressure, face, face.outward ? -pressure.values[0] : pressure.values[0]);
        else
          push(pressure, face, -1.0);  // along the normal
        continue;
      }
      const LoadedFace face = face_of_cell(model_, pressure);
      if (pressure.is_plain())
        add(pressure, face, pressure.values[0]);
      else
        push(pressure, face, 1.0);
    }
    for (const RawSkinPressure& raw : set.on_skins)
      for (const auto& [pressure, face] : loads_on_skins(model_, raw)) {
        if (pressure.is_plain())
          add(pressure, face, face.outward ? -pressure.values[0] : pressure.values[0]);
        else
          push(pressure, face, pressure.along_vector() ? 1.0 : -1.0);
      }
    name_surfaces(id, surfaces);
  }
}

void Loads::name_surfaces(int32_t id, const std::map<double, SurfaceBuilder>& surfaces) {
  size_t count = 0;
  for (const auto& [value, surface] : surfaces) {
    std::string& name = pressure_names_[id][value];
    name = surfaces.size() == 1 ? fmt::format("pload4_{}", id)
                                : fmt::format("pload4_{}_{}", id, ++count);
    model_.deck.mesh.surfaces[name] = surface.finish();
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
  for (const RawAcceleration& raw : at->second.accelerations)
    add_accelerations(model_, step, raw, factor);
  list_moved(step, id, at->second, factor);
  if (!step.acceleration.allFinite()) {
    model_.source.fail(at->second.origin, "GRAV: its numbers are too large");
  }
  if (const auto forces = face_forces_.find(id); forces != face_forces_.end())
    for (Step::NodalForce force : forces->second) {
      model_.spend(64, origin);
      force.value *= factor;
      step.forces.push_back(std::move(force));
    }
  for (const auto& [value, name] : pressure_names_[id]) {
    model_.spend(128, origin);
    step.pressures.push_back({name, factor * value});
  }
}

// SPCD moves what the supports hold.
void Loads::list_moved(Step& step, int32_t id, const LoadSet& set, double factor) {
  Supports moved(model_, fmt::format("spcd_{}", id));
  for (RawHold hold : set.moved) {
    hold.value *= factor;
    moved.read(hold);
  }
  for (Support& support : moved.list()) step.moved.push_back(std::move(support));
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
    rotation.point = vector(raw_.grids.at[row]);
  }
  step.rotations.push_back(rotation);
}

void Loads::list_force(Step& step, const RawForce& raw, double factor) {
  const NodeIndex node_index = model_.find(raw.grid, raw.origin);
  const char* card = raw.moment ? "MOMENT" : "FORCE";
  if (node_index < 0 && model_.is_lost(raw.grid)) {
    ++model_.lost_loads;
    return;
  }
  if (node_index < 0) {
    model_.source.fail(
        raw.origin, fmt::format("{}: grid {} belongs to no solid and no coupling", card, raw.grid));
  }
  if (raw.moment && !model_.node_map.turns(node_index)) {
    model_.source.fail(raw.origin,
                       fmt::format("MOMENT: node {} of solids has no rotations", raw.grid));
  }
  const Vector3d force = factor * vector_of(raw, node_index);
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(force[k])) {
      model_.source.fail(raw.origin, fmt::format("{}: its numbers are too large", card));
    }
    if (force[k] == 0.0) continue;
    model_.spend(64, raw.origin);
    step.forces.push_back({node_index, (raw.moment ? 3 : 0) + k, force[k], {}});
  }
}

Vector3d Loads::vector_of(const RawForce& raw, NodeIndex node_index) const {
  if (raw.along[0] == 0)
    return model_.systems.directions(raw.system, model_.node_map.position(node_index), raw.origin) *
           vector(raw.vector);
  const auto arrow = [&](size_t from) -> Vector3d {
    std::array<Vector3d, 2> at;
    for (size_t k = 0; k < 2; ++k) {
      const int32_t row = model_.grids.find(raw.along[from + k]);
      if (row < 0)
        model_.source.fail(raw.origin, fmt::format("found no GRID {}", raw.along[from + k]));
      at[k] = vector(raw_.grids.at[row]);
    }
    return at[1] - at[0];
  };
  const Vector3d along = raw.along[2] == 0 ? arrow(0) : arrow(0).cross(arrow(2));
  if (!(along.norm() > 0.0))
    model_.source.fail(raw.origin, "expected grids that define a direction");
  return raw.magnitude * along.normalized();
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
                                   model_.deck.mesh.node_ids[node]));
  }
  return values;
}

}  // namespace clatter::mesh::deck::nastran
