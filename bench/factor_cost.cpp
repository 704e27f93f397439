// SPDX-License-Identifier: GPL-3.0-or-later
// factor_cost model.fe.h5 right-hand-sides threads: the cost of one factorisation of K - sigma M in
// one line: DoFs, entries of L, flops, seconds of analysis, factorisation and solution for a block.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/base/blas_kernel.hpp"
#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/threads.hpp"
#include "core/fe/fe_model.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace {

int run(int argc, char** argv) {
  if (argc != 4) throw clatter::InputError("expected model.fe.h5 right-hand-sides threads");
  clatter::set_thread_count(std::atoi(argv[3]));
  const auto model = clatter::fe::read_fe_model(argv[1]);
  const clatter::SparseMatrix A = model.K + std::pow(2.0 * std::numbers::pi * 100.0, 2) * model.M;
  const clatter::sparse::SupernodalFactor factor(A);
  const Eigen::MatrixXd b = Eigen::MatrixXd::Ones(A.rows(), std::atoi(argv[2]));
  const clatter::Stopwatch clock;
  const Eigen::MatrixXd x = factor.solve(b);
  const double seconds = clock.seconds();
  const auto& report = factor.report();
  fmt::print("{} {} {} {} {} {}\n", A.rows(), report.entries, report.flops, report.analyse_seconds,
             report.factor_seconds, seconds);
  return x.allFinite() ? 0 : 3;
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  return clatter::run_guarded("factor_cost", [&] { return run(argc, argv); });
}
