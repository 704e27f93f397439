// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/matrix_pencil.hpp"

#include <algorithm>

#include "core/sparse/eigen/mode_values.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::sparse {
namespace {

constexpr double kLostShift = 2e-15;  // |sigma| over the highest eigenvalue: rounding level of K

std::shared_ptr<const SymmetricOperator> product_in(const std::vector<int64_t>& order,
                                                    const SparseMatrix& lower) {
  if (order.empty()) return std::make_shared<SymmetricProduct>(lower);
  return std::make_shared<SymmetricProduct>(reordered(lower, order));
}

}  // namespace

double PencilBounds::smallest_shift() const { return kLostShift * top; }

PencilBounds bounds_of(const SparseMatrix& K, const SparseMatrix& M) {
  PencilBounds out;
  for (int j = 0; j < K.cols(); ++j) {
    const double m = M.coeff(j, j);
    if (m > 0.0)
      out.top = std::max(out.top, K.coeff(j, j) / m);
    else
      ++out.massless;
  }
  return out;
}

PencilBounds LocalPencil::bounds() const { return bounds_of(own_.K, own_.M); }

double LocalPencil::default_shift() const { return sparse::default_shift(own_.K, own_.M); }

std::unique_ptr<Factor> LocalPencil::factor(double sigma, const FactorOptions& options) const {
  return std::make_unique<SupernodalFactor>(SparseMatrix(own_.K - sigma * own_.M), options);
}

InertiaCount LocalPencil::count_below(double limit, const std::vector<int64_t>& order) const {
  return sparse::count_below(own_.K, own_.M, limit, order);
}

std::shared_ptr<const SymmetricOperator> LocalPencil::stiffness(
    const std::vector<int64_t>& order) const {
  return product_in(order, own_.K);
}

std::shared_ptr<const SymmetricOperator> LocalPencil::mass(
    const std::vector<int64_t>& order) const {
  return product_in(order, own_.M);
}

Eigen::MatrixXd LocalPencil::stiffness_times(const Eigen::MatrixXd& x) const {
  return multiply_symmetric(own_.K, x);
}

Eigen::MatrixXd LocalPencil::mass_times(const Eigen::MatrixXd& x) const {
  return multiply_symmetric(own_.M, x);
}

Eigen::MatrixXd LocalPencil::magnitude_times(const Eigen::MatrixXd& x) const {
  return magnitude_product(own_.K, x);
}

}  // namespace clatter::sparse
