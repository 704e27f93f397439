#pragma once
// What is proved of a finished mesh, whether gmsh made it or a deck brought it.
#include <map>
#include <string>

#include "core/mesh/mesh.hpp"
#include "mesh/repair/quality.hpp"

namespace clatter::mesh {

/// Counts, volume, closed and outward boundary, extremes of quality. NumericsError when the skin is
/// not closed and outward: V = (1/3) closed integral of x . n dS must be the cells' volume, the
/// closed integral of n dS zero, and every normal point out of its cell (hard cases G4, G9).
std::map<std::string, double> certify_mesh(const Mesh& mesh, const QualityReport& quality);

}  // namespace clatter::mesh
