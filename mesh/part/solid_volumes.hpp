#pragma once
// Whether each solid of an assembly came through the joining of its faces whole, by its mesh.
#include <string>

#include "core/mesh/mesh.hpp"
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Checks each of `part.cad_solids` whose OpenCASCADE volume moved by more than 1e-6 when it was
/// joined with its neighbours. The integral may have moved alone: OpenCASCADE takes a fixed number
/// of points on splines of any length. So the mesh judges:
///
///   |V_mesh - V_as_read| <= chords + part.volume_tolerance V_as_read,
///   chords = sum over the solid's cells |V_curved - V_straight|,
///
/// the difference between tet10 and the tetrahedra through their corners, which is more than what
/// quadratic faces are off the geometry. A solid that passes is told by say(). NumericsError,
/// beginning with `where`, names the solid by its name in the file, number and place, with all
/// volumes in mm3, and what can be done.
void check_solid_volumes(const PartGeometry& part, const Mesh& mesh, double metres_per_unit,
                         const std::string& where);

}  // namespace clatter::mesh
