// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Substructures of a nested dissection: the blocks of unknowns with their own modes in AMLS.
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// A leaf (a complete subtree) or a separator, as consecutive supernodes, with its subtree.
struct Substructure {
  int32_t from = 0, to = 0;  // own supernodes [from, to)
  int32_t lowest = 0;        // its subtree is supernodes [lowest, to)
  int32_t first_inside = 0;  // its subtree is substructures [first_inside, itself]
};

struct PartitionLimits {
  int32_t leaf = 1500;      // largest number of unknowns of a leaf
  int32_t separator = 300;  // separators are merged with the one above up to this size
};

/// Splits a tree; every supernode is in one substructure, subtrees come before their separator.
std::vector<Substructure> partition(const SupernodeTree& tree, const PartitionLimits& limits = {});

}  // namespace clatter::sparse
