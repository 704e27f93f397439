// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/ranks/row_inertia.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "condense/basis/frame_inertia.hpp"
#include "condense/basis/nodal_mass.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using ranks::Entries;
using ranks::Entry;

/// Rows of this process in matrices of the nodal masses.
class OwnRows {
 public:
  OwnRows(const PartitionedModel& part, const ranks::SharedMatrices& matrices);
  /// Own rows of T_k^T m T_l.
  Entries of_product(const SparseMatrix& complete, size_t k, size_t l) const;
  /// Own rows of T_k^T f.
  MatrixXd of_forces(const MatrixXd& f, size_t k) const { return own_[k].transpose() * f; }
  /// V^T f of own rows of f.
  MatrixXd project(const ReducedBasis& basis, const MatrixXd& f) const;
  /// Own rows of columns of V.
  MatrixXd columns(const ReducedBasis& basis, Index first, Index count) const;
  SparseMatrix mass_without_directions() const;
  bool gives_back(const SparseMatrix& m) const;

 private:
  const PartitionedModel& part_;
  const ranks::SharedMatrices& matrices_;
  const std::vector<int32_t>& dofs_;   // of the own rows
  const std::vector<int32_t>& index_;  // in elimination order
  Index inside_;                       // own rows of the interior
  std::vector<Index> boundary_;        // coordinates of the own boundary rows
  std::array<SparseMatrix, 3> T_;      // n_nodes x n, in elimination order
  std::array<SparseMatrix, 3> own_;    // n_nodes x own rows
};

OwnRows::OwnRows(const PartitionedModel& part, const ranks::SharedMatrices& matrices)
    : part_(part),
      matrices_(matrices),
      dofs_(part.whole_dofs),
      index_(matrices.numbering.index),
      inside_(static_cast<Index>(part.dofs.interior.size())) {
  for (auto dof = dofs_.begin() + inside_; dof != dofs_.end(); ++dof)
    boundary_.push_back(std::find(part.dofs.boundary.begin(), part.dofs.boundary.end(), *dof) -
                        part.dofs.boundary.begin());
  const SparseMatrix& T = part.full.T;
  std::array<std::vector<Eigen::Triplet<double>>, 3> all, own;
  for (int j = 0; j < T.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(T, j); it; ++it)
      all[it.row() % 3].emplace_back(it.row() / 3, index_[j], it.value());
  for (size_t k = 0; k < dofs_.size(); ++k)
    for (SparseMatrix::InnerIterator it(T, dofs_[k]); it; ++it)
      own[it.row() % 3].emplace_back(it.row() / 3, static_cast<int>(k), it.value());
  for (size_t d = 0; d < 3; ++d) {
    T_[d].resize(T.rows() / 3, T.cols());
    T_[d].setFromTriplets(all[d].begin(), all[d].end());
    own_[d].resize(T.rows() / 3, static_cast<Index>(dofs_.size()));
    own_[d].setFromTriplets(own[d].begin(), own[d].end());
  }
}

Entries OwnRows::of_product(const SparseMatrix& complete, size_t k, size_t l) const {
  const SparseMatrix left = (complete * own_[k]).eval().transpose();  // m is symmetric
  const Eigen::SparseMatrix<double, Eigen::RowMajor, int32_t> rows = left * T_[l];
  Entries out;
  out.reserve(rows.nonZeros());
  for (int i = 0; i < rows.outerSize(); ++i)
    for (decltype(rows)::InnerIterator it(rows, i); it; ++it)
      out.push_back({index_[dofs_[i]], static_cast<int32_t>(it.col()), it.value()});
  return out;
}

MatrixXd OwnRows::project(const ReducedBasis& basis, const MatrixXd& f) const {
  MatrixXd at_boundary = MatrixXd::Zero(basis.boundary(), f.cols());
  at_boundary(boundary_, Eigen::all) = f.bottomRows(f.rows() - inside_);
  return basis.project(f.topRows(inside_), part_.team().sum(std::move(at_boundary)));
}

MatrixXd OwnRows::columns(const ReducedBasis& basis, Index first, Index count) const {
  const MatrixXd unit = MatrixXd::Identity(basis.size(), basis.size()).middleCols(first, count);
  MatrixXd out(static_cast<Index>(dofs_.size()), count);
  out.topRows(inside_) = basis.interior(unit);
  out.bottomRows(out.rows() - inside_) = unit(boundary_, Eigen::all);
  return out;
}

/// The masses between x displacements, lower triangle, complete on every process.
SparseMatrix OwnRows::mass_without_directions() const {
  const std::vector<int32_t>& dof = matrices_.numbering.dof;
  std::vector<double> found;
  for (const Entry& entry : matrices_.M) {
    const int row = dof[entry.row], column = dof[entry.column];
    if (row % 3 == 0 && column % 3 == 0 && row >= column)
      found.insert(found.end(), {row / 3.0, column / 3.0, entry.value});
  }
  const RowMatrix own =
      Eigen::Map<const RowMatrix>(found.data(), static_cast<Index>(found.size() / 3), 3);
  const auto count = static_cast<Index>(part_.team().sum(static_cast<double>(own.rows())));
  RowMatrix all = part_.team().gather(own);
  all.conservativeResize(count, 3);
  part_.team().agree(all.data(), all.size());
  std::vector<Eigen::Triplet<double>> masses;
  for (Index k = 0; k < count; ++k)
    masses.emplace_back(static_cast<int>(all(k, 0)), static_cast<int>(all(k, 1)), all(k, 2));
  SparseMatrix m(part_.full.size() / 3, part_.full.size() / 3);
  m.setFromTriplets(masses.begin(), masses.end());
  return m;
}

/// Whether the own rows of T^T (m x I_3) T are those of M, on all processes.
bool OwnRows::gives_back(const SparseMatrix& m) const {
  const SparseMatrix complete = m.selfadjointView<Eigen::Lower>();
  std::vector<Eigen::Triplet<double>> rest;
  double largest = 0.0, worst = 0.0;
  for (const Entry& entry : matrices_.M) {
    largest = std::max(largest, std::abs(entry.value));
    rest.emplace_back(entry.row, entry.column, -entry.value);
  }
  for (size_t k = 0; k < 3; ++k)
    for (const Entry& entry : of_product(complete, k, k))
      rest.emplace_back(entry.row, entry.column, entry.value);
  SparseMatrix sum(part_.full.size(), part_.full.size());
  sum.setFromTriplets(rest.begin(), rest.end());
  if (sum.nonZeros() > 0) worst = sum.coeffs().abs().maxCoeff();
  return -part_.team().least(-worst) <= -1e-10 * part_.team().least(-largest);
}

}  // namespace

rom::InertiaInvariants row_inertia(const PartitionedModel& part,
                                   const ranks::SharedMatrices& matrices,
                                   const ReducedBasis& basis) {
  constexpr Index kBlock = 64;
  const OwnRows rows(part, matrices);
  const SparseMatrix m = nodal_mass(
      part.full, [&] { return rows.mass_without_directions(); },
      [&](const SparseMatrix& tried) { return rows.gives_back(tried); });
  const SparseMatrix complete = m.selfadjointView<Eigen::Lower>();
  MatrixXd moments(m.rows(), 4);  // m x, m 1
  moments.leftCols(3) = complete * part.full.nodes;
  moments.col(3) = complete * VectorXd::Ones(m.rows());
  rom::InertiaInvariants out;
  out.place = part.full.nodes.transpose() * moments.leftCols(3);
  const Index r = basis.size();
  std::vector<std::pair<size_t, ranks::SharedMatrix>> products;  // by place in out.product
  for (size_t k = 0; k < 3; ++k) {
    const MatrixXd projected = rows.project(basis, rows.of_forces(moments, k));
    out.first[k] = projected.col(3);
    for (size_t l = 0; l < 3; ++l) out.moment[3 * l + k] = projected.col(static_cast<Index>(l));
    for (size_t l = k; l < 3; ++l) {
      out.product[3 * k + l].resize(r, r);
      products.emplace_back(3 * k + l, ranks::SharedMatrix(matrices.ranks, matrices.shares,
                                                           rows.of_product(complete, k, l), true));
    }
  }
  for (Index begin = 0; begin < r; begin += kBlock) {
    const Index count = std::min(kBlock, r - begin);
    const MatrixXd V = rows.columns(basis, begin, count);
    for (const auto& [place, product] : products)
      out.product[place].middleCols(begin, count) = rows.project(basis, product * V);
  }
  complete_products(out);
  return out;
}

}  // namespace clatter::condense
