// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts from STEP, BREP or IGES files.
#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// [cad] source = file, region = name (default "solid"), expected_box = [dx, dy, dz] (optional: the
/// part's size within 1 %, guards against a wrong unit, hard case G6), volume_tolerance (of each of
/// several solids against its mesh, default 1e-6: solid_volumes.hpp), defeature_below = width
/// (optional, part's unit: narrower faces are removed, gmsh_defeature.hpp), join_within = distance
/// (optional, part's unit: faces of different solids that are nearer become one). Several solids
/// are joined at shared faces; each is a region of its own, NAME_1, NAME_2, ... ordered by centre
/// of mass.
PartGeometry build_cad(GmshSession& session, const Config& table, const std::string& unit,
                       const CadChange& change = {});

}  // namespace clatter::mesh
