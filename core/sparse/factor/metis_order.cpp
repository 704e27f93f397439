// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/metis_order.hpp"

#include <metis.h>

#include <memory>
#include <new>

namespace clatter::sparse {
namespace {

static_assert(IDXTYPEWIDTH == 32, "Debian's METIS has 32-bit indices");

/// METIS may abort when memory runs out; allocating its workspace first detects that.
bool memory_for_metis(const CompressedGraph& graph) {
  const size_t bytes = 8 * sizeof(idx_t) * (graph.neighbours.size() + 8 * graph.weight.size());
  return std::unique_ptr<char[]>(new (std::nothrow) char[bytes]) != nullptr;
}

}  // namespace

std::vector<int32_t> nested_dissection(const CompressedGraph& graph) {
  if (!memory_for_metis(graph)) return {};
  std::vector<idx_t> starts(graph.starts.begin(), graph.starts.end());
  std::vector<idx_t> neighbours = graph.neighbours, weight = graph.weight;
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = 1;
  idx_t size = graph.size();
  std::vector<idx_t> at(static_cast<size_t>(size)), inverse(static_cast<size_t>(size));
  const int status = METIS_NodeND(&size, starts.data(), neighbours.data(), weight.data(), options,
                                  at.data(), inverse.data());
  if (status != METIS_OK) at.clear();
  return at;
}

}  // namespace clatter::sparse
