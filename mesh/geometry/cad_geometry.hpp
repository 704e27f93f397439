// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parts from STEP, BREP or IGES files.
#include <filesystem>
#include <optional>
#include <string>

#include "mesh/geometry/part_geometry.hpp"

namespace clatter::mesh {

/// Table [cad], in the part's unit.
struct CadParameters {
  std::filesystem::path source;
  std::string region = "solid";
  std::optional<Eigen::Vector3d> expected_box;  // size within 1 %: hard case G6
  double volume_tolerance = 1e-6;               // of each of several solids: solid_volumes.hpp
  double defeature_below = 0.0;                 // gmsh_defeature.hpp; 0: nothing is removed
  double join_within = 0.0;           // faces of different solids that are nearer become one
  std::string where_box, where_join;  // of expected_box and join_within, for messages
};
const keys::Keys<CadParameters>& cad_keys();

/// Several solids are joined at shared faces; each is a region of its own, NAME_1, NAME_2, ...
/// ordered by centre of mass.
PartGeometry build_cad(GmshSession& session, const CadParameters& p, const std::string& unit);

}  // namespace clatter::mesh
