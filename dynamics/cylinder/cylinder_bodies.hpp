// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bodies of a cylinder in a model.
#include "dynamics/component/model_builder.hpp"
#include "dynamics/cylinder/cylinder_spec.hpp"
#include "dynamics/element/crank_angle.hpp"

namespace clatter::dynamics {

/// Where the cylinder is in the engine's frame, (x, y) [m].
struct CylinderAxes {
  Eigen::Vector2d bore;  // its axis
  Eigen::Vector2d pin;   // the pin's centre, at the pin offset; the crank pin has the same x
};

/// A cylinder whose bodies are in a model: references to data that outlives it.
struct CylinderBodies {
  const CylinderSpec& spec;
  ModelBuilder& model;

  const LoadedBody& piston() const;
  /// The elastic block, or nullptr.
  const LoadedBody* block() const;
  int piston_index() const { return model.body(spec.name_of("piston")); }
  /// Of a rod with a body: not of a massless one.
  int rod_index() const { return model.body(spec.name_of("rod")); }
  int block_index() const { return model.body("block"); }

  /// The angle of its crank, free or by the clock of `crank`.
  CrankAngle crank_angle(const SliderCrank& crank) const;

  /// The bore's axis is that of the liner's grid; without one it is over the mean of the named
  /// bearings and concentric with the skirt.
  CylinderAxes axes() const;
};

}  // namespace clatter::dynamics
