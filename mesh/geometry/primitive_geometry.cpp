// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/primitive_geometry.hpp"

#include <array>

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

NamedSurface plane_surface(const std::string& name, const Vector3d& normal, double height) {
  SurfaceFilter filter;
  filter.plane = PlaneFilter{normal, height};
  return {name, {filter}};
}

NamedSurface cylinder_surface(const std::string& name, double radius) {
  SurfaceFilter filter;
  filter.cylinder = CylinderFilter{radius, Vector3d::Zero(), Vector3d::UnitZ()};
  return {name, {filter}};
}

}  // namespace

PartGeometry build_box(GmshSession& session, const Config& table) {
  const std::vector<double> size = table.numbers("size", 3);
  const std::vector<double> origin = table.numbers_or("origin", {0.0, 0.0, 0.0});
  if (origin.size() != 3) table.fail("origin", "expected 3 numbers");
  if (!(size[0] > 0.0 && size[1] > 0.0 && size[2] > 0.0)) {
    table.fail("size", "expected three lengths > 0");
  }
  const Vector3d min(origin[0], origin[1], origin[2]);
  const Vector3d max = min + Vector3d(size[0], size[1], size[2]);
  PartGeometry part;
  part.regions.push_back({table.text_or("region", "solid"), {session.box(min, max)}});
  const std::array<std::string, 3> letters = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d) {
    part.surfaces.push_back(plane_surface(letters[d] + "_min", Vector3d::Unit(d), min[d]));
    part.surfaces.push_back(plane_surface(letters[d] + "_max", Vector3d::Unit(d), max[d]));
  }
  return part;
}

PartGeometry build_cylinder(GmshSession& session, const Config& table) {
  const double radius = table.number("radius", Range::positive());
  const double length = table.number("length", Range::positive());
  const double inner = table.number_or("inner_radius", 0.0, Range::not_negative());
  if (inner >= radius) table.fail("inner_radius", "expected less than radius");
  const Vector3d axis(0.0, 0.0, length);
  Solids solids = {session.cylinder(Vector3d::Zero(), axis, radius)};
  PartGeometry part;
  part.surfaces = {plane_surface("bottom", Vector3d::UnitZ(), 0.0),
                   plane_surface("top", Vector3d::UnitZ(), length),
                   cylinder_surface("outer", radius)};
  if (inner > 0.0) {
    solids = session.cut(solids, {session.cylinder(Vector3d::Zero(), axis, inner)});
    part.surfaces.push_back(cylinder_surface("inner", inner));
  }
  part.regions.push_back({table.text_or("region", "solid"), {require_one(solids, "cylinder")}});
  return part;
}

}  // namespace clatter::mesh
