// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parallel schedule of a supernode tree.
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// Disjoint subtrees for the threads, and the top of the tree above them (Geist and Ng 1989).
struct TreeSchedule {
  std::vector<int32_t> subtrees;  // their roots, largest work first
  std::vector<int32_t> lowest;    // first supernode of each subtree, which is
                                  // lowest[s] .. s
  std::vector<int32_t> top;       // the other supernodes, ascending
};

/// @param threads 1: everything is top.
/// @param work of each supernode.
/// @param share largest subtree, as a fraction of a thread's work.
TreeSchedule schedule(const SupernodeTree& tree, int threads, std::vector<double> work,
                      double share);

/// For the factorisation: work in flops.
TreeSchedule schedule(const SupernodeTree& tree, int threads);

}  // namespace clatter::sparse
