#pragma once
// A part's geometry and mesh, made by Gmsh in a child process, and once more in a simpler way where
// Gmsh does not survive the first.
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/child_process.hpp"
#include "core/base/config.hpp"
#include "core/base/stopwatch.hpp"
#include "mesh/geometry/part_geometry.hpp"
#include "mesh/part/mesher.hpp"

namespace clatter::mesh {

/// What is to be made.
struct PartJob {
  const Config* config = nullptr;  // of the part; read in the child
  std::string name, where;         // of the part; what begins messages: the description's file
  std::string cad_extension;       // ".step" or ".brep": the geometry is wanted too; empty: not
  double element_size = 0.0;       // goes before the description's [m]; 0: as it says
};

struct MadePart {
  PartMesh part;
  std::string config;                  // Config::resolved()
  std::vector<StepClock::Step> steps;  // what took how long
  std::string cad;                     // content of the geometry's file, where it was asked for
};

/// Builds the part, checks that its description holds no unknown key, and meshes it; the same bits
/// as without a child process.
///
/// Where Gmsh crashes, exits or throws while it meshes, one simpler setting is tried and told as a
/// warning: without `elements_per_turn` where that was asked for, else with MeshAdapt on the faces;
/// the certificate's `simpler_setting` is then 1 or 2, else 0. NumericsError in one line, with what
/// Gmsh was at and with which sizes, when that fails too, when Gmsh falls while it builds the
/// geometry, and at a limit of time (both attempts together) or memory. Errors as of build_part()
/// and mesh_part().
MadePart make_part_in_child(const PartJob& job, const ChildLimits& limits);

}  // namespace clatter::mesh
