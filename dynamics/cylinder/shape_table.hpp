// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Warm, bolted, worn shapes of bore and skirt: [[contact.bore_shape]] and [[contact.skirt_shape]].
#include <filesystem>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/cylinder/shape_scale.hpp"
#include "dynamics/film/gap.hpp"

namespace clatter::dynamics {

/// Shapes that are added to a surface, and the files in which they are.
struct SurfaceShapes {
  std::vector<film::LinerShape> shapes;
  std::vector<ScaledShapeSpec> scaled;  // those with a factor over the cycle
  std::vector<std::filesystem::path> files;
};

/// Reads all entries of `contact`.key: a case of a shape file, columns of a table by angle, or an
/// order around with amplitudes along the height, with or without a factor over the crank angle.
/// InputError "file:line: key: ...".
SurfaceShapes read_surface_shapes(const Config& contact, const char* key);

}  // namespace clatter::dynamics
