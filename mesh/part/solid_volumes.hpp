// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Checks with the mesh that joining the faces of an assembly left each solid intact.
#include <string>

#include "core/mesh/mesh.hpp"
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Checks each of `part.cad_solids` whose OpenCASCADE volume changed by more than 1e-6 when it was
/// joined with its neighbours. The integral alone may have changed: OpenCASCADE uses a fixed number
/// of points on splines of any length. So the mesh decides:
///
///   |V_mesh - V_as_read| <= chords + part.volume_tolerance V_as_read,
///   chords = sum over the solid's cells |V_curved - V_straight|,
///
/// the difference between tet10 and the tetrahedra through their corners, which is more than the
/// distance of quadratic faces from the geometry. A solid that passes is reported by say().
/// NumericsError, beginning with `where`, gives the solid's name in the file, number and position,
/// with all volumes in mm3, and what can be done.
void check_solid_volumes(const PartGeometry& part, const Mesh& mesh, double metres_per_unit,
                         const std::string& where);

}  // namespace clatter::mesh
