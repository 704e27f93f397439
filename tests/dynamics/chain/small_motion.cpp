// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/chain/small_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/dense/complex.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics::testing {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// df/dy + df/dv / kappa of all elements at rest.
MatrixXd tangent(System& system, const VectorXd& y, double kappa) {
  VectorXd force, unit = VectorXd::Zero(y.size());
  system.evaluate({0.0, kappa, 1, {}}, y, VectorXd::Zero(y.size()), true, force);
  MatrixXd T(y.size(), y.size());
  for (Eigen::Index j = 0; j < y.size(); ++j) {
    unit(j) = 1.0;
    force.setZero(y.size());
    system.add_tangent_forces(unit, force);
    T.col(j) = force;
    unit(j) = 0.0;
  }
  return T;
}

// A stage so long that dampers have no tangent.
constexpr double kLong = 1e9;

/// s^2 M + s C + K in the modal coordinates, M diagonal.
struct Quadratic {
  VectorXd M;
  MatrixXd C, K, P;

  Quadratic(System& system, const VectorXd& y) : M(system.inertia()) {
    const Eigen::Index n = system.modes();
    P.resize(y.size(), n);
    for (Eigen::Index j = 0; j < n; ++j)
      P.col(j) = system.interface(VectorXd(VectorXd::Unit(n, j)));
    const MatrixXd T = tangent(system, y, kLong), D = tangent(system, y, 1.0) - T;
    K = MatrixXd(system.omega_squared().asDiagonal()) - P.transpose() * T * P;
    C = MatrixXd(system.damping().asDiagonal()) - P.transpose() * D * P;
  }
  Eigen::Index size() const { return M.size(); }
  /// Of x = (eta, s eta): the pencil A - s E.
  MatrixXcd A(const MatrixXcd& x) const {
    MatrixXcd result(x.rows(), x.cols());
    result << x.bottomRows(size()), -(K * x.topRows(size()) + C * x.bottomRows(size()));
    return result;
  }
  MatrixXcd E(const MatrixXcd& x) const {
    MatrixXcd result(x.rows(), x.cols());
    result << x.topRows(size()), M.asDiagonal() * x.bottomRows(size());
    return result;
  }
};

}  // namespace

SmallMotion small_motion(System& system, const VectorXd& y) {
  const MatrixXd K = -tangent(system, y, kLong);
  VectorXd root(y.size());
  for (Eigen::Index j = 0; j < y.size(); ++j)
    root(j) = std::sqrt(testing::inverse_mass(system, static_cast<int>(j)));
  const MatrixXd A = root.asDiagonal() * (0.5 * (K + K.transpose())) * root.asDiagonal();
  const dense::Eigenpairs solved = dense::symmetric_eigen(A);
  return {solved.values.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi),
          root.asDiagonal() * solved.vectors};
}

DampedMotion damped_motion(System& system, const VectorXd& y, std::complex<double> shift,
                           int count) {
  const Quadratic q(system, y);
  const Eigen::Index n = q.size();
  const MatrixXcd shifted = q.K + shift * q.C + MatrixXcd((shift * shift * q.M).asDiagonal());
  MatrixXcd x(2 * n, 2 * count);
  for (Eigen::Index i = 0; i < x.rows(); ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j)
      x(i, j) = std::polar(1.0, std::sqrt(2.0) * static_cast<double>((i + 1) * (i + 1) * (j + 1)));
  for (int k = 0; k < 12; ++k) {
    const MatrixXcd w = q.E(x), a = w.topRows(n), b = w.bottomRows(n);
    const MatrixXcd eta =
        -dense::solve_complex(shifted, b + q.C * a + shift * (q.M.asDiagonal() * a));
    x << eta, a + shift * eta;
    x = dense::orthonormal(x);
  }
  const MatrixXcd small =
      dense::solve_complex(MatrixXcd(x.adjoint() * q.E(x)), x.adjoint() * q.A(x));
  const dense::ComplexEigenpairs solved = dense::complex_eigen(small);
  std::vector<Eigen::Index> order(static_cast<size_t>(small.rows()));
  for (size_t k = 0; k < order.size(); ++k) order[k] = static_cast<Eigen::Index>(k);
  const auto distance = [&](Eigen::Index k) { return std::abs(solved.values(k) - shift); };
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return distance(a) < distance(b); });
  DampedMotion found{VectorXcd(count), MatrixXcd(y.size(), count)};
  for (int k = 0; k < count; ++k) {
    const Eigen::Index at = order[k];
    found.s(k) = solved.values(at);
    found.shapes.col(k) = (q.P * (x * solved.vectors.col(at)).topRows(n)).normalized();
  }
  return found;
}

}  // namespace clatter::dynamics::testing
