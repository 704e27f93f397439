// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "core/base/error.hpp"
#include "dynamics/given/load_table.hpp"
#include "dynamics/run/balance.hpp"

namespace clatter::dynamics {
namespace {

using TimeFunction = std::function<double(double)>;

/// Multiplies by the ramp of the start.
TimeFunction ramped(const TimeSpec& time, TimeFunction value) {
  if (time.ramp <= 0.0) return value;
  return [begin = time.begin, length = time.ramp, value = std::move(value)](double t) {
    const double s = std::clamp((t - begin) / length, 0.0, 1.0);
    return s * s * (3.0 - 2.0 * s) * value(t);
  };
}

std::vector<Load> ramped(const TimeSpec& time, std::vector<Load> loads) {
  for (Load& load : loads) load.value = ramped(time, std::move(load.value));
  return loads;
}

/// Modal force of gravity or of an accelerated frame per unit acceleration: -M r.
Eigen::VectorXd frame_force(const System& system, int body, int direction) {
  return -system.bodies()[static_cast<size_t>(body)].rigid.col(direction);
}

std::vector<Load> gas_loads(const SceneBodies& bodies, const SliderCrank& crank,
                            const Spline& gas) {
  const Scene& scene = bodies.scene;
  const auto pressure = ramped(scene.time, [crank, gas, ambient = scene.gas->ambient](double t) {
    return gas(crank.angle(t)) - ambient;
  });
  std::vector<Load> loads;
  const auto add = [&](const std::string& body, const std::string& load) {
    if (load.empty() || bodies.index.find(body) == bodies.index.end()) return;
    const LoadedBody& loaded = *find_body(bodies.loaded, body);
    const Eigen::VectorXd modal = loaded.modal.shapes.transpose() * unit_load(loaded.model, load);
    loads.push_back({"gas on " + body, bodies.index.at(body), modal, pressure});
  };
  add("piston", scene.piston->gas_load);
  if (scene.block) add("block", scene.block->gas_load);
  return loads;
}

/// -M r a(t) for the accelerated frames of piston (translation, eq. (10)) and rod.
std::vector<Load> frame_inertia(const SceneBodies& bodies, const System& system,
                                const SliderCrank& crank) {
  const auto load = [&](const std::string& body, int direction, TimeFunction acceleration) {
    const int b = bodies.index.at(body);
    return Load{"inertia frame", b, frame_force(system, b, direction),
                ramped(bodies.scene.time, std::move(acceleration))};
  };
  const double centre = bodies.scene.engine->rod.centre;
  return {load("piston", 2, [crank](double t) { return crank.piston_pin(t).acceleration; }),
          load("rod", 1,
               [crank, centre](double t) { return crank.rod_point(t, centre).acceleration.x(); }),
          load("rod", 2,
               [crank, centre](double t) { return crank.rod_point(t, centre).acceleration.y(); }),
          load("rod", 3, [crank](double t) { return crank.rod_angle(t).acceleration; })};
}

/// The value of a [[load]] over time, without the ramp of the start.
TimeFunction load_value(const Scene& scene, const LoadSpec& load,
                        const std::optional<SliderCrank>& crank) {
  if (load.table.empty()) return [value = load.scale](double) { return value; };
  if (crank) {
    const auto table = read_cycle_table(load.table, load.column, load.unit, load.interpolation);
    return [table, scale = load.scale, crank = *crank](double t) {
      return scale * table(crank.angle(t));
    };
  }
  const auto table = read_time_table(load.table, load.column, load.unit, load.interpolation,
                                     scene.time.begin, scene.time.end);
  return [table, scale = load.scale](double t) { return scale * table(t); };
}

std::vector<Load> named_loads(const SceneBodies& bodies, const std::optional<SliderCrank>& crank) {
  const Scene& scene = bodies.scene;
  std::vector<Load> loads;
  for (const auto& load : scene.loads) {
    const LoadedBody* body = find_body(bodies.loaded, load.body);
    if (body == nullptr) {
      throw InputError(
          fmt::format("{}: load.body: no body \"{}\" in the scene", load.where, load.body));
    }
    Eigen::VectorXd modal;
    if (!load.load.empty()) {
      modal = body->modal.shapes.transpose() * unit_load(body->model, load.load);
    } else {
      const int dof = set_dof(body->model, load.set, load.component % 3, load.component >= 3);
      modal = body->modal.row_of(dof).transpose();
    }
    loads.push_back({fmt::format("load {} on {}", loads.size() + 1, load.body),
                     bodies.index.at(load.body), modal,
                     ramped(scene.time, load_value(scene, load, crank))});
  }
  return loads;
}

}  // namespace

std::optional<Spline> gas_pressure(const Scene& scene) {
  if (!scene.gas) return std::nullopt;
  return read_gas_table(scene.gas->table, scene.gas->column, scene.gas->interpolation);
}

std::vector<Load> loads_of(const SceneBodies& bodies, const System& system,
                           const std::optional<SliderCrank>& crank,
                           const std::optional<Spline>& gas) {
  const Scene& scene = bodies.scene;
  std::vector<Load> all;
  const auto append = [&](std::vector<Load> loads) {
    for (Load& load : loads) all.push_back(std::move(load));
  };
  if (crank) {
    if (gas) append(gas_loads(bodies, *crank, *gas));
    append(frame_inertia(bodies, system, *crank));
    append(ramped(scene.time, balance_loads(bodies, *crank)));
  }
  if (scene.gravity > 0.0) {
    for (const auto& [name, b] : bodies.index)
      all.push_back({"gravity", b, frame_force(system, b, 2),
                     ramped(scene.time, [g = scene.gravity](double) { return g; })});
  }
  append(named_loads(bodies, crank));
  return all;
}

}  // namespace clatter::dynamics
