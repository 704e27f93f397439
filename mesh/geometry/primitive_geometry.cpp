// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/primitive_geometry.hpp"

#include <array>

#include "mesh/geometry/length_row.hpp"

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

NamedSurface cylinder_surface(const std::string& name, double radius) {
  SurfaceFilter filter;
  filter.cylinder = CylinderFilter{radius, Vector3d::Zero(), Vector3d::UnitZ()};
  return {name, {filter}};
}

}  // namespace

const keys::Keys<BoxParameters>& box_part_keys() {
  static const keys::Keys<BoxParameters> keys(
      "box", "a box along the axes", [](auto& key, BoxParameters& p) {
        key.vector("size", p.size, Range::positive(), "size along x, y and z")
            .required()
            .shown_in("length_unit");
        key.vector("origin", p.origin, {}, "its lower corner").shown_in("length_unit");
        key.text("region", p.region, "name of the region");
      });
  return keys;
}

const keys::Keys<CylinderParameters>& cylinder_part_keys() {
  static const keys::Keys<CylinderParameters> keys(
      "cylinder", "a cylinder or tube along z", [](auto& key, CylinderParameters& p) {
        length(key, "radius", p.radius, "outer radius").required();
        length(key, "length", p.length, "length from z = 0 up").required();
        key.number("inner_radius", p.inner_radius, Range::not_negative(),
                   "inner radius of a tube, 0 for none")
            .shown_in("length_unit");
        key.text("region", p.region, "name of the region");
        key.check([](const Config& table, CylinderParameters& c) {
          if (c.inner_radius >= c.radius) table.fail("inner_radius", "expected less than radius");
        });
      });
  return keys;
}

PartGeometry build_box(GmshSession& session, const BoxParameters& p) {
  const Vector3d min = p.origin, max = min + p.size;
  PartGeometry part;
  part.regions.push_back({p.region, {session.box(min, max)}});
  const std::array<std::string, 3> letters = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d) {
    part.surfaces.push_back(in_plane(letters[d] + "_min", Vector3d::Unit(d), min[d]));
    part.surfaces.push_back(in_plane(letters[d] + "_max", Vector3d::Unit(d), max[d]));
  }
  return part;
}

PartGeometry build_cylinder(GmshSession& session, const CylinderParameters& p) {
  const double radius = p.radius, length = p.length, inner = p.inner_radius;
  const Vector3d axis(0.0, 0.0, length);
  Solids solids = {session.cylinder(Vector3d::Zero(), axis, radius)};
  PartGeometry part;
  part.surfaces = {in_plane("bottom", Vector3d::UnitZ(), 0.0),
                   in_plane("top", Vector3d::UnitZ(), length), cylinder_surface("outer", radius)};
  if (inner > 0.0) {
    solids = session.cut(solids, {session.cylinder(Vector3d::Zero(), axis, inner)});
    part.surfaces.push_back(cylinder_surface("inner", inner));
  }
  part.regions.push_back({p.region, {require_one(solids, "cylinder")}});
  return part;
}

}  // namespace clatter::mesh
