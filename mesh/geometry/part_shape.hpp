// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a mesh.toml says of a part's geometry.
#include <map>
#include <string>

#include "mesh/geometry/block_geometry.hpp"
#include "mesh/geometry/cad_geometry.hpp"
#include "mesh/geometry/head_geometry.hpp"
#include "mesh/geometry/pan_geometry.hpp"
#include "mesh/geometry/piston_geometry.hpp"
#include "mesh/geometry/primitive_geometry.hpp"
#include "mesh/geometry/rod_geometry.hpp"
#include "mesh/geometry/sheet_geometry.hpp"

namespace clatter::mesh {

/// A length unit in metres: "mm", "cm", "m" or "in".
struct LengthUnit {
  std::string name = "mm";
  double metres = 1e-3;
};

/// Of the kinds that Gmsh builds, the table of `kind` is used.
struct PartShape {
  std::string kind;
  LengthUnit unit;
  BlockParameters block;
  HeadParameters head;
  PistonParameters piston;
  RodParameters rod;
  BoxParameters box;
  CylinderParameters cylinder;
  CadParameters cad;
  SheetParameters sheet;
  PanParameters pan;
  std::map<std::string, SurfaceTable> surface_tables, edge_tables;
  std::vector<NamedSurface> surfaces, edges;  // which they are
};
const keys::Keys<PartShape>& shape_keys();

/// Builds the part with its own surfaces and those of the user.
PartGeometry build_part(GmshSession& session, const PartShape& shape);

}  // namespace clatter::mesh
