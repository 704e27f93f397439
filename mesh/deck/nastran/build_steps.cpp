// SPDX-License-Identifier: GPL-3.0-or-later
// Subcases: their loads, temperatures, supports.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/nastran/sets.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Vector3d;

Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

class StepBuilder {
 public:
  explicit StepBuilder(Model& model) : model_(model), bulk_(model.bulk) {}

  void run() {
    Refusals& refusals = model_.refusals;
    refusals.attempt([&] { initial_temperature(); });
    refusals.attempt([&] { name_pressures(); });
    if (bulk_.control.has_cases) {
      for (const Subcase& subcase : bulk_.control.subcases) {
        refusals.attempt([&] { add_subcase(subcase); });
      }
      return;
    }
    for (const int32_t load : top_loads()) refusals.attempt([&] { add_load_step(load); });
  }

 private:
  void add_load_step(int32_t load) {
    Step step;
    step.name = fmt::format("load_{}", load);
    step.where = model_.where(origin_of(load));
    add_loads(step, load, origin_of(load));
    model_.deck.steps.push_back(std::move(step));
  }

  // TEMPERATURE(INITIAL) is the reference temperature of every material.
  void initial_temperature() {
    const int32_t set = bulk_.control.initial_temperature;
    if (set == 0) return;
    const auto at = bulk_.temperatures.find(set);
    const Origin origin = at == bulk_.temperatures.end() ? 0 : at->second.origin;
    if (at == bulk_.temperatures.end() || !at->second.has_default || !at->second.values.empty()) {
      model_.source.fail(origin, fmt::format("TEMPERATURE(INITIAL) = {}: expected one TEMPD and no "
                                             "TEMP in this set: the same everywhere",
                                             set));
    }
    for (auto& [name, material] : model_.deck.materials) {
      material.reference_temperature = at->second.default_value;
    }
  }

  // Every pressure of every load set is a surface of the mesh.
  void name_pressures() {
    for (auto& [id, set] : bulk_.loads) {
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

  std::set<int32_t> top_loads() const {
    std::set<int32_t> top;
    for (const auto& [id, set] : bulk_.loads) top.insert(id);
    for (const auto& [id, sum] : bulk_.load_sums) {
      for (const auto& [factor, set] : sum.terms) top.erase(set);
    }
    for (const auto& [id, sum] : bulk_.load_sums) top.insert(id);
    return top;
  }

  Origin origin_of(int32_t load) const {
    const auto sum = bulk_.load_sums.find(load);
    return sum != bulk_.load_sums.end() ? sum->second.origin : bulk_.loads.at(load).origin;
  }

  void add_subcase(const Subcase& subcase) {
    const Choice& choice = subcase.choice;
    Step step;
    step.name = fmt::format("subcase_{}", subcase.id);
    step.where = model_.where(subcase.origin);
    const int32_t solution = bulk_.control.solution;
    if (solution == 101) step.kind = Step::Kind::kStatic;
    if (solution == 103) step.kind = Step::Kind::kFrequency;
    if (choice.method != 0) {
      const auto count = bulk_.eigen_counts.find(choice.method);
      if (count == bulk_.eigen_counts.end()) {
        model_.source.fail(subcase.origin,
                           fmt::format("METHOD = {}: found no EIGRL or EIGR", choice.method));
      }
      step.modes = count->second;
    }
    if (choice.load != 0) add_loads(step, choice.load, subcase.origin);
    if (choice.temperature != 0) add_temperature(step, choice.temperature, subcase.origin);
    if (choice.spc != 0 && !same_supports()) {
      step.supports = supports_of(model_, choice.spc, subcase.origin);
    }
    model_.deck.steps.push_back(std::move(step));
  }

  bool same_supports() const {
    const auto& all = bulk_.control.subcases;
    return std::all_of(all.begin(), all.end(), [&](const Subcase& subcase) {
      return subcase.choice.spc == all.front().choice.spc;
    });
  }

  void add_loads(Step& step, int32_t load, Origin origin) {
    const auto sum = bulk_.load_sums.find(load);
    if (sum == bulk_.load_sums.end()) return add_set(step, load, 1.0, origin);
    for (const auto& [factor, set] : sum->second.terms) {
      add_set(step, set, factor, sum->second.origin);
    }
  }

  void add_set(Step& step, int32_t id, double factor, Origin origin) {
    const auto at = bulk_.loads.find(id);
    if (at == bulk_.loads.end()) {
      model_.source.fail(origin, fmt::format("LOAD: found no loads of set {}", id));
    }
    for (const RawForce& force : at->second.forces) add_force(step, force, factor);
    for (const RawGravity& raw : at->second.gravity) {
      const System& system = model_.systems.get(raw.system, raw.origin);
      if (system.kind != System::Kind::kRectangular) {
        model_.source.fail(raw.origin, "GRAV: expected a rectangular coordinate system");
      }
      step.acceleration += factor * (system.axes * vector(raw.vector));
    }
    for (const RawRotation& raw : at->second.rotations) add_rotation(step, raw, factor);
    if (!step.acceleration.allFinite()) {
      model_.source.fail(at->second.origin, "GRAV: its numbers are too large");
    }
    for (const auto& [value, name] : pressure_names_[id]) {
      model_.spend(128, origin);
      step.pressures.push_back({name, factor * value});
    }
  }

  // A revolutions per second about an axis through a grid or the basic origin.
  void add_rotation(Step& step, const RawRotation& raw, double factor) {
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
      rotation.point = vector(bulk_.grids.at[static_cast<size_t>(row)]);
    }
    step.rotations.push_back(rotation);
  }

  void add_force(Step& step, const RawForce& raw, double factor) {
    const NodeIndex node_index = model_.find(raw.grid, raw.origin);
    const char* card = raw.moment ? "MOMENT" : "FORCE";
    if (node_index < 0) {
      model_.source.fail(raw.origin, fmt::format("{}: grid {} belongs to no solid and no coupling",
                                                 card, raw.grid));
    }
    if (raw.moment && model_.is_node(node_index)) {
      model_.source.fail(raw.origin,
                         fmt::format("MOMENT: node {} of solids has no rotations", raw.grid));
    }
    const Vector3d force =
        factor * (model_.systems.directions(raw.system, model_.position(node_index), raw.origin) *
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

  void add_temperature(Step& step, int32_t id, Origin origin) {
    const auto at = bulk_.temperatures.find(id);
    if (at == bulk_.temperatures.end()) {
      model_.source.fail(origin, fmt::format("TEMPERATURE = {}: found no TEMP or TEMPD", id));
    }
    step.temperature = fmt::format("temperature_{}", id);
    const auto [field, fresh] = model_.deck.mesh.fields.try_emplace(step.temperature);
    if (fresh) field->second = temperatures(id, at->second);
  }

  RowMatrix temperatures(int32_t id, const TemperatureSet& set) {
    model_.spend(8 * model_.node_count, set.origin);
    const double none = set.has_default ? set.default_value : std::nan("");
    RowMatrix values = RowMatrix::Constant(model_.node_count, 1, none);
    for (const auto& entry : set.values) {
      const NodeIndex node_index = model_.find(entry.grid, entry.origin);
      if (node_index >= 0 && model_.is_node(node_index)) values(node_index, 0) = entry.value;
    }
    for (NodeIndex node = 0; node < model_.node_count; ++node) {
      if (!std::isnan(values(node, 0))) continue;
      model_.source.fail(
          set.origin, fmt::format("temperature set {}: found no TEMP of node {} and no TEMPD", id,
                                  model_.deck.mesh.node_ids[static_cast<size_t>(node)]));
    }
    return values;
  }

  Model& model_;
  Bulk& bulk_;
  std::map<int32_t, std::map<double, std::string>> pressure_names_;  // by load set and value
};

}  // namespace

void build_steps(Model& model) { StepBuilder(model).run(); }

}  // namespace clatter::mesh::deck::nastran
