// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What all pads of a piston-liner contact have in common, and a state at which they are evaluated.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/element/element.hpp"
#include "dynamics/film/axial_motion.hpp"
#include "dynamics/film/gap_map.hpp"
#include "dynamics/film/piston_liner_options.hpp"

namespace clatter::film {

/// Options, bodies and laws of one contact; what is absent is off.
struct ContactModel {
  /// Completes the options: a film without cavitation is full, ends that are not given are those of
  /// the liner's patches, the clearance follows from that of the warm surfaces. InputError for
  /// parameters out of range, or unless there are `size` coordinates (PistonLinerBodies) without
  /// that of a free crank.
  ContactModel(PistonLinerOptions given, PistonLinerBodies given_bodies, int size);

  PistonLinerOptions options;
  PistonLinerBodies bodies;
  ContactCoordinates at;
  AxialMotion axial;
  Eigen::VectorXd height_by_y;  // of the pads, n_e
  std::optional<RoughFilm> rough;
  std::optional<Viscosity> viscosity;
  std::optional<Asperity> asperity;
  std::optional<ContactDamping> damping;
  std::vector<Recess> recesses;  // pressures are reduced ones (Viscosity)

  /// Engine z of a pad's z = 0 when the pin is at `position` [m], or its rate when both are rates.
  double height(double position, const Eigen::VectorXd& y) const;

 private:
  void check() const;
  void complete_oil();
  void complete_shape();
};

/// One state of the bodies; valid for one evaluation.
struct PadState {
  const dynamics::Stage& stage;
  PinStroke pin;
  double slide_by_turn;  // of the ideal pin's velocity by the coordinate of a free crank [m/s]
  double height, height_rate;  // of the pads' z = 0 along the liner [m], [m/s]
  double travel;               // since the start of the step [m]; for a layer on the liner
  const std::vector<ScaleState>& scales;  // of the shapes that have a factor
  const Eigen::VectorXd &y, &v;           // n_e
};

}  // namespace clatter::film
