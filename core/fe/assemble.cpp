// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/progress.hpp"
#include "core/base/threads.hpp"
#include "core/fe/element.hpp"

namespace clatter::fe {
namespace {

constexpr Eigen::Index kChunk = 512;    // cells; 4 MB of tet10 matrices, about the cache of a core
constexpr int32_t kNodesTogether = 64;  // consecutive columns per thread: their entries
                                        // are contiguous, and adjacent cells share them

void allocate(SparseMatrix& matrix, int64_t n, int64_t nonzeros) {
  matrix.resize(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  matrix.resizeNonZeros(static_cast<Eigen::Index>(nonzeros));
  std::fill_n(matrix.valuePtr(), nonzeros, 0.0);
}

/// Offset of column (node j, direction d) in K, whose diagonal blocks keep 3, 2, 1 entries.
int64_t stiffness_column(const NodePattern& pattern, int64_t j, int d) {
  const auto at = static_cast<size_t>(j);
  const int64_t below = pattern.start[at + 1] - pattern.start[at] - 1;
  const int64_t before = 9 * (pattern.start[at] - j) + 6 * j;
  return before + d * (3 * below + 3) - d * (d - 1) / 2;
}

/// Offset of column (node j, direction d) in M, which couples equal directions only.
int64_t mass_column(const NodePattern& pattern, MassForm form, int64_t j, int d) {
  if (form == MassForm::kHrz) return 3 * j + d;
  const auto at = static_cast<size_t>(j);
  return 3 * pattern.start[at] + d * (pattern.start[at + 1] - pattern.start[at]);
}

void fill_indices(const NodePattern& pattern, MassForm form, NodalMatrices& out) {
  int32_t* k_outer = out.K.outerIndexPtr();
  int32_t* m_outer = out.M.outerIndexPtr();
  parallel_pieces(pattern.nodes(), [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) {
      const auto first = pattern.rows.begin() + pattern.start[j];
      const auto last = pattern.rows.begin() + pattern.start[static_cast<size_t>(j) + 1];
      for (int d = 0; d < 3; ++d) {
        const int64_t k_at = stiffness_column(pattern, j, d);
        const int64_t m_at = mass_column(pattern, form, j, d);
        k_outer[3 * j + d] = static_cast<int32_t>(k_at);
        m_outer[3 * j + d] = static_cast<int32_t>(m_at);
        int32_t* k_row = out.K.innerIndexPtr() + k_at;
        int32_t* m_row = out.M.innerIndexPtr() + m_at;
        for (auto node = first; node != last; ++node) {
          if (form == MassForm::kConsistent || node == first) *m_row++ = 3 * *node + d;
          for (int e = node == first ? d : 0; e < 3; ++e) *k_row++ = 3 * *node + e;
        }
      }
    }
  });
  k_outer[3 * pattern.nodes()] = static_cast<int32_t>(out.K.data().size());
  m_outer[3 * pattern.nodes()] = static_cast<int32_t>(out.M.data().size());
}

/// Offsets of the entries of node pairs in M and K.
class Scatter {
 public:
  Scatter(const NodePattern& pattern, MassForm form, NodalMatrices& out)
      : pattern_(pattern), form_(form), K_(out.K.valuePtr()), M_(out.M.valuePtr()) {}

  /// Adds the columns of one cell that belong to nodes of `owner`.
  template <typename Row>
  void add(const ElementMatrices& cell, const Row& nodes, int64_t owner, int64_t owners) const {
    for (Eigen::Index b = 0; b < nodes.size(); ++b) {
      const int32_t column = nodes(b);
      if (column / kNodesTogether % owners != owner) continue;
      const Column at = starts(column);
      for (Eigen::Index a = 0; a < nodes.size(); ++a)
        if (nodes(a) >= column) add_pair(cell, column, nodes(a), a, b, at);
    }
  }

 private:
  struct Column {
    int64_t k[3], m[3];
  };

  Column starts(int32_t column) const {
    Column at;
    for (int d = 0; d < 3; ++d) {
      at.k[d] = stiffness_column(pattern_, column, d);
      at.m[d] = mass_column(pattern_, form_, column, d);
    }
    return at;
  }

  void add_pair(const ElementMatrices& cell, int32_t column, int32_t row, Eigen::Index a,
                Eigen::Index b, const Column& at) const {
    const int64_t position = row == column ? 0 : pattern_.position(column, row);
    if (form_ == MassForm::kConsistent || row == column)
      for (int d = 0; d < 3; ++d) M_[at.m[d] + position] += cell.mass(a, b);
    for (int d = 0; d < 3; ++d) {
      // In the diagonal block direction e of column d is at e - d; below it the block of row
      // `position` follows 3 - d diagonal entries and complete blocks of three.
      double* k = K_ + at.k[d] + (row == column ? -d : 3 * position - d);
      for (int e = row == column ? d : 0; e < 3; ++e) k[e] += cell.stiffness(3 * a + e, 3 * b + d);
    }
  }

  const NodePattern& pattern_;
  MassForm form_;
  double* K_;
  double* M_;
};

void require_positive(const mesh::Mesh& mesh, const mesh::CellBlock& block, Eigen::Index cell,
                      double jacobian) {
  if (jacobian > 0.0) return;
  const Eigen::RowVector3d at = mesh.nodes.row(block.nodes(cell, 0));
  throw InputError(fmt::format(
      "mesh '{}': region {}: cell {} at ({:.6g}, {:.6g}, {:.6g}) m: found det J = {:.3g}, "
      "expected > 0 (inverted cell)",
      mesh.name, mesh.regions[block.region], mesh::cell_label(block, cell), at(0), at(1), at(2),
      jacobian));
}

bool in_one_body(const std::vector<int32_t>& rigid_of_node, const mesh::CellBlock& block,
                 Eigen::Index cell) {
  if (rigid_of_node.empty()) return false;
  const int32_t body = rigid_of_node[block.nodes(cell, 0)];
  if (body < 0) return false;
  for (const int32_t node : block.nodes.row(cell))
    if (rigid_of_node[node] != body) return false;
  return true;
}

}  // namespace

NodalMatrices assemble(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                       const NodePattern& pattern, MassForm form,
                       const std::vector<int32_t>& rigid_of_node) {
  const int64_t n = pattern.nodes();
  const PredictedSize size = predict_size(n, pattern.start.back() - n);
  NodalMatrices out;
  allocate(out.K, size.dofs, size.stiffness);
  allocate(out.M, size.dofs, form == MassForm::kHrz ? size.dofs : size.mass);
  fill_indices(pattern, form, out);
  const Scatter scatter(pattern, form, out);
  const int64_t owners = thread_count();
  int64_t cells = 0;
  for (const mesh::CellBlock& block : mesh.cells) cells += block.nodes.rows();
  Progress progress("assemble", static_cast<double>(cells), "cells");
  double done = 0.0;
  std::vector<ElementMatrices> chunk(kChunk);
  for (const mesh::CellBlock& block : mesh.cells) {
    const Material& material = materials.at(block.region);
    for (Eigen::Index first = 0; first < block.nodes.rows(); first += kChunk) {
      const Eigen::Index count = std::min(kChunk, block.nodes.rows() - first);
      parallel_pieces(count, [&](int64_t begin, int64_t end) {
        for (int64_t c = begin; c < end; ++c) {
          ElementMatrices& cell = chunk[c];
          // From the cell's first node: far from the origin differences of positions would lose
          // digits in each derivative (hard case F2).
          const mesh::CellNodes x = mesh::cell_nodes(mesh, block, first + c);
          const mesh::CellNodes near = x.rowwise() - x.row(0);
          if (material.axes)
            compute_element(block.type, near, material.seen_from(x.row(0)), cell);
          else
            compute_element(block.type, near, material, cell);
          require_positive(mesh, block, first + c, cell.min_jacobian);
          if (form == MassForm::kHrz) lump_hrz(cell.mass);
          if (in_one_body(rigid_of_node, block, first + c)) cell.stiffness.setZero();
        }
      });
      parallel_pieces(owners, [&](int64_t begin, int64_t end) {
        for (int64_t owner = begin; owner < end; ++owner)
          for (Eigen::Index c = 0; c < count; ++c)
            scatter.add(chunk[c], block.nodes.row(first + c), owner, owners);
      });
      progress.update(done += static_cast<double>(count));
    }
  }
  return out;
}

}  // namespace clatter::fe
