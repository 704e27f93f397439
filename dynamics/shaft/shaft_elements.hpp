// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The elements of a shaft between its bodies.
#include <memory>
#include <vector>

#include "dynamics/component/model_builder.hpp"
#include "dynamics/shaft/disc_port.hpp"
#include "dynamics/shaft/shaft_lumps.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {

/// A DoF of a body of the system.
struct BodyDof {
  int body = 0, dof = 0;
};

/// A shaft in a system: its stations and their bodies.
struct ShaftBodies {
  std::vector<ShaftStation> stations;
  std::vector<int> body;   // of each station; all the same one where the shaft is rigid
  std::vector<int> wheel;  // of each disc that turns on the shaft, else -1
  bool bends = false;      // six coordinates a station, else the angle
  /// The angle of a station or disc.
  BodyDof station_angle(const ShaftSpec& shaft, size_t station) const;
  BodyDof disc_angle(const ShaftSpec& shaft, size_t disc) const;
  /// The coordinates of a port: of the station, with the given angle.
  std::vector<BodyDof> coordinates(const ShaftSpec& shaft, size_t station,
                                   const BodyDof& angle) const;
};

/// Adds beams or torsion springs, gyroscopic moments, phasers, bearings. InputError for housings
/// that are not on the axis.
void add_shaft_elements(const ShaftSpec& shaft, const ShaftBodies& bodies, ModelBuilder& model);

/// The port of a point, given in the scene's axes at the start.
std::unique_ptr<DiscPort> shaft_port(const ShaftSpec& shaft, double mass_centre,
                                     const std::vector<BodyDof>& coordinates, System& system,
                                     const Eigen::Vector3d& at);

}  // namespace clatter::dynamics
