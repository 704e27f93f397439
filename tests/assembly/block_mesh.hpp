// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes of bricks and rings for tests, without a mesh generator.
#include <Eigen/Core>
#include <array>
#include <functional>

#include "core/mesh/mesh.hpp"

namespace clatter::assembly::testing {

/// Maps the unit cube to the part.
using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;

struct BlockOptions {
  mesh::CellType type = mesh::CellType::kTet10;
  bool curved = false;  // mid-side nodes follow the map (true) or stay on straight edges
  bool wrap_x = false;  // x = 0 and x = 1 coincide: rings
};

/// The unit cube divided into n[0] x n[1] x n[2] bricks of one hexahedron, two wedges, six
/// tetrahedra or six pyramids each, then mapped. Surfaces: skin, x0, x1, y0, y1, z0, z1 (names of
/// the cube's sides); region "body"; node set "all".
mesh::Mesh block_mesh(const std::array<int, 3>& n, const Map& map,
                      const BlockOptions& options = {});

/// x, y, z scaled by `size`.
Map brick(const Eigen::Vector3d& size);

/// Ring about z: x is the angle, y goes from `inner` to `outer` radius, z to `height`.
Map ring(double inner, double outer, double height);

/// A brick whose inner corners are moved by fixed pseudo-random amounts of `share` of a cell;
/// sides stay flat.
Map shaken_brick(const Eigen::Vector3d& size, const std::array<int, 3>& n, double share);

}  // namespace clatter::assembly::testing
