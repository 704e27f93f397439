// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shapes of the shells of a mesh.
#include <string>

#include "core/mesh/mesh.hpp"
#include "mesh/repair/mesh_certificate.hpp"

namespace clatter::mesh {

/// One of the worst shells by some measure of ShellShape.
struct WorstShell {
  double value = -1.0;
  int32_t label = 0;         // its number
  Eigen::Vector3d position;  // its centre [m]
};

struct ShellQuality {
  int64_t quadrilaterals = 0, triangles = 0;
  WorstShell warp, jacobian, aspect;
};

/// Of a mesh with shells.
ShellQuality measure_shells(const Mesh& mesh);

/// A line for the user: how many, and the worst ones with their places.
std::string describe(const ShellQuality& quality);

void note_shells(const ShellQuality& quality, MeshCertificate& certificate);

}  // namespace clatter::mesh
