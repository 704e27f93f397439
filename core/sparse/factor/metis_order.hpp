// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Nested dissection by METIS.
#include <cstdint>
#include <vector>

#include "core/sparse/factor/ordering.hpp"

namespace clatter::sparse {

/// Fill-reducing permutation of a graph (Karypis and Kumar 1998), always with the same seed; empty
/// when METIS fails or is out of memory. The graph's entries must fit 32 bits (safe_ordering).
std::vector<int32_t> nested_dissection(const CompressedGraph& graph);

}  // namespace clatter::sparse
