// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Which process does how much of a factorisation over several.
#include <cstdint>
#include <vector>

#include "core/sparse/factor/front_sizes.hpp"

namespace clatter::sparse {

/// What one rank does and holds.
struct RankLoad {
  double flops = 0.0;
  double entries = 0.0;  // of L
  double peak = 0.0;     // largest number of doubles at once: entries of L, fronts, update matrices
  double sent = 0.0;     // doubles sent to other ranks
};

/// Maps subtrees to ranks, the largest to the rank with the least work (Geist and Ng 1989), and
/// shares each front above them among the ranks, where it has enough rows for that, as MUMPS does
/// (Amestoy, Duff, L'Excellent and Koster 2001): fronts of few rows go to one rank, larger ones
/// have their rows divided. Update matrices are squares. Sent: update matrices to the ranks of the
/// parent, and of shared fronts the eliminated columns to the ranks below. MUMPS decides while it
/// works; docs/accuracy.md has its counts beside these.
std::vector<RankLoad> map_to_ranks(const FrontSizes& fronts, int ranks);

}  // namespace clatter::sparse
