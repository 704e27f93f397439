// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The model of a scene: bodies, elements, loads, and reported quantities.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/film/piston_liner.hpp"
#include "dynamics/force/history.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/integrate/integrator.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/run/model_elements.hpp"
#include "dynamics/scene/effects.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

struct Model {
  System system;
  std::optional<SliderCrank> crank;
  std::optional<Spline> gas;  // absolute pressure over the crank angle [Pa]
  EffectTable effects;
  const film::PistonLiner* contact = nullptr;  // owned by `system`
  int pin_y = -1, pin_rx = -1;                 // y indices
  std::optional<LinerFit> liner;

  /// Histories of an accepted state: piston_lateral [m] and piston_tilt [rad] against the liner,
  /// gas_pressure [Pa], then those of the elements.
  void record(const StageState& state, History& history) const;
  /// (lateral [m], tilt [rad]) of the piston against the liner.
  Eigen::Vector2d secondary_motion(double time, const Eigen::VectorXd& y) const;
};

/// Builds a new model from the data read; cheap compared with load_bodies. InputError for names
/// that are not in a reduced model and for inconsistent geometry.
std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& loaded);

}  // namespace clatter::dynamics
