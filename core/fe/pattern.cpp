// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"

namespace clatter::fe {
namespace {

/// For each node its cells, as (block, row) in mesh order.
struct CellsOfNode {
  struct Entry {
    int32_t block;
    int32_t cell;
  };
  std::vector<int64_t> start;
  std::vector<Entry> entries;
};

CellsOfNode cells_of_nodes(const mesh::Mesh& mesh) {
  CellsOfNode of;
  of.start.assign(static_cast<size_t>(mesh.nodes.rows()) + 1, 0);
  for (const mesh::CellBlock& block : mesh.cells)
    for (Eigen::Index i = 0; i < block.nodes.size(); ++i)
      ++of.start[static_cast<size_t>(block.nodes.data()[i]) + 1];
  for (size_t i = 1; i < of.start.size(); ++i) of.start[i] += of.start[i - 1];
  of.entries.resize(of.start.back());
  std::vector<int64_t> next(of.start.begin(), of.start.end() - 1);
  for (size_t b = 0; b < mesh.cells.size(); ++b) {
    const IndexMatrix& cells = mesh.cells[b].nodes;
    for (Eigen::Index c = 0; c < cells.rows(); ++c)
      for (Eigen::Index a = 0; a < cells.cols(); ++a) {
        int64_t& slot = next[cells(c, a)];
        of.entries[slot++] = {static_cast<int32_t>(b), static_cast<int32_t>(c)};
      }
  }
  return of;
}

/// Rows of one column: `node`, then its higher neighbours ascending.
void collect_rows(const mesh::Mesh& mesh, const CellsOfNode& of, int32_t node,
                  std::vector<int32_t>& rows) {
  rows.assign(1, node);  // also of shells alone
  const auto j = static_cast<size_t>(node);
  for (int64_t k = of.start[j]; k < of.start[j + 1]; ++k) {
    const CellsOfNode::Entry entry = of.entries[k];
    const auto cell = mesh.cells[entry.block].nodes.row(entry.cell);
    for (const int32_t neighbour : cell)
      if (neighbour > node) rows.push_back(neighbour);
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

}  // namespace

int64_t NodePattern::position(int32_t column, int32_t node) const {
  const auto first = rows.begin() + start[column];
  const auto last = rows.begin() + start[static_cast<size_t>(column) + 1];
  return std::lower_bound(first, last, node) - first;
}

double PredictedSize::gib() const {
  constexpr double kBytesPerEntry = sizeof(double) + sizeof(int32_t);
  return kBytesPerEntry * static_cast<double>(stiffness + mass) / (1024.0 * 1024.0 * 1024.0);
}

PredictedSize predict_size(int64_t nodes, int64_t pairs) {
  const PredictedSize size{3 * nodes, 6 * nodes + 9 * pairs, 3 * nodes + 3 * pairs};
  constexpr int64_t kLimit = std::numeric_limits<int32_t>::max();
  if (size.stiffness >= kLimit)
    throw InputError(fmt::format(
        "mesh of {} nodes: the stiffness matrix would have {} entries, expected fewer than {}",
        nodes, size.stiffness, kLimit));
  return size;
}

NodePattern node_pattern(const mesh::Mesh& mesh) {
  const CellsOfNode of = cells_of_nodes(mesh);
  const int64_t n = mesh.nodes.rows();
  NodePattern pattern;
  pattern.start.assign(static_cast<size_t>(n) + 1, 0);
  // First pass counts, second pass fills: no second copy of the pattern is needed to join pieces.
  for (const bool fill : {false, true}) {
    parallel_pieces(n, [&](int64_t begin, int64_t end) {
      std::vector<int32_t> rows;
      for (int64_t j = begin; j < end; ++j) {
        collect_rows(mesh, of, static_cast<int32_t>(j), rows);
        const auto column = static_cast<size_t>(j);
        if (fill)
          std::copy(rows.begin(), rows.end(), pattern.rows.begin() + pattern.start[column]);
        else
          pattern.start[column + 1] = static_cast<int64_t>(rows.size());
      }
    });
    if (fill) break;
    for (size_t j = 1; j < pattern.start.size(); ++j) pattern.start[j] += pattern.start[j - 1];
    predict_size(n, pattern.start.back() - n);
    pattern.rows.resize(pattern.start.back());
  }
  return pattern;
}

}  // namespace clatter::fe
