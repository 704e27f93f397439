// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/massless.hpp"

#include <fmt/format.h>

#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

struct Split {
  std::vector<int32_t> heavy, massless;
};

Split split_by_mass(const SparseMatrix& M) {
  Split out;
  for (int32_t j = 0; j < M.cols(); ++j)
    (M.coeff(j, j) > 0.0 ? out.heavy : out.massless).push_back(j);
  return out;
}

/// Blocks of a symmetric matrix: rows `rows` and columns `columns`, both ascending.
SparseMatrix block_of(const SparseMatrix& full, const std::vector<int32_t>& rows,
                      const std::vector<int32_t>& columns) {
  std::vector<int32_t> new_index(static_cast<size_t>(full.rows()), -1);
  for (size_t k = 0; k < rows.size(); ++k) new_index[rows[k]] = static_cast<int32_t>(k);
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t k = 0; k < columns.size(); ++k)
    for (SparseMatrix::InnerIterator it(full, columns[k]); it; ++it)
      if (const int32_t row = new_index[it.row()]; row >= 0)
        entries.emplace_back(row, static_cast<int32_t>(k), it.value());
  SparseMatrix out(static_cast<Index>(rows.size()), static_cast<Index>(columns.size()));
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

SparseMatrix lower_of(const SparseMatrix& full) { return full.triangularView<Eigen::Lower>(); }

SupernodalFactor factor_massless(const SparseMatrix& K_00, const std::vector<int32_t>& massless) {
  try {
    return SupernodalFactor(K_00);
  } catch (const NotPositiveDefinite& error) {
    const int64_t column = error.column < 0 ? -1 : massless[error.column];
    throw NotPositiveDefinite(fmt::format("unknowns without mass: {}", error.what()), column);
  }
}

}  // namespace

ModeSet solve_few_masses(const SparseMatrix& K, const SparseMatrix& M,
                         const EigenOptions& options) {
  const Split split = split_by_mass(M);
  const SparseMatrix K_full = K.selfadjointView<Eigen::Lower>();
  const SparseMatrix M_full = M.selfadjointView<Eigen::Lower>();
  const SupernodalFactor factor =
      factor_massless(lower_of(block_of(K_full, split.massless, split.massless)), split.massless);
  const SparseMatrix K_0m = block_of(K_full, split.massless, split.heavy);
  const MatrixXd Psi = -factor.solve(MatrixXd(K_0m));
  MatrixXd K_mm = MatrixXd(block_of(K_full, split.heavy, split.heavy)) + K_0m.transpose() * Psi;
  K_mm = (0.5 * (K_mm + K_mm.transpose())).eval();
  const SparseMatrix K_hat = MatrixXd(K_mm.triangularView<Eigen::Lower>()).sparseView(0.0, 0.0);
  const SparseMatrix M_hat = lower_of(block_of(M_full, split.heavy, split.heavy));

  EigenOptions inner = options;
  inner.dense_limit = static_cast<int>(split.heavy.size());
  if (options.rigid) inner.rigid = MatrixXd((*options.rigid)(split.heavy, Eigen::all));
  if (options.start.size() > 0) inner.start = Eigen::VectorXd(options.start(split.heavy));
  ModeSet modes = solve_modes(K_hat, M_hat, inner);
  MatrixXd all(K.rows(), modes.size());
  all(split.heavy, Eigen::all) = modes.vectors;
  all(split.massless, Eigen::all) = Psi * modes.vectors;
  modes.vectors.swap(all);
  modes.massless = static_cast<int64_t>(split.massless.size());
  modes.solves += K_0m.cols();
  modes.factor = factor.report();
  return modes;
}

}  // namespace clatter::sparse
