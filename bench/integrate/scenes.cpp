// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/integrate/scenes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/dynamics/impact_chain.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/synthetic_engine.hpp"

namespace clatter::bench {

namespace {

using dynamics::System;
using Eigen::VectorXd;
using namespace dynamics::testing;

/// A scene that owns `model` and starts from its system's own state at time 0.
template <class Owner>
BenchScene scene_of(std::shared_ptr<Owner> model, System& system, double end) {
  BenchScene scene;
  scene.system = std::shared_ptr<System>(std::move(model), &system);
  scene.eta = system.eta_start();
  scene.v = system.v_start();
  scene.end = end;
  scene.options.first = 1e-9;
  scene.options.smallest = 1e-14;
  return scene;
}

/// All interface coordinates, times `factor`.
std::function<VectorXd(double, const ModalState&)> all_of(const System& system, double factor) {
  return [&system, factor](double, const ModalState& state) -> VectorXd {
    return factor * system.interface(state.eta);
  };
}

/// Andrews' squeezing mechanism with joints of a stiffness [N/m]; compared are its seven angles.
BenchScene andrews(double stiffness) {
  const auto model = std::make_shared<Andrews>(stiffness, 1e4);
  BenchScene scene = scene_of(model, model->system, 0.03);
  scene.options.largest = 1e-3;
  scene.options.accuracy = {1.0, 1e-3, 1.0, 1e-3};
  scene.unit = "rad";
  const Andrews* mechanism = model.get();
  scene.observe = [mechanism](double, const ModalState& state) -> VectorXd {
    return mechanism->angles(mechanism->system.interface(state.eta));
  };
  return scene;
}

/// 100 masses of 10 g that collide through 1e9 N/m, 1 ms; compared are their positions.
BenchScene chain(double damping) {
  ImpactChainOptions options;
  options.damping = damping;
  const auto model = std::make_shared<ImpactChain>(options);
  BenchScene scene = scene_of(model, model->system, 1e-3);
  scene.options.largest = 1e-4;
  scene.options.accuracy = {1.0, 1e-4, 1.0, 1.0};
  scene.unit = "um";
  scene.observe = all_of(model->system, 1e6);
  return scene;
}

/// A dry piston in an elastic block at 2000 rpm, 10 ms from the top; compared is the
/// piston's lateral position in its liner.
BenchScene slap() {
  struct Owner {
    SyntheticEngine engine;
    std::unique_ptr<dynamics::Model> model;
  };
  EngineVariant variant;
  variant.film = false;
  variant.balanced = true;
  variant.dry_clearance = 20e-6;
  const auto owner = std::make_shared<Owner>(Owner{SyntheticEngine(variant), nullptr});
  owner->model = owner->engine.model();
  System& system = owner->model->system;
  BenchScene scene = scene_of(owner, system, 0.0);
  scene.begin = -2.0 * std::numbers::pi / owner->engine.scene.clock->speed;
  scene.end = scene.begin + 0.01;
  scene.eta = scene.v = VectorXd::Zero(system.modes());
  scene.options.largest = 1e-4;
  scene.options.accuracy = {1.0, 1e-5, 0.1, 0.05};
  scene.unit = "um";
  const dynamics::Model* model = owner->model.get();
  scene.observe = [model](double time, const ModalState& state) -> VectorXd {
    const VectorXd y = model->system.interface(state.eta);
    return 1e6 * cylinder_of(*model).secondary_motion(time, y).head(1);
  };
  return scene;
}

/// A ball that falls from 1 mm on a rigid floor with a restitution of 0.8, until some impacts
/// before they accumulate; compared is its height.
BenchScene bounces() {
  const auto model = std::make_shared<System>();
  const int y = model->coordinate(model->add_body(point_mass(1.0)), 0);
  model->add_element(std::make_unique<Floor>(y, 0.8));
  push(*model, [](double) { return -9.81; });
  BenchScene scene = scene_of(model, *model, 0.12);
  scene.eta = vector(1e-3);
  scene.v = vector(0.0);
  scene.options.largest = 1e-2;
  scene.options.accuracy = {1.0, 1e-3, 0.1, 0.05};
  scene.unit = "um";
  scene.observe = all_of(*model, 1e6);
  return scene;
}

const std::vector<std::pair<std::string, BenchScene (*)()>> kScenes{
    {"andrews", [] { return andrews(1e10); }},
    {"chain", [] { return chain(0.0); }},
    {"damped-chain", [] { return chain(0.3); }},
    {"slap", slap},
    {"bounces", bounces},
};

}  // namespace

const std::vector<std::string>& scene_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, make] : kScenes) all.push_back(name);
    return all;
  }();
  return names;
}

BenchScene make_scene(const std::string& name) {
  if (name.ends_with(".run.toml")) return chain_scene(name);
  for (const auto& [own, make] : kScenes)
    if (own == name) return make();
  throw InputError(fmt::format("bench: found scene {}, expected one of {}", name,
                               fmt::join(scene_names(), ", ")));
}

}  // namespace clatter::bench
