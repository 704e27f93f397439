#pragma once
// A scene made ready to run: bodies, elements, loads, and what is reported of them.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/bodies.hpp"
#include "dynamics/crank.hpp"
#include "dynamics/effects.hpp"
#include "dynamics/film/piston_liner.hpp"
#include "dynamics/history.hpp"
#include "dynamics/integrate/dirk.hpp"
#include "dynamics/scene.hpp"
#include "dynamics/spline.hpp"
#include "dynamics/system.hpp"

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
  /// gas_pressure [Pa], then what the elements report.
  void record(const StageState& state, History& history) const;
  /// (lateral [m], tilt [rad]) of the piston against the liner.
  Eigen::Vector2d secondary_motion(double time, const Eigen::VectorXd& y) const;
};

/// Builds everything anew from what was read; cheap beside load_bodies. InputError for names that a
/// reduced model does not hold and for geometry that does not fit.
std::unique_ptr<Model> build_model(const Scene& scene, const LoadedBodies& bodies);

}  // namespace clatter::dynamics
