// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The main bearings of a crankshaft in a model.
#include <vector>

#include "dynamics/component/model_builder.hpp"
#include "dynamics/crank/crank_spec.hpp"

namespace clatter::dynamics {

/// Where a journal is in its bearing: displacements of both, for histories.
struct BearingOrbit {
  std::string name;         // of the element
  double arm = 0.0;         // of the bearing along x from the crank's centre of mass [m]
  int block[2] = {-1, -1};  // y indices of y, z of the block there; -1: at rest
};

/// Adds the element of each bearing between the crankshaft's body and the block; without an elastic
/// block, the ground. Where a set of the block has no rotations, moments act on the block's rigid
/// frame. InputError for sets that the block lacks and for bearings beside the axis.
std::vector<BearingOrbit> add_crank_bearings(const CrankSpec& crank, ModelBuilder& model);

/// y indices of y, z, ry, rz and, of a free crank, rx of the crankshaft.
std::vector<int> crank_coordinates(const CrankBody& crank, ModelBuilder& model);

}  // namespace clatter::dynamics
