// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Random matrices that are the same in each run.
#include <Eigen/Core>
#include <complex>
#include <random>

namespace clatter::test {

/// rows x cols values, uniform in [-1, 1), of a generator with this seed; both parts of complex
/// ones.
template <class Matrix = Eigen::MatrixXd>
Matrix random_matrix(Eigen::Index rows, Eigen::Index cols, unsigned seed = 1) {
  using Scalar = typename Matrix::Scalar;
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Matrix out(rows, cols);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < cols; ++j) {
      const double real = uniform(generator);
      if constexpr (Eigen::NumTraits<Scalar>::IsComplex)
        out(i, j) = Scalar(real, uniform(generator));
      else
        out(i, j) = real;
    }
  return out;
}

inline Eigen::VectorXd random_vector(Eigen::Index size, unsigned seed = 1) {
  return random_matrix<Eigen::VectorXd>(size, 1, seed);
}

}  // namespace clatter::test
