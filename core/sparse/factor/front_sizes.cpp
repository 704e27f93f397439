// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/factor/front_sizes.hpp"

#include <algorithm>

#include "core/sparse/factor/metis_order.hpp"
#include "core/sparse/factor/supernode_tree.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;

/// Boundary columns coupled to each vertex, ascending.
std::vector<std::vector<int32_t>> coupled_columns(const SparseMatrix& coupling,
                                                  const CompressedGraph& graph) {
  std::vector<std::vector<int32_t>> out(graph.weight.size());
  for (int b = 0; b < coupling.outerSize(); ++b) {
    for (SparseMatrix::InnerIterator it(coupling, b); it; ++it) {
      auto& list = out[graph.vertex[it.row()]];
      if (list.empty() || list.back() != b) list.push_back(b);
    }
  }
  return out;
}

/// Pattern of the lower triangle of a graph's matrix with the boundary columns as further vertices.
SparseMatrix lower_of(const CompressedGraph& graph, const SparseMatrix& coupling) {
  const std::vector<std::vector<int32_t>> coupled = coupled_columns(coupling, graph);
  const int32_t n = graph.size(), all = n + static_cast<int32_t>(coupling.cols());
  SparseMatrix out(all, all);
  std::vector<int32_t> rows;
  for (int32_t v = 0; v < all; ++v) {
    rows.assign(1, v);
    if (v < n) {
      const auto at = static_cast<size_t>(v);
      for (int64_t k = graph.starts[at]; k < graph.starts[at + 1]; ++k)
        if (const int32_t w = graph.neighbours[k]; w > v) rows.push_back(w);
      for (const int32_t b : coupled[at]) rows.push_back(n + b);
    }
    std::sort(rows.begin(), rows.end());
    out.startVec(v);
    for (const int32_t w : rows) out.insertBack(w, v) = 0.0;
  }
  out.finalize();
  return out;
}

/// Fronts with unknowns to eliminate; boundary vertices come after all others of their front.
void take_fronts(const SupernodeTree& tree, const CompressedGraph& graph, FrontSizes& out) {
  std::vector<int32_t> front(static_cast<size_t>(tree.supernodes()), -1);
  for (int32_t s = 0; s < tree.supernodes(); ++s) {
    int64_t columns = 0, height = 0;
    for (int32_t k = 0; k < tree.height(s); ++k) {
      const int32_t vertex = tree.order[tree.rows_of(s)[k]];
      const bool boundary = vertex >= graph.size();
      const int64_t weight = boundary ? 1 : graph.weight[vertex];
      height += weight;
      if (k < tree.columns(s) && !boundary) columns += weight;
    }
    if (columns == 0) continue;
    front[s] = out.fronts();
    out.columns.push_back(columns);
    out.height.push_back(height);
    out.parent.push_back(tree.parent[s]);
  }
  for (int32_t& parent : out.parent)
    if (parent >= 0) parent = front[parent];
}

/// METIS, as fill_reducing_order; AMD where METIS cannot.
std::vector<int64_t> vertex_order(const CompressedGraph& graph, std::string& method) {
  const auto edges = static_cast<int64_t>(graph.neighbours.size());
  std::vector<int32_t> order;
  if (safe_ordering(Ordering::kMetis, graph.size(), edges) == Ordering::kMetis)
    order = nested_dissection(graph);
  method = ordering_name(order.empty() ? Ordering::kAmd : Ordering::kMetis);
  if (order.empty()) order = fill_reducing_order(lower_of(graph, {}), Ordering::kAmd).order;
  return {order.begin(), order.end()};
}

}  // namespace

int64_t FrontSizes::entries(int32_t s) const {
  const int64_t p = columns[at(s)];
  return p * (p + 1) / 2 + p * below(s);
}

int64_t FrontSizes::entries() const {
  int64_t sum = 0;
  for (int32_t s = 0; s < fronts(); ++s) sum += entries(s);
  return sum;
}

double FrontSizes::flops(int32_t s) const {
  const auto to = [](double h) { return h * (h + 1.0) * (2.0 * h + 1.0) / 6.0; };  // 1 + .. + h^2
  return to(static_cast<double>(height[at(s)])) - to(static_cast<double>(below(s)));
}

double FrontSizes::flops() const {
  double sum = 0.0;
  for (int32_t s = 0; s < fronts(); ++s) sum += flops(s);
  return sum;
}

FrontSizes count_fronts(const SparseMatrix& lower, const SparseMatrix& coupling) {
  const CompressedGraph graph = compress_graph(lower);
  const SparseMatrix vertices = lower_of(graph, coupling);
  FrontSizes out;
  TreeOptions options;
  options.merged = false;
  options.permutation = vertex_order(graph, out.ordering);
  for (int32_t v = graph.size(); v < vertices.cols(); ++v) options.permutation.push_back(v);
  const SupernodeTree tree = analyse_tree(vertices, options);
  out.size = lower.cols();
  out.boundary = coupling.cols();
  take_fronts(tree, graph, out);
  return out;
}

}  // namespace clatter::sparse
