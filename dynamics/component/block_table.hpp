// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table [block] of a scene.
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/component/loaded_body.hpp"

namespace clatter::dynamics {

/// Where a cylinder is on the block: keys of [block], or of its own [cylinder.block].
struct BoreSpec {
  std::string liner = "liner";        // contact grid of the bore
  std::string liner_axial;            // set of its mean axial displacement; empty: rigid frame
  std::vector<std::string> bearings;  // main bearings next to the crank; empty: rigid frame
  std::string gas_load;               // unit load on the head, per Pa; empty: none
};
const keys::Keys<BoreSpec>& bore_keys();

struct BlockTable {
  BodySpec body;
  BoreSpec bore;
};
const keys::Keys<BlockTable>& block_keys();

/// The scene has a block that is a body.
bool has_elastic_block(const Config& root);

}  // namespace clatter::dynamics
