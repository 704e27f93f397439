#include "assembly/assemble.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/element.hpp"
#include "core/error.hpp"
#include "core/progress.hpp"
#include "core/threads.hpp"

namespace clatter::assembly {
namespace {

constexpr Eigen::Index kChunk = 512;  // cells; 4 MB of tet10 matrices, about a core's cache

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
int64_t mass_column(const NodePattern& pattern, int64_t j, int d) {
  const auto at = static_cast<size_t>(j);
  return 3 * pattern.start[at] + d * (pattern.start[at + 1] - pattern.start[at]);
}

void fill_indices(const NodePattern& pattern, NodalMatrices& out) {
  int32_t* k_outer = out.K.outerIndexPtr();
  int32_t* m_outer = out.M.outerIndexPtr();
  parallel_pieces(pattern.nodes(), [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j) {
      const auto first = pattern.rows.begin() + pattern.start[static_cast<size_t>(j)];
      const auto last = pattern.rows.begin() + pattern.start[static_cast<size_t>(j) + 1];
      for (int d = 0; d < 3; ++d) {
        const int64_t k_at = stiffness_column(pattern, j, d), m_at = mass_column(pattern, j, d);
        k_outer[3 * j + d] = static_cast<int32_t>(k_at);
        m_outer[3 * j + d] = static_cast<int32_t>(m_at);
        int32_t* k_row = out.K.innerIndexPtr() + k_at;
        int32_t* m_row = out.M.innerIndexPtr() + m_at;
        for (auto node = first; node != last; ++node) {
          *m_row++ = 3 * *node + d;
          for (int e = node == first ? d : 0; e < 3; ++e) *k_row++ = 3 * *node + e;
        }
      }
    }
  });
  k_outer[3 * pattern.nodes()] = static_cast<int32_t>(out.K.data().size());
  m_outer[3 * pattern.nodes()] = static_cast<int32_t>(out.M.data().size());
}

/// Adds the columns of one cell that belong to nodes in [begin, end).
template <int N, typename Row>
void scatter(const ElementMatrices<N>& cell, const Row& nodes, const NodePattern& pattern,
             int64_t begin, int64_t end, NodalMatrices& out) {
  for (int b = 0; b < N; ++b) {
    const int32_t column = nodes(b);
    if (column < begin || column >= end) continue;
    int64_t k_at[3], m_at[3];
    for (int d = 0; d < 3; ++d) {
      k_at[d] = stiffness_column(pattern, column, d);
      m_at[d] = mass_column(pattern, column, d);
    }
    for (int a = 0; a < N; ++a) {
      const int32_t row = nodes(a);
      if (row < column) continue;
      const int64_t position = pattern.position(column, row);
      for (int d = 0; d < 3; ++d) {
        out.M.valuePtr()[m_at[d] + position] += cell.mass(a, b);
        // In the diagonal block direction e of column d stands at e - d; below it the block
        // of row `position` follows 3 - d diagonal entries and whole blocks of three.
        const int64_t shift = row == column ? -d : 3 * position - d;
        for (int e = row == column ? d : 0; e < 3; ++e)
          out.K.valuePtr()[k_at[d] + shift + e] += cell.stiffness(3 * a + e, 3 * b + d);
      }
    }
  }
}

template <int N>
CellNodes<N> gather(const mesh::Mesh& mesh, const mesh::CellBlock& block, Eigen::Index cell) {
  CellNodes<N> x;
  for (int a = 0; a < N; ++a) x.row(a) = mesh.nodes.row(block.nodes(cell, a));
  return x;
}

void require_positive(const mesh::Mesh& mesh, const mesh::CellBlock& block, Eigen::Index cell,
                      double jacobian) {
  if (jacobian > 0.0) return;
  const Eigen::RowVector3d at = mesh.nodes.row(block.nodes(cell, 0));
  throw InputError(fmt::format(
      "mesh '{}': region {}: cell {} at ({:.6g}, {:.6g}, {:.6g}) m: found det J = {:.3g}, "
      "expected > 0 (inverted cell)",
      mesh.name, mesh.regions[static_cast<size_t>(block.region)], cell, at(0), at(1), at(2),
      jacobian));
}

template <int N>
void add_block(const mesh::Mesh& mesh, const mesh::CellBlock& block, const Material& material,
               const NodePattern& pattern, NodalMatrices& out, Progress& progress, double& done) {
  std::vector<ElementMatrices<N>> chunk(
      static_cast<size_t>(std::min<Eigen::Index>(kChunk, block.nodes.rows())));
  for (Eigen::Index first = 0; first < block.nodes.rows(); first += kChunk) {
    const Eigen::Index count = std::min(kChunk, block.nodes.rows() - first);
    parallel_pieces(count, [&](int64_t begin, int64_t end) {
      for (int64_t c = begin; c < end; ++c) {
        ElementMatrices<N>& cell = chunk[static_cast<size_t>(c)];
        compute_element<N>(gather<N>(mesh, block, first + c), material, cell);
        require_positive(mesh, block, first + c, cell.min_jacobian);
      }
    });
    parallel_pieces(pattern.nodes(), [&](int64_t begin, int64_t end) {
      for (Eigen::Index c = 0; c < count; ++c)
        scatter<N>(chunk[static_cast<size_t>(c)], block.nodes.row(first + c), pattern, begin, end,
                   out);
    });
    done += static_cast<double>(count);
    progress.update(done);
  }
}

}  // namespace

NodalMatrices assemble(const mesh::Mesh& mesh, const std::vector<Material>& materials,
                       const NodePattern& pattern) {
  const int64_t n = pattern.nodes();
  const PredictedSize size = predict_size(n, pattern.start.back() - n);
  NodalMatrices out;
  allocate(out.K, size.dofs, size.stiffness);
  allocate(out.M, size.dofs, size.mass);
  fill_indices(pattern, out);
  Progress progress("assemble", static_cast<double>(mesh.cell_count()), "cells");
  double done = 0.0;
  for (const mesh::CellBlock& block : mesh.cells) {
    const Material& material = materials.at(static_cast<size_t>(block.region));
    if (block.type == mesh::CellType::kTet4)
      add_block<4>(mesh, block, material, pattern, out, progress, done);
    else
      add_block<10>(mesh, block, material, pattern, out, progress, done);
  }
  return out;
}

}  // namespace clatter::assembly
