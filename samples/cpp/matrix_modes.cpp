// SPDX-License-Identifier: GPL-3.0-or-later
// Factorises K and prints the lowest modes of K x = lambda M x.
//   matrix_modes K.mtx M.mtx [count]        Matrix Market, symmetric, SI units
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "core/base/matrix_text.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: matrix_modes K.mtx M.mtx [count]\n", stderr);
    return 2;
  }
  try {
    const clatter::SparseMatrix K = clatter::read_matrix_text(argv[1]);
    const clatter::SparseMatrix M = clatter::read_matrix_text(argv[2]);

    // K must be positive definite for this: supported everywhere.
    const clatter::sparse::SupernodalFactor factor(K);
    const Eigen::VectorXd load = Eigen::VectorXd::Ones(K.rows());
    std::printf("compliance under a unit load on every DoF: %.9g\n",
                load.dot(factor.solve(load).col(0)));

    clatter::sparse::EigenOptions options;
    options.count = argc > 3 ? std::atoi(argv[3]) : 6;
    const auto modes = clatter::sparse::solve_modes(K, M, options);
    for (const double hz : modes.frequencies_hz()) std::printf("%.9g Hz\n", hz);
    std::printf("%s\n",
                modes.proof.proved ? "number of modes proved" : "number of modes not proved");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "matrix_modes: %s\n", error.what());
    return 2;
  }
}
