// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The rigid slices of a shaft.
#include <string>
#include <vector>

#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {

/// A rigid slice of shaft with the discs on it. Beams are clamped to it at the station.
struct ShaftStation {
  std::string name;     // of its body, after that of the shaft
  double at = 0.0;      // along the axis [m]
  double centre = 0.0;  // of mass, along the axis [m]
  /// Of the slice and its discs; the polar moment without discs that turn on the shaft.
  DiscInertia inertia;
  std::vector<size_t> discs, bearings;  // of the spec, at this station
};

/// The stations of a shaft in ascending order: at discs and bearings and, where one of `slices`
/// equal slices has none of these, at its centre. What lies between two stations belongs to the
/// nearer one, ends to the last one; mass, centre and moments of all are those of the shaft.
/// Frequencies converge with the square of the slices' length.
std::vector<ShaftStation> shaft_stations(const ShaftSpec& shaft);

/// Index of the station of a disc or bearing.
size_t station_of_disc(const std::vector<ShaftStation>& stations, size_t disc);
size_t station_of_bearing(const std::vector<ShaftStation>& stations, size_t bearing);

}  // namespace clatter::dynamics
