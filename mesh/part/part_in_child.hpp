// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A part's geometry and mesh, made by Gmsh in a child process, and again with simpler settings when
// Gmsh crashes.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/child_process.hpp"
#include "core/base/stopwatch.hpp"
#include "mesh/part/part_file.hpp"

namespace clatter::mesh {

/// The part to build.
struct PartJob {
  const PartFile* part = nullptr;
  std::string where;               // prefix of messages: the description's path
  std::string cad_extension;       // ".step" or ".brep": write the geometry too; empty: no
  double element_size = 0.0;       // overrides the description's [m]; 0: does not
  bool accept_poor_cells = false;  // overrides the description's, when true
};

struct MadePart {
  PartMesh part;
  std::vector<StepClock::Step> steps;  // duration of each step
  std::string cad;                     // content of the geometry file, if requested
  std::string refusal;                 // instead of all these: why there is no valid mesh
};

/// Builds and meshes the part; identical to the result without a child process.
///
/// When Gmsh crashes, exits or throws while meshing, one simpler setting is tried with a warning:
/// without `elements_per_turn` if that was set, else with MeshAdapt on the faces; the certificate's
/// `simpler_setting` is then 1 or 2, else 0. NumericsError in one line, with what Gmsh was doing
/// and with which sizes, when that fails too, when Gmsh crashes while it builds the geometry, and
/// at a limit of time (both attempts together) or memory; and when the mesh is not valid or its
/// cells are too poor (poor_cells.hpp). Advice in it has been tried (remedies.hpp), for as long as
/// the refused mesh took, half a minute at least. Other errors as of build_part().
MadePart make_part_in_child(const PartJob& job, const ChildLimits& limits);

}  // namespace clatter::mesh
