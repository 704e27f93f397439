// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Meshes of two parts in contact without common nodes.
#include <Eigen/Core>
#include <array>

#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly::testing {

/// Both meshes in one: regions "a" and "b", surfaces and node sets "a_z1", "b_z0", ...
mesh::Mesh two_parts(const mesh::Mesh& a, const mesh::Mesh& b);

/// A block of `length` x 1 x 1 m from z = `bottom` on, cut into n bricks of the type. Nodes within
/// are moved sideways by up to `shake` of a brick, also on top and bottom faces; sides stay flat.
mesh::Mesh slab(mesh::CellType type, const std::array<int, 3>& n, double shake, double bottom = 0.0,
                double length = 1.0);

/// The lowest frequencies [Hz] of a free model, dense, rigid motions first.
Eigen::VectorXd free_hz(const fe::FeModel& model, int count);

}  // namespace clatter::assembly::testing
