// SPDX-License-Identifier: GPL-3.0-or-later
// cholmod_arpack model.fe.h5 count tolerance: the lowest modes [Hz] by CHOLMOD and ARPACK as in
// their manuals: METIS permutation, supernodal Cholesky of K - sigma M, one right-hand side per
// solve. This is a straightforward implementation without count, probe and refinement.
#include <arpack.h>
#include <cholmod.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"

namespace {

using clatter::SparseMatrix;

struct Solver {
  explicit Solver(const SparseMatrix& lower) {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    starts.assign(lower.outerIndexPtr(), lower.outerIndexPtr() + lower.cols() + 1);
    rows.assign(lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros());
    cholmod_sparse A{};
    A.nrow = A.ncol = static_cast<size_t>(lower.cols());
    A.nzmax = rows.size();
    A.p = starts.data();
    A.i = rows.data();
    A.x = const_cast<double*>(lower.valuePtr());
    A.stype = -1;
    A.itype = CHOLMOD_LONG;
    A.xtype = CHOLMOD_REAL;
    A.sorted = A.packed = 1;
    factor = cholmod_l_analyze(&A, &common);
    if (factor == nullptr || cholmod_l_factorize(&A, factor, &common) == 0 ||
        common.status != CHOLMOD_OK) {
      throw clatter::NumericsError("CHOLMOD failed");
    }
  }
  ~Solver() {
    for (cholmod_dense** d : {&x, &y, &e}) cholmod_l_free_dense(d, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }
  void solve(double* b) {
    cholmod_dense rhs{};
    rhs.nrow = rhs.nzmax = rhs.d = factor->n;
    rhs.ncol = 1;
    rhs.x = b;
    rhs.xtype = CHOLMOD_REAL;
    cholmod_l_solve2(CHOLMOD_A, factor, &rhs, nullptr, &x, nullptr, &y, &e, &common);
    std::copy_n(static_cast<const double*>(x->x), factor->n, b);
  }
  cholmod_common common{};
  std::vector<SuiteSparse_long> starts, rows;
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
};

std::vector<double> lowest(const SparseMatrix& M, Solver& solver, double sigma, int nev,
                           double tolerance) {
  const auto n = static_cast<a_int>(M.rows());
  const a_int ncv = 2 * nev + 10, lworkl = ncv * (ncv + 8);
  std::vector<double> resid(static_cast<size_t>(n)), workd(3 * resid.size()),
      workl(static_cast<size_t>(lworkl)), v(resid.size() * static_cast<size_t>(ncv)),
      d(static_cast<size_t>(nev));
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::generate(resid.begin(), resid.end(), [&] { return uniform(engine); });
  a_int iparam[11] = {1, 0, 300, 1, 0, 0, 3}, ipntr[14] = {}, info = 1, ido = 0;
  const auto at = [&](int p) {
    return Eigen::Map<Eigen::VectorXd>(workd.data() + ipntr[p] - 1, n);
  };
  while (ido != 99) {
    dsaupd_c(&ido, "G", n, "LM", nev, tolerance, resid.data(), ncv, v.data(), n, iparam, ipntr,
             workd.data(), workl.data(), lworkl, &info);
    if (ido == -1 || ido == 2) at(1) = M.selfadjointView<Eigen::Lower>() * at(0);
    if (ido == 1) at(1) = at(2);
    if (ido == -1 || ido == 1) solver.solve(at(1).data());
  }
  if (info != 0) throw clatter::NumericsError(fmt::format("ARPACK ended with {}", info));
  std::vector<a_int> select(static_cast<size_t>(ncv));
  std::vector<double> z(resid.size() * static_cast<size_t>(nev));
  dseupd_c(1, "A", select.data(), d.data(), z.data(), n, sigma, "G", n, "LM", nev, tolerance,
           resid.data(), ncv, v.data(), n, iparam, ipntr, workd.data(), workl.data(), lworkl,
           &info);
  if (info != 0) throw clatter::NumericsError(fmt::format("ARPACK ended with {}", info));
  std::sort(d.begin(), d.end());
  return d;
}

int run(int argc, char** argv) {
  if (argc != 4) throw clatter::InputError("expected model.fe.h5 count tolerance");
  const auto model = clatter::fe::read_fe_model(argv[1]);
  const double sigma = -std::pow(2.0 * std::numbers::pi * 100.0, 2);
  const SparseMatrix A = model.K - sigma * model.M;
  Solver solver(A);
  for (const double value : lowest(model.M, solver, sigma, std::atoi(argv[2]), std::atof(argv[3])))
    fmt::print("{:.10g} ", std::sqrt(std::abs(value)) / (2.0 * std::numbers::pi));
  fmt::print("\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return clatter::run_guarded("cholmod_arpack", [&] { return run(argc, argv); });
}
