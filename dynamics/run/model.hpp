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
#include "dynamics/integrate/dirk.hpp"
#include "dynamics/integrate/system.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/scene/effects.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Position of the liner as a rigid motion fitted to its patches.
struct LinerFit {
  std::vector<int> coordinates;  // y indices of the patches
  Eigen::MatrixXd rigid_motion;  // 2 x patches: (y at the crank axis, rotation about x)
};

struct Model {
  System system;
  std::optional<SliderCrank> crank;
  std::optional<Spline> gas;  // absolute pressure over the crank angle [Pa]
  double ambient = 0.0;       // [Pa]
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
std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& bodies);

}  // namespace clatter::dynamics
