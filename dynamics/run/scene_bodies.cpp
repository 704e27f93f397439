// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/scene_bodies.hpp"

#include <optional>

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

Cylinder SceneBodies::cylinder() const {
  const auto axis_of = [](const LoadedBody* body, const std::string& grid) {
    std::optional<Eigen::Vector2d> axis;
    if (body == nullptr) return axis;
    const auto found = body->model.grids.find(grid);
    if (found != body->model.grids.end()) axis = found->second.axis_point.head<2>();
    return axis;
  };
  const double offset = scene.engine->pin_offset;
  const Eigen::Vector2d skirt = axis_of(find_body(loaded, "piston"), scene.piston->skirt)
                                    .value_or(Eigen::Vector2d(0, -offset));
  Eigen::Vector2d bore(skirt.x(), skirt.y() + offset);
  if (block() != nullptr) {
    double x = 0.0;
    for (const auto& set : scene.block->bearings) {
      x += block()->model.set(set).position(0, 0) /
           static_cast<double>(scene.block->bearings.size());
    }
    bore.x() += x;
    bore = axis_of(block(), scene.block->liner).value_or(bore);
  }
  return {bore, {bore.x() - skirt.x(), offset}};
}

int SceneBodies::y(System& system, const std::string& body, const std::string& set, int axis,
                   bool rotation) const {
  return system.coordinate(index.at(body),
                           set_dof(find_body(loaded, body)->model, set, axis, rotation));
}

}  // namespace clatter::dynamics
