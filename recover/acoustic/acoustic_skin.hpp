// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The acoustic skin: a closed surface of regular triangles around a body.
#include <algorithm>
#include <optional>

#include "core/rom/reduced_model.hpp"
#include "core/sound/surface.hpp"

namespace clatter::recover {

/// How fine the acoustic skin is, and what it closes.
struct AcousticMesh {
  std::optional<double> opening;      // holes up to this diameter are closed [m]
  double edges_per_wavelength = 5.0;  // at the highest frequency
  double shape_error = 0.02;          // largest of the shape, by shape_difference()
  int most_faces = 20000;             // matrices take 16 (most_faces / 2)^2 bytes

  /// 0.12 m, of smaller bodies a third of their size, where none is given.
  double opening_for(double size) const { return opening.value_or(std::min(0.12, size / 3.0)); }
};

/// A closed surface, and how far its shape is from that of the body.
struct AcousticSkin {
  sound::Surface surface;
  double opening = 0.0;      // [m]
  double shape_error = 0.0;  // from the wrap before its triangles were made regular
};

/// What two closed surfaces differ in as bodies that displace air: of their volumes, and of those
/// of spheres with their areas (thin bodies take air along by their area), the larger difference
/// over the volume of the sphere. The sound power of a slow rigid motion goes with its square.
double shape_difference(const sound::Surface& one, const sound::Surface& exact);

/// Wraps the skin of a body. The edges are shortened until the mesh resolves `to_hz` and the shape.
/// @param skin of quadratic triangles, each taken as four flat ones
/// @throws InputError for a body without a skin, one smaller than the opening, or one with wider
/// holes
/// @throws NumericsError when `most_faces` do not suffice
AcousticSkin acoustic_skin(const rom::Skin& skin, const AcousticMesh& mesh, double sound_speed,
                           double to_hz);

}  // namespace clatter::recover
