#pragma once
// Nested dissection by METIS.
#include <cstdint>
#include <vector>

#include "core/sparse/factor/ordering.hpp"

namespace clatter::sparse {

/// Vertices of a graph in a fill-reducing order (Karypis and Kumar 1998), always from the same
/// seed; empty when METIS fails or has no memory. The graph's entries must fit 32 bits
/// (safe_ordering).
std::vector<int32_t> nested_dissection(const CompressedGraph& graph);

}  // namespace clatter::sparse
