#pragma once
// Which parts of a tree of supernodes run side by side.
#include <vector>

#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {

/// Disjoint subtrees for the threads, and the top that joins them (Geist and Ng 1989).
struct TreeSchedule {
  std::vector<int32_t> subtrees;  // their roots, the most work first
  std::vector<int32_t> lowest;    // of every supernode: the first of its subtree, which is
                                  // lowest[s] .. s
  std::vector<int32_t> top;       // the other supernodes, ascending
};

/// @param threads one: everything is top.
/// @param work of each supernode.
/// @param share largest subtree, in parts of a thread's work.
TreeSchedule schedule(const SupernodeTree& tree, int threads, std::vector<double> work,
                      double share);

/// For the factorisation: by flops.
TreeSchedule schedule(const SupernodeTree& tree, int threads);

}  // namespace clatter::sparse
