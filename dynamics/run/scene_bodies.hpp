// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bodies of a scene in a system, and its coordinates by name.
#include <map>
#include <string>

#include "dynamics/integrate/system.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Indices of the bodies in a system, by name ("piston", "block", "rod", ...).
using BodyIndex = std::map<std::string, int>;

/// Adds the bodies that were read and, in an engine scene, the rod.
BodyIndex add_bodies(const Scene& scene, const LoadedBodies& bodies, System& system);

/// Where the cylinder is in the engine's frame, (x, y) [m].
struct Cylinder {
  Eigen::Vector2d bore;  // its axis
  Eigen::Vector2d pin;   // the pin's centre, at the pin offset; the crank pin has the same x
};

/// A scene whose bodies are in a system: references to data that outlives it.
struct SceneBodies {
  const Scene& scene;
  const LoadedBodies& loaded;
  const BodyIndex& index;

  /// The elastic block, or nullptr.
  const LoadedBody* block() const;
  /// Of an engine scene. The bore's axis is that of the liner's grid; without one it is over the
  /// mean of the named bearings and concentric with the skirt.
  Cylinder cylinder() const;
  /// The y index of the coordinate of a set along (or, for rotations, about) axis 0, 1 or 2, which
  /// is requested of the system. InputError naming the set when it has none.
  int y(System& system, const std::string& body, const std::string& set, int axis,
        bool rotation) const;
};

}  // namespace clatter::dynamics
