// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/geometry/part_geometry.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "mesh/geometry/block_geometry.hpp"
#include "mesh/geometry/cad_geometry.hpp"
#include "mesh/geometry/piston_geometry.hpp"
#include "mesh/geometry/primitive_geometry.hpp"
#include "mesh/geometry/rod_geometry.hpp"

namespace clatter::mesh {

LengthUnit read_length_unit(const Config& config) {
  const std::string name = config.choice("length_unit", {"mm", "m", "cm", "in"});
  if (name == "m") return {name, 1.0};
  if (name == "cm") return {name, 1e-2};
  if (name == "in") return {name, 25.4e-3};
  return {name, 1e-3};
}

PartGeometry build_part(GmshSession& session, const Config& config, const CadChange& change) {
  const std::string kind = config.text("kind");
  PartGeometry part;
  if (kind == "block") {
    part = build_block(session, read_block(config.table(kind)));
  } else if (kind == "piston") {
    part = build_piston(session, read_piston(config.table(kind)));
  } else if (kind == "rod") {
    part = build_rod(session, read_rod(config.table(kind)));
  } else if (kind == "box") {
    part = build_box(session, config.table(kind));
  } else if (kind == "cylinder") {
    part = build_cylinder(session, config.table(kind));
  } else if (kind == "cad") {
    part = build_cad(session, config.table(kind), read_length_unit(config).name, change);
  } else {
    config.fail("kind",
                fmt::format("found '{}', expected block, piston, rod, box, cylinder or cad", kind));
  }
  part.unit = read_length_unit(config).name;
  const auto own = read_named_surfaces(config);
  part.surfaces.insert(part.surfaces.end(), own.begin(), own.end());
  return part;
}

Solid require_one(const Solids& solids, const std::string& what) {
  if (solids.size() != 1) {
    throw NumericsError(fmt::format("{}: found {} separate solids, expected one connected solid",
                                    what, solids.size()));
  }
  return solids.front();
}

}  // namespace clatter::mesh
