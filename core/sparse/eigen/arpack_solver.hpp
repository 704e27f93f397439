// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Implicitly restarted Lanczos by ARPACK, shift-invert mode: the reference eigen-solver.
#include <array>
#include <vector>

#include "core/sparse/eigen/shift_invert.hpp"

namespace clatter::sparse {

/// Arguments of ARPACK's dsaupd and dseupd in shift-invert mode for one run; names follow its
/// guide, rows are those of this process.
struct ArpackArrays {
  static constexpr char kMassInProduct = 'G';
  static constexpr const char* kLargestMagnitude = "LM";  // never "SM": see hard case A5
  int ido = 0, n = 0, nev = 0, ncv = 0, lworkl = 0;
  double tolerance = 0.0, sigma = 0.0;
  std::vector<double> resid, workd, workl;
  Eigen::MatrixXd v;             // n x ncv
  std::array<int, 11> iparam{};  // 32 bits, as Debian's ARPACK
  std::array<int, 14> ipntr{};
  int info = 1;  // resid holds the start vector
  std::vector<int> select;
  Eigen::VectorXd d;  // nev
  Eigen::MatrixXd z;  // n x nev
};

/// ARPACK's two routines, of one process or for a team that shares the rows (PARPACK).
class ArpackRoutines {
 public:
  virtual ~ArpackRoutines() = default;
  virtual void iterate(ArpackArrays& arrays) const;  // dsaupd
  virtual void extract(ArpackArrays& arrays) const;  // dseupd, with all vectors
};

struct ArpackOptions {
  int count = 0;             // pairs wanted
  int basis = 0;             // Lanczos vectors; 0: 2 count + 10, at most n of the team
  double tolerance = 1e-12;  // of nu, relative
  int max_restarts = 300;
  uint64_t seed = 1;      // of the random start vector
  Eigen::VectorXd start;  // used instead of the random one when not empty
};

/// The `count` lowest eigenpairs of K x = lambda M x (Lehoucq, Sorensen and Yang, ARPACK Users'
/// Guide, 1998, section 3.2, mode 3). ARPACK keeps static state, so only one call runs at a time
/// (hard case A8). It can miss copies of multiple eigenvalues without any error code (A2): use
/// solve_modes, which proves the count. Collective where a team shares the rows.
EigenResult solve_arpack(const ShiftInvert& problem, const ArpackOptions& options,
                         const ArpackRoutines& routines = {});

/// The ARPACK version that this was built against, "3.8.0".
std::string arpack_version();

}  // namespace clatter::sparse
