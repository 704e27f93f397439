// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/bodies.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::dynamics {

LoadedBodies load_bodies(const Scene& scene) {
  LoadedBodies bodies;
  for (const auto& component : scene.components) {
    for (const BodySpec& spec : component->reduced_bodies()) {
      if (find_body(bodies, spec.name) != nullptr) {
        throw InputError(fmt::format("{}: a second body named \"{}\", expected each name once",
                                     spec.where, spec.name));
      }
      bodies.push_back(load_body(spec));
    }
  }
  return bodies;
}

}  // namespace clatter::dynamics
