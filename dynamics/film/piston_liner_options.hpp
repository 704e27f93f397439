// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Options of one piston-liner contact.
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/element/crank_angle.hpp"
#include "dynamics/film/asperity.hpp"
#include "dynamics/film/contact_damping.hpp"
#include "dynamics/film/cover.hpp"
#include "dynamics/film/cycle_scale.hpp"
#include "dynamics/film/friction.hpp"
#include "dynamics/film/gap.hpp"
#include "dynamics/film/liner_layer.hpp"
#include "dynamics/film/recess.hpp"
#include "dynamics/film/reynolds.hpp"
#include "dynamics/film/roughness.hpp"
#include "dynamics/film/stroke_steps.hpp"
#include "dynamics/film/viscosity.hpp"
#include "dynamics/film/warm_clearance.hpp"

namespace clatter::film {

/// Effects of the contact; one that is off allocates and computes nothing.
struct ContactEffects {
  bool film = true;        // oil film; off ("lubrication = none"): dry, asperity contact only
  bool cavitation = true;  // mass-conserving JFO; off: every cell full, pressure unrestricted
  bool asperities = true;  // asperity pressure, eq. (12)
  bool friction = true;    // film shear and contact friction along the stroke
};

/// Which part of the skirt has a gap: two pads, on the thrust side (around +y) and the anti-thrust
/// side (around -y), between which no oil passes; or all of it, one film closed around.
enum class SkirtSpan { kPads, kWhole };

/// Parameters with their defaults.
struct PistonLinerOptions {
  std::string name = "piston_liner";
  ContactEffects effects;

  double bore_radius = 53.5e-3;  // [m]
  double clearance = 20e-6;  // radial, of the surfaces to which shapes are added, where the skirt
                             // is widest [m], >= 0
  /// In the place of `clearance`, which then follows from it and may be negative.
  std::optional<WarmClearance> warm_clearance;
  double skirt_bottom = -45e-3;  // lower end of the pads, z from the pin centre [m]
  double skirt_top = 25e-3;      // upper end of the pads, z from the pin centre [m]
  SkirtSpan span = SkirtSpan::kPads;
  double pad_span = 80.0 * std::numbers::pi / 180.0;  // angle that each pad covers [rad], up to pi
  int cells_around = 10;  // cells of a pad, or of the entire skirt, along the circumference
  int cells_along = 40;   // cells along the axis
  SkirtShape skirt;
  std::optional<LinerShape> bore;  // deviation of the liner at rest; absent: a cylinder
  /// Added to that deviation, and to the skirt outward: heights are engine z, and z from the pin.
  std::vector<LinerShape> bore_shapes, skirt_shapes;
  std::vector<ScaledShape> scaled_bore, scaled_skirt;  // the same times a factor in the cycle
  std::vector<Recess> recesses;  // grooves and windows; pressures of grooves in Pa
  LinerEnds
      ends;  // of the liner; infinite: those of an elastic liner's patches, a rigid one has none

  double viscosity = 0.01;    // of the oil at the liner's temperature [Pa s]
  ViscosityOptions oil;       // laws of temperature, pressure and shear; none: constant
  double bulk_modulus = 1e9;  // of the oil [Pa]; 0: incompressible
  // Without cavitation the next three do not apply: every cell is full.
  double initial_fill = 1.0;  // fraction of the gap filled with oil at the start, 0 to 1
  double supply_fill = 1.0;   // fill of the oil film entering at top and bottom of the pad, 0 to 1
  Cavity cavity = Cavity::kLayer;  // where the oil is that does not fill the gap
  /// Thickness of the oil layer that the rings and the splash leave on the liner [m], at the start
  /// and at inflow: the skirt slides into it at its full speed. Infinite: only the fills above
  /// apply.
  double oil_thickness = std::numeric_limits<double>::infinity();
  /// The layer is remembered where the skirt leaves it, `oil_thickness` only its start and what the
  /// ends of the liner bring; absent: it is renewed at every inflow. With cavitation, without
  /// supply pressure and with a supply fill of 1.
  std::optional<LinerLayerOptions> liner_layer;
  double supply_pressure = 0.0;  // gauge pressure at all edges of the pads [Pa], >= 0
  RoughnessOptions roughness{0.2e-6, 0.5e-6, 1.0, false};
  AsperityOptions asperity;
  ContactDampingOptions damping;
  FrictionOptions friction;
};

/// The bodies in contact. Coordinates of the element, in this order:
/// [piston patches | their fit | liner patches | their fit | pin x, y, z, rx, ry, rz | liner
/// axial]; absent parts have none. The fit of a surface is its rigid motion x, y, rx, ry,
/// rigid_fit() times its patches. A liner has an axial coordinate, which takes the axial reaction.
/// What is given over time is over that of the crank's clock.
struct PistonLinerBodies {
  std::optional<ElasticSurface>
      piston;  // skirt patches, frame at the pin centre; absent: rigid, moved by the pin
  std::optional<ElasticSurface> liner;  // bore patches, engine frame; absent: rigid at rest
  Eigen::Vector2d bore_axis = Eigen::Vector2d::Zero();  // (x, y) from the pin's centre [m]
  Eigen::Vector2d liner_axial =
      Eigen::Vector2d::Zero();  // (x, y) of the liner's axial coordinate from the pin's centre [m]
  std::function<StrokeState(double time)> stroke;
  dynamics::CrankAngle crank;
};

}  // namespace clatter::film
