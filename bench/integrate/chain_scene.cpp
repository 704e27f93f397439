// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "bench/integrate/scenes.hpp"
#include "core/base/error.hpp"
#include "dynamics/chain/link_joints.hpp"
#include "dynamics/run/start_state.hpp"

namespace clatter::bench {

using dynamics::gather;
using dynamics::LinkJoints;
using dynamics::System;
using Eigen::VectorXd;

namespace {

struct Owner {
  dynamics::Scene scene;
  std::unique_ptr<dynamics::Model> model;
};

LinkJoints& joints_of(System& system) {
  for (int e = 0; e < system.elements(); ++e)
    if (auto* joints = dynamic_cast<LinkJoints*>(&system.element(e))) return *joints;
  throw InputError("bench: found no [[chain]] in the scene, expected one");
}

/// The y of a body's angle in the plane.
int angle_of(System& system, const std::string& name) {
  const auto& bodies = system.bodies();
  for (size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b].name == name) return system.coordinate(static_cast<int>(b), 2);
  throw InputError(fmt::format("bench: found no body {} in the scene, expected one", name));
}

/// Tensions of all joints and a spin.
VectorXd tensions_and_spin(const System& system, LinkJoints& joints, int angle, double time,
                           const ModalState& state) {
  const VectorXd y = system.interface(state.eta), v = system.interface(state.v);
  const auto& at = joints.coordinates();
  dynamics::Response response;
  const dynamics::Stage instant{time, 1.0, 0, {}};
  joints.evaluate(instant, gather(y, at), gather(v, at), false, response);
  joints.finish_stage(instant);
  joints.accept_step(time);
  const auto& tensions = joints.tensions();
  const auto n = static_cast<Eigen::Index>(tensions.size());
  VectorXd values(n + 1);
  values.head(n) = Eigen::Map<const VectorXd>(tensions.data(), n);
  values(n) = v(angle);
  return values;
}

}  // namespace

BenchScene chain_scene(const std::filesystem::path& file) {
  const auto owner = std::make_shared<Owner>(Owner{dynamics::read_scene(file), nullptr});
  owner->model = dynamics::build_model(owner->scene, {});
  System& system = owner->model->system;
  const dynamics::ModalStart start = dynamics::start_state(owner->scene, {}, *owner->model);
  const dynamics::TimeSpec& time = owner->scene.time;
  BenchScene scene;
  scene.system = std::shared_ptr<System>(owner, &system);
  scene.eta = start.eta;
  scene.v = start.v;
  scene.begin = time.begin;
  scene.end = time.end;
  scene.samples = static_cast<int>(std::lround((time.end - time.begin) / time.output_step));
  scene.options = owner->scene.steps;
  scene.unit = "N";
  LinkJoints* joints = &joints_of(system);
  const int angle = angle_of(system, "intake");
  scene.observe = [&system, joints, angle](double now, const ModalState& state) {
    return tensions_and_spin(system, *joints, angle, now, state);
  };
  return scene;
}

}  // namespace clatter::bench
