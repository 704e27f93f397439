// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Simple shapes for samples and tests.
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// [box] size = [lx, ly, lz], origin = corner (default 0). Surfaces x_min, x_max, y_min, ... z_max.
PartGeometry build_box(GmshSession& session, const Config& table);

/// [cylinder] radius, length, inner_radius (0: solid), axis z from the origin. Surfaces bottom,
/// top, outer, and inner of a hollow one.
PartGeometry build_cylinder(GmshSession& session, const Config& table);

}  // namespace clatter::mesh
