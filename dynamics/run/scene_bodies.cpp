// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/scene_bodies.hpp"

namespace clatter::dynamics {

BodyIndex add_bodies(const Scene& scene, const LoadedBodies& bodies, System& system) {
  BodyIndex index;
  for (const auto& body : bodies) index[body.spec.name] = system.add_body(body.modal);
  if (scene.engine) index["rod"] = system.add_body(make_rigid_rod("rod", scene.engine->rod));
  return index;
}

const LoadedBody* SceneBodies::block() const {
  return scene.block ? find_body(loaded, "block") : nullptr;
}

int SceneBodies::y(System& system, const std::string& body, const std::string& set, int axis,
                   bool rotation) const {
  return system.coordinate(index.at(body),
                           set_dof(find_body(loaded, body)->model, set, axis, rotation));
}

}  // namespace clatter::dynamics
