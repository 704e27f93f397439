// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/model.hpp"

#include "dynamics/run/liner_ends_text.hpp"
#include "dynamics/run/model_effects.hpp"
#include "dynamics/run/model_loads.hpp"
#include "dynamics/run/piston_axis.hpp"
#include "dynamics/run/scene_bodies.hpp"

namespace clatter::dynamics {
namespace {

std::optional<SliderCrank> crank_of(const Scene& scene) {
  if (!scene.engine) return std::nullopt;
  const EngineSpec& engine = *scene.engine;
  return SliderCrank(0.5 * engine.stroke, engine.rod.length, engine.pin_offset, engine.speed);
}

/// What is reported of an engine's elements.
struct EngineElements {
  PinNode pin{-1, -1, -1, -1, -1, -1};
  const film::PistonLiner* contact = nullptr;
  std::optional<LinerFit> liner;
};

/// Joints, guide and contact of an engine scene.
EngineElements add_engine(const SceneBodies& bodies, const SliderCrank& crank, System& system) {
  check_piston_axis(bodies);
  const PinNode pin = pin_node(bodies, system);
  system.add_element(pin_joint(bodies, crank, pin, system));
  system.add_element(crank_joint(bodies, crank, system));
  system.add_element(pin_guide(bodies, crank, pin, system));
  if (!bodies.scene.contact) return {.pin = pin, .contact = nullptr, .liner = std::nullopt};
  LinerContact contact = liner_contact(bodies, crank, pin, system);
  const film::PistonLiner* element = contact.element.get();
  system.add_element(std::move(contact.element));
  return {.pin = pin, .contact = element, .liner = std::move(contact.liner)};
}

}  // namespace

std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& loaded) {
  const std::optional<SliderCrank> crank = crank_of(scene);
  System system;
  const BodyIndex index = add_bodies(scene, loaded, system);
  const SceneBodies bodies{scene, loaded, index};
  EngineElements engine = crank ? add_engine(bodies, *crank, system) : EngineElements{};
  std::vector<std::unique_ptr<ForceElement>> mounts = mounts_of(bodies, system);
  const size_t n_mounts = mounts.size();
  for (auto& mount : mounts) system.add_element(std::move(mount));
  const std::string ends =
      engine.contact != nullptr ? liner_ends_text(*crank, engine.contact->options()) : "";
  std::optional<Spline> gas = crank ? gas_pressure(scene) : std::nullopt;
  for (Load& load : loads_of(bodies, system, crank, gas)) system.add_load(std::move(load));
  return std::make_unique<Model>(Model{.system = std::move(system),
                                       .crank = crank,
                                       .gas = std::move(gas),
                                       .effects = effects_of(bodies, n_mounts, ends),
                                       .contact = engine.contact,
                                       .pin_y = engine.pin[1],
                                       .pin_rx = engine.pin[3],
                                       .liner = std::move(engine.liner)});
}

Eigen::Vector2d Model::secondary_motion(double time, const Eigen::VectorXd& y) const {
  Eigen::Vector2d motion(y(pin_y), y(pin_rx));
  if (liner) {
    const double tilt = y(liner->tilt);
    motion -= Eigen::Vector2d(y(liner->lateral) - tilt * crank->piston_pin(time).position, tilt);
  }
  return motion;
}

void Model::record(const StageState& state, History& history) const {
  if (pin_y >= 0) {
    const Eigen::Vector2d motion = secondary_motion(state.time, state.y);
    history.put("piston_lateral", "m", motion.x());
    history.put("piston_tilt", "rad", motion.y());
  }
  if (gas) history.put("gas_pressure", "Pa", (*gas)(crank->angle(state.time)));
  for (int e = 0; e < system.elements(); ++e) system.element(e).record(history);
}

}  // namespace clatter::dynamics
