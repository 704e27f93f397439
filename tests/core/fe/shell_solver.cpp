// SPDX-License-Identifier: GPL-3.0-or-later
// Solutions of shell_meshes.hpp.
#include <Eigen/SparseCholesky>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/dense/symmetric_eigen.hpp"
#include "shell_meshes.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::fe::testing {
namespace {

std::vector<int> free_of(Eigen::Index n, const std::vector<int>& fixed) {
  std::vector<bool> held(static_cast<size_t>(n), false);
  for (const int d : fixed) held[d] = true;
  std::vector<int> out;
  for (int d = 0; d < n; ++d)
    if (!held[d]) out.push_back(d);
  return out;
}

Sparse part_of(const Sparse& A, const std::vector<int>& rows) {
  std::vector<int> index(static_cast<size_t>(A.rows()), -1);
  for (size_t i = 0; i < rows.size(); ++i) index[rows[i]] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (const int c : rows)
    for (Sparse::InnerIterator it(A, c); it; ++it)
      if (index[it.row()] >= 0) entries.emplace_back(index[it.row()], index[c], it.value());
  const auto n = static_cast<Eigen::Index>(rows.size());
  Sparse out(n, n);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

using Factor = Eigen::SimplicialLDLT<Sparse, Eigen::Lower>;

/// Columns orthonormal in M, against those of `basis` too.
void orthonormalise(const Eigen::MatrixXd& basis, const Sparse& M, Eigen::MatrixXd& W) {
  for (int pass = 0; pass < 2; ++pass) {
    W -= basis * (basis.transpose() * times(M, W));
    const dense::Eigenpairs gram = dense::symmetric_eigen(W.transpose() * times(M, W));
    W = W * gram.vectors * gram.values.cwiseSqrt().cwiseInverse().asDiagonal();
  }
}

}  // namespace

Eigen::MatrixXd times(const Sparse& A, const Eigen::MatrixXd& x) {
  return A.selfadjointView<Eigen::Lower>() * x;
}

Eigen::VectorXd solve(const Sparse& K, const Eigen::VectorXd& f, const std::vector<int>& fixed,
                      const Eigen::VectorXd& given) {
  const std::vector<int> rows = free_of(K.rows(), fixed);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(K.rows());
  for (const int d : fixed) u(d) = given(d);
  const Factor factor(part_of(K, rows));
  if (factor.info() != Eigen::Success) throw std::runtime_error("stiffness not definite");
  // The second step is a refinement: patch tests check the last digits.
  for (int step = 0; step < 2; ++step) {
    const Eigen::VectorXd rest = (f - times(K, u))(rows);
    u(rows) += factor.solve(rest);
  }
  return u;
}

Eigen::VectorXd frequencies(const SheetMatrices& model, const std::vector<int>& fixed, int count,
                            double below) {
  const std::vector<int> rows = free_of(model.K.rows(), fixed);
  const Sparse K = part_of(model.K, rows), M = part_of(model.M, rows);
  const double shift = -std::pow(2.0 * std::numbers::pi * below, 2);
  const Factor factor(K - shift * M);
  if (factor.info() != Eigen::Success) throw std::runtime_error("pencil not definite");
  // Krylov space of blocks; one block finds as many copies of an eigenvalue as it has columns.
  const int block = 12, blocks = 5 + count / 2;
  Eigen::MatrixXd basis(K.rows(), 0), T;
  Eigen::MatrixXd W = factor.solve(times(M, test::random_matrix(K.rows(), block)));
  Eigen::MatrixXd images(K.rows(), 0);
  for (int b = 0; b < blocks; ++b) {
    orthonormalise(basis, M, W);
    basis.conservativeResize(Eigen::NoChange, basis.cols() + block);
    basis.rightCols(block) = W;
    W = factor.solve(times(M, W));
    images.conservativeResize(Eigen::NoChange, basis.cols());
    images.rightCols(block) = W;
  }
  const Eigen::MatrixXd projected = basis.transpose() * times(M, images);
  const Eigen::VectorXd nu = dense::symmetric_eigen(projected, dense::EigenParts::kValues).values;
  const Eigen::VectorXd lambda = nu.tail(count).reverse().cwiseInverse().array() + shift;
  return lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

}  // namespace clatter::fe::testing
