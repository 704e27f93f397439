// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace clatter::mesh {

/// A face with a name as it is in a file: tags of Gmsh do not survive booleans.
struct NamedFace {
  std::string name;
  double area = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  // of the area
  double polar = 0.0;                                // trace of the area's inertia about it
};

/// The faces of a STEP file whose ADVANCED_FACE has a name, at all places where an assembly has
/// them; "NONE" is the name of no face. Lengths in `unit`, one of OpenCASCADE: "MM", "M", ... Gmsh
/// reads such names of assemblies alone. NumericsError where OpenCASCADE fails.
std::vector<NamedFace> named_faces_of_step(const std::filesystem::path& path,
                                           const std::string& unit);

}  // namespace clatter::mesh
