// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Implicitly restarted Lanczos by ARPACK, shift-invert mode: the reference eigen-solver.
#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

struct ArpackOptions {
  int count = 0;             // pairs wanted
  int basis = 0;             // Lanczos vectors; 0: 2 count + 10, at most n
  double tolerance = 1e-12;  // of nu, relative
  int max_restarts = 300;
  uint64_t seed = 1;      // of the random start vector
  Eigen::VectorXd start;  // used instead of the random one when not empty
};

/// The `count` lowest eigenpairs of K x = lambda M x (Lehoucq, Sorensen and Yang, ARPACK Users'
/// Guide, 1998, section 3.2, mode 3). ARPACK keeps static state, so only one call runs at a time
/// (hard case A8). It can miss copies of multiple eigenvalues without any error code (A2): use
/// solve_modes, which proves the count.
EigenResult solve_arpack(const ShiftInvert& problem, const ArpackOptions& options);

/// The ARPACK version that this was built against, "3.8.0".
std::string arpack_version();

}  // namespace clatter::sparse
