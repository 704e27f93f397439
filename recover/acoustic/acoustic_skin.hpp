// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The acoustic skin: a closed surface of regular triangles around a body.
#include "core/rom/reduced_model.hpp"
#include "core/sound/surface.hpp"

namespace clatter::recover {

/// How fine the acoustic skin is, and what it closes.
struct AcousticMesh {
  double opening = 0.12;              // holes up to this diameter are closed [m]
  double edges_per_wavelength = 5.0;  // at the highest frequency
};

/// Wraps the skin of a body. The edges are shortened until the mesh resolves `to_hz`.
/// @param skin of quadratic triangles, each taken as four flat ones
/// @throws InputError for a body without a skin, one smaller than the opening, or one with wider
/// holes
/// @throws NumericsError when remeshing does not reach the edge length
sound::Surface acoustic_skin(const rom::Skin& skin, const AcousticMesh& mesh, double sound_speed,
                             double to_hz);

}  // namespace clatter::recover
