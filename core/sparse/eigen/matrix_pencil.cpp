// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/matrix_pencil.hpp"

#include <algorithm>
#include <cmath>

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

PencilBounds MatrixPencil::bounds() const {
  const auto [k, m] = diagonals();
  PencilBounds out;
  double massless = 0.0;
  for (Eigen::Index j = 0; j < m.size(); ++j) {
    if (m[j] > 0.0)
      out.top = std::max(out.top, k[j] / m[j]);
    else
      massless += 1.0;
  }
  out.top = -team().least(-out.top);
  out.massless = static_cast<int64_t>(team().sum(massless));
  return out;
}

double MatrixPencil::default_shift() const {
  const auto [k, m] = diagonals();
  RowMatrix ratio(m.size(), 1);
  Eigen::Index count = 0;
  for (Eigen::Index j = 0; j < m.size(); ++j)
    if (m[j] > 0.0) ratio(count++, 0) = k[j] / m[j];
  RowMatrix all = team().gather(RowMatrix(ratio.topRows(count)));
  double shift = 0.0;
  if (all.rows() > 0) {
    double* median = all.data() + all.rows() / 2;
    std::nth_element(all.data(), median, all.data() + all.rows());
    // A body of n DoFs is about n^(1/3) elements long.
    shift = -0.1 * *median * std::pow(static_cast<double>(size()), -2.0 / 3.0);
  }
  team().agree(&shift, 1);
  return shift;
}

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
