// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model_loads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "dynamics/given/load_table.hpp"

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

void add_gas(const Scene& scene, const LoadedBodies& bodies, const BodyIndex& index, Model& model) {
  if (!scene.gas) return;
  model.gas = read_cycle_table(scene.gas->table, scene.gas->column, "Pa", scene.gas->interpolation);
  model.ambient = scene.gas->ambient;
  const auto pressure = ramped(scene.time, [&model](double t) {
    return (*model.gas)(model.crank->angle(t)) - model.ambient;
  });
  const auto add = [&](const std::string& body, const std::string& load) {
    if (load.empty() || index.find(body) == index.end()) return;
    const LoadedBody& loaded = *find_body(bodies, body);
    const Eigen::VectorXd modal = loaded.modal.shapes.transpose() * unit_load(loaded.model, load);
    model.system.add_load({"gas on " + body, index.at(body), modal, pressure});
  };
  add("piston", scene.piston->gas_load);
  if (scene.block) add("block", scene.block->gas_load);
}

/// -M r a(t) for the accelerated frames of piston (translation, eq. (10)) and rod.
void add_frame_inertia(const Scene& scene, const BodyIndex& index, Model& model) {
  const SliderCrank& crank = *model.crank;
  const auto add = [&](const std::string& body, int direction, TimeFunction acceleration) {
    const int b = index.at(body);
    const Eigen::VectorXd modal =
        -model.system.bodies()[static_cast<size_t>(b)].rigid.col(direction);
    model.system.add_load({"inertia frame", b, modal, ramped(scene.time, std::move(acceleration))});
  };
  add("piston", 2, [&crank](double t) { return crank.piston_pin(t).acceleration; });
  const double centre = scene.engine->rod.centre;
  add("rod", 1, [&crank, centre](double t) { return crank.rod_point(t, centre).acceleration.x(); });
  add("rod", 2, [&crank, centre](double t) { return crank.rod_point(t, centre).acceleration.y(); });
  add("rod", 3, [&crank](double t) { return crank.rod_angle(t).acceleration; });
}

/// Inertia loads of the ideal mechanism on the engine: forces (y, z) and moment about x at the
/// crank axis, sum of m a and of its moments.
Eigen::Vector3d mechanism_inertia(const EngineSpec& engine, const SliderCrank& crank,
                                  double piston_mass, double t) {
  const auto pin = crank.piston_pin(t);
  const auto centre = crank.rod_point(t, engine.rod.centre);
  const Eigen::Vector2d rod = engine.rod.mass * centre.acceleration;
  const double piston = piston_mass * pin.acceleration;
  const double moment = centre.position.x() * rod.y() - centre.position.y() * rod.x() +
                        engine.pin_offset * piston +
                        engine.rod.inertia * crank.rod_angle(t).acceleration;
  return {rod.x(), rod.y() + piston, moment};
}

/// Forces of the other cylinders that cancel this one's inertia on the block's rigid modes.
void add_balance(const Scene& scene, const LoadedBodies& bodies, const BodyIndex& index,
                 Model& model) {
  const auto block = index.find("block");
  if (!scene.engine->balanced || block == index.end()) return;
  const LoadedBody& body = *find_body(bodies, "block");
  const int n = body.modal.rigid_modes;
  if (n != 6) return;  // a held block needs no balance
  const double x = body.model.grids.empty() || !scene.contact
                       ? 0.0
                       : body.model.grid(scene.block->liner).axis_point.x();
  // Wrench (F, M) about the origin of a unit force y, a unit force z in the crank's plane, a unit
  // moment about x.
  Eigen::Matrix<double, 6, 3> wrench = Eigen::Matrix<double, 6, 3>::Zero();
  wrench(1, 0) = 1.0;
  wrench(5, 0) = x;
  wrench(2, 1) = 1.0;
  wrench(4, 1) = -x;
  wrench(3, 2) = 1.0;
  const Eigen::MatrixXd on_modes =
      body.modal.rigid.topRows(6).transpose().partialPivLu().solve(wrench);
  const double piston_mass = find_body(bodies, "piston")->model.mass.mass;
  for (int k = 0; k < 3; ++k) {
    Eigen::VectorXd direction = Eigen::VectorXd::Zero(body.modal.modes());
    direction.head(6) = on_modes.col(k);
    model.system.add_load({"balance of the other cylinders", block->second, direction,
                           ramped(scene.time, [engine = *scene.engine, &crank = *model.crank,
                                               piston_mass, k](double t) {
                             return mechanism_inertia(engine, crank, piston_mass, t)(k);
                           })});
  }
}

TimeFunction load_value(const Scene& scene, const LoadSpec& load, const Model& model) {
  if (load.table.empty()) return [value = load.scale](double) { return value; };
  if (model.crank) {
    const auto table = read_cycle_table(load.table, load.column, load.unit, load.interpolation);
    return [table, scale = load.scale, &crank = *model.crank](double t) {
      return scale * table(crank.angle(t));
    };
  }
  const auto table = read_time_table(load.table, load.column, load.unit, load.interpolation,
                                     scene.time.begin, scene.time.end);
  return [table, scale = load.scale](double t) { return scale * table(t); };
}

void add_named_loads(const Scene& scene, const LoadedBodies& bodies, const BodyIndex& index,
                     Model& model) {
  int number = 0;
  for (const auto& load : scene.loads) {
    ++number;
    const LoadedBody* body = find_body(bodies, load.body);
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
    model.system.add_load({fmt::format("load {} on {}", number, load.body), index.at(load.body),
                           modal, ramped(scene.time, load_value(scene, load, model))});
  }
}

}  // namespace

void add_loads(const Scene& scene, const LoadedBodies& bodies, const BodyIndex& index,
               Model& model) {
  if (model.crank) {
    add_gas(scene, bodies, index, model);
    add_frame_inertia(scene, index, model);
    add_balance(scene, bodies, index, model);
  }
  if (scene.gravity > 0.0) {
    for (const auto& [name, b] : index) {
      const Eigen::VectorXd modal = -model.system.bodies()[static_cast<size_t>(b)].rigid.col(2);
      model.system.add_load(
          {"gravity", b, modal, ramped(scene.time, [g = scene.gravity](double) { return g; })});
    }
  }
  add_named_loads(scene, bodies, index, model);
}

}  // namespace clatter::dynamics
