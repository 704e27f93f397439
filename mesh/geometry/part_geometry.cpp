// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/part_geometry.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace clatter::mesh {

NamedSurface in_plane(const std::string& name, const Eigen::Vector3d& normal, double height,
                      const BoxFilter& box) {
  SurfaceFilter filter;
  filter.plane = PlaneFilter{normal, height};
  filter.box = box;
  return {name, {filter}};
}

Solid require_one(const Solids& solids, const std::string& what) {
  if (solids.size() != 1) {
    throw NumericsError(fmt::format("{}: found {} separate solids, expected one connected solid",
                                    what, solids.size()));
  }
  return solids.front();
}

}  // namespace clatter::mesh
