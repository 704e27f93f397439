// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/ordering.hpp"

#include <amd.h>
#include <fmt/format.h>
#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/sparse/factor/metis_order.hpp"

namespace clatter::sparse {
namespace {

/// The full pattern without the diagonal; neighbours ascend.
struct Pattern {
  std::vector<int64_t> starts;
  std::vector<int32_t> neighbours;

  explicit Pattern(const SparseMatrix& lower) {
    const auto n = static_cast<size_t>(lower.cols());
    starts.assign(n + 1, 0);
    for_each_edge(lower, [&](int row, int column) {
      ++starts[static_cast<size_t>(row) + 1];
      ++starts[static_cast<size_t>(column) + 1];
    });
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    neighbours.resize(starts[n]);
    std::vector<int64_t> next(starts.begin(), starts.end() - 1);
    for_each_edge(lower, [&](int row, int column) {
      neighbours[next[row]++] = column;
      neighbours[next[column]++] = row;
    });
  }

  template <class Body>
  static void for_each_edge(const SparseMatrix& lower, Body&& body) {
    for (int j = 0; j < lower.cols(); ++j)
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
        if (it.row() > j) body(static_cast<int>(it.row()), j);
  }

  const int32_t* begin(int32_t i) const { return neighbours.data() + starts[i]; }
  const int32_t* end(int32_t i) const {
    return neighbours.data() + starts[static_cast<size_t>(i) + 1];
  }
  int64_t degree(int32_t i) const { return end(i) - begin(i); }
};

uint64_t mixed(uint64_t x) {  // splitmix64 (Steele, Lea and Flood 2014)
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Equal for unknowns with equal neighbours, themselves included.
uint64_t closed_hash(const Pattern& pattern, int32_t i) {
  uint64_t sum = mixed(static_cast<uint64_t>(i));
  for (const int32_t* j = pattern.begin(i); j != pattern.end(i); ++j)
    sum += mixed(static_cast<uint64_t>(*j));
  return sum;
}

/// Neighbours of i without j equal those of j without i.
bool same_neighbours(const Pattern& pattern, int32_t i, int32_t j) {
  if (pattern.degree(i) != pattern.degree(j)) return false;
  if (!std::binary_search(pattern.begin(i), pattern.end(i), j)) return false;
  const int32_t *a = pattern.begin(i), *b = pattern.begin(j);
  while (true) {
    if (a != pattern.end(i) && *a == j) ++a;
    if (b != pattern.end(j) && *b == i) ++b;
    if (a == pattern.end(i) || b == pattern.end(j)) break;
    if (*a++ != *b++) return false;
  }
  return a == pattern.end(i) && b == pattern.end(j);
}

/// Numbers the vertices in the order of their first unknown.
void find_vertices(const Pattern& pattern, CompressedGraph& graph) {
  const auto n = static_cast<int32_t>(pattern.starts.size()) - 1;
  std::vector<uint64_t> hash(static_cast<size_t>(n));
  for (int32_t i = 0; i < n; ++i) hash[i] = closed_hash(pattern, i);
  graph.vertex.assign(n, -1);
  for (int32_t i = 0; i < n; ++i) {
    if (graph.vertex[i] >= 0) continue;
    const int32_t vertex = graph.size();
    graph.vertex[i] = vertex;
    graph.weight.push_back(1);
    for (const int32_t* j = pattern.begin(i); j != pattern.end(i); ++j) {
      if (*j < i || graph.vertex[*j] >= 0) continue;
      if (hash[*j] != hash[i]) continue;
      if (!same_neighbours(pattern, i, *j)) continue;
      graph.vertex[*j] = vertex;
      ++graph.weight.back();
    }
  }
}

/// Edges between vertices from those of one unknown each.
void find_edges(const Pattern& pattern, CompressedGraph& graph) {
  std::vector<int32_t> first(graph.weight.size(), -1), seen(graph.weight.size(), -1);
  for (int32_t i = 0; i < static_cast<int32_t>(graph.vertex.size()); ++i) {
    int32_t& unknown = first[graph.vertex[i]];
    if (unknown < 0) unknown = i;
  }
  graph.starts.push_back(0);
  for (int32_t v = 0; v < graph.size(); ++v) {
    const int32_t i = first[v];
    for (const int32_t* j = pattern.begin(i); j != pattern.end(i); ++j) {
      const int32_t other = graph.vertex[*j];
      if (other == v || seen[other] == v) continue;
      seen[other] = v;
      graph.neighbours.push_back(other);
    }
    graph.starts.push_back(static_cast<int64_t>(graph.neighbours.size()));
  }
}

std::vector<int32_t> unknowns_in_order(const CompressedGraph& graph,
                                       const std::vector<int32_t>& vertices) {
  std::vector<int32_t> start(graph.weight.size());
  int32_t next = 0;
  for (const int32_t v : vertices) {
    start[v] = next;
    next += graph.weight[v];
  }
  std::vector<int32_t> order(graph.vertex.size());
  for (size_t i = 0; i < order.size(); ++i)
    order[start[graph.vertex[i]]++] = static_cast<int32_t>(i);
  return order;
}

std::vector<int32_t> minimum_degree(const SparseMatrix& lower) {
  const auto n = static_cast<int64_t>(lower.cols());
  const Pattern pattern(lower);
  const std::vector<SuiteSparse_long> starts(pattern.starts.begin(), pattern.starts.end());
  const std::vector<SuiteSparse_long> rows(pattern.neighbours.begin(), pattern.neighbours.end());
  std::vector<SuiteSparse_long> order(static_cast<size_t>(n));
  const int status =
      static_cast<int>(amd_l_order(n, starts.data(), rows.data(), order.data(), nullptr, nullptr));
  if (status != AMD_OK && status != AMD_OK_BUT_JUMBLED)
    throw NumericsError(fmt::format("ordering: AMD failed with status {}", status));
  return {order.begin(), order.end()};
}

}  // namespace

Ordering safe_ordering(Ordering wanted, int64_t size, int64_t edges) {
  constexpr int64_t kMost = std::numeric_limits<int32_t>::max();
  return wanted == Ordering::kMetis && (edges >= kMost || size >= kMost) ? Ordering::kAmd : wanted;
}

CompressedGraph compress_graph(const SparseMatrix& lower) {
  const Pattern pattern(lower);
  CompressedGraph graph;
  find_vertices(pattern, graph);
  find_edges(pattern, graph);
  return graph;
}

FillOrder fill_reducing_order(const SparseMatrix& lower, Ordering wanted) {
  FillOrder out;
  if (wanted == Ordering::kMetis) {
    const CompressedGraph graph = compress_graph(lower);
    const auto edges = static_cast<int64_t>(graph.neighbours.size());
    out.method = safe_ordering(wanted, graph.size(), edges);
    if (edges == 0) {
      wanted = Ordering::kNatural;  // nothing fills in
    } else if (out.method == Ordering::kMetis) {
      const std::vector<int32_t> vertices = nested_dissection(graph);
      if (!vertices.empty()) {
        out.order = unknowns_in_order(graph, vertices);
        return out;
      }
    }
    if (wanted == Ordering::kMetis) wanted = Ordering::kAmd;
  }
  out.method = wanted;
  if (wanted == Ordering::kAmd) {
    out.order = minimum_degree(lower);
  } else {
    out.order.resize(lower.cols());
    std::iota(out.order.begin(), out.order.end(), 0);
  }
  return out;
}

std::string ordering_name(Ordering ordering) {
  if (ordering == Ordering::kMetis) return "metis";
  return ordering == Ordering::kAmd ? "amd" : "natural";
}

}  // namespace clatter::sparse
