#include "modal/eigen/dense_solver.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "modal/dense_eigen.hpp"

namespace clatter::modal {

EigenResult solve_dense(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, double sigma,
                        int count) {
  EigenResult result;
  const Eigen::MatrixXd shifted = K - sigma * M;
  const Eigen::LLT<Eigen::MatrixXd> factor(shifted);
  if (factor.info() != Eigen::Success) {
    result.status = EigenStatus::kBadInput;
    result.message = "K - sigma M is not positive definite";
    return result;
  }
  const Eigen::MatrixXd half = factor.matrixL().solve(M);
  Eigen::MatrixXd C = factor.matrixL().solve(half.transpose());
  C = (0.5 * (C + C.transpose())).eval();
  const DenseEigen solver = symmetric_eigen(C);
  if (!solver.ok) {
    result.message = "the dense eigen-solver did not converge";
    return result;
  }
  // Ascending nu; the largest are the lowest modes. Massless directions have nu = 0: no mode.
  const Eigen::VectorXd& nu = solver.values;
  const double zero = 1e-14 * nu.cwiseAbs().maxCoeff();
  const Eigen::Index n = nu.size();
  Eigen::Index found = (nu.array() > zero).count();
  if (count > 0) found = std::min<Eigen::Index>(found, count);
  const Eigen::VectorXd kept = nu.tail(found).reverse();
  result.values = kept.cwiseInverse().array() + sigma;
  const Eigen::MatrixXd Z = solver.vectors.middleCols(n - found, found).rowwise().reverse();
  // z^T z = 1 means x^T (K - sigma M) x = 1, so x^T M x = nu.
  result.vectors = factor.matrixU().solve(Z) * kept.cwiseSqrt().cwiseInverse().asDiagonal();
  result.status = EigenStatus::kConverged;
  result.solves = n;
  return result;
}

double dense_shift(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M) {
  Eigen::VectorXd quotient = K.diagonal().cwiseQuotient(M.diagonal());
  std::sort(quotient.begin(), quotient.end());
  return -1e-3 * quotient[quotient.size() / 2];
}

Eigen::MatrixXd dense_symmetric(const SparseMatrix& lower) {
  const SparseMatrix full = lower.selfadjointView<Eigen::Lower>();
  return Eigen::MatrixXd(full);
}

}  // namespace clatter::modal
