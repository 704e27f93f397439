#pragma once
// The geometry of a part as built or imported: solids by region, surfaces by where they lie.
#include <string>
#include <vector>

#include "core/config.hpp"
#include "mesh/gmsh_session.hpp"
#include "mesh/select.hpp"

namespace clatter::mesh {

struct RegionSolids {
  std::string name;
  Solids solids;
};

struct PartGeometry {
  std::vector<RegionSolids> regions;
  std::vector<NamedSurface> surfaces;
  std::string unit = "mm";  // of its lengths, for messages
};

/// A length unit in metres: "mm", "cm", "m" or "in" (key `length_unit`, default "mm").
struct LengthUnit {
  std::string name = "mm";
  double metres = 1e-3;
};
LengthUnit read_length_unit(const Config& config);

/// Builds what key `kind` names ("block", "piston", "box", "cylinder", "cad") from the table of the
/// same name, and adds the user's own surfaces [surface.NAME].
PartGeometry build_part(GmshSession& session, const Config& config);

/// One solid or NumericsError: a boolean of connected shapes that leaves more has failed.
Solid require_one(const Solids& solids, const std::string& what);

}  // namespace clatter::mesh
