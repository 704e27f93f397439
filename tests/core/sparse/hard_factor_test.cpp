// SPDX-License-Identifier: GPL-3.0-or-later
// Factorisations that must be refused but that other solvers accept.
#include <gtest/gtest.h>

#include "core/base/blas_kernel.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::sparse {
namespace {

using test::diagonal;
using test::spring_box;

TEST(HardC1, AnIndefiniteMatrixIsRefusedWithItsColumn) {
  for (const Ordering ordering : {Ordering::kMetis, Ordering::kAmd, Ordering::kNatural}) {
    // diag(1, -1, 2) hidden from the diagonal check by a rotation of rows 1 and 2.
    const SparseMatrix A =
        test::from_triplets(3, {{0, 0, 1.0}, {1, 1, 0.5}, {2, 2, 0.5}, {1, 2, 1.5}, {2, 1, 1.5}});
    FactorOptions options;
    options.ordering = ordering;
    try {
      const SupernodalFactor factor(A, options);
      FAIL() << "accepted";
    } catch (const NotPositiveDefinite& error) {
      EXPECT_TRUE(error.column == 1 || error.column == 2) << error.column;
    }
  }
  try {
    const SupernodalFactor factor(diagonal(Eigen::Vector3d(1.0, -1.0, 2.0)));
    FAIL() << "accepted";
  } catch (const NotPositiveDefinite& error) {
    EXPECT_EQ(error.column, 1);
  }
}

TEST(HardC2, ASingularFreeBodyIsRefused) {
  test::expect_parts(
      test::refusal_of<NotPositiveDefinite>([&] { SupernodalFactor{test::free_chain(50).K}; }),
      {"matrix is singular to working precision"});
  for (const int n : {3, 5, 8}) {
    test::expect_parts(
        test::refusal_of<NotPositiveDefinite>([&] { SupernodalFactor{spring_box(n, n, n).K}; }),
        {"matrix is"});
  }
}

TEST(HardC3, InertiaAgreesWithDenseOnBothSidesOfTheSpectrum) {
  const auto box = spring_box(4, 3, 3);
  const SparseMatrix full = box.K.selfadjointView<Eigen::Lower>();
  const Eigen::MatrixXd M = Eigen::MatrixXd(box.M);
  const Eigen::VectorXd values =
      dense::symmetric_eigen(Eigen::MatrixXd(full), M, dense::EigenParts::kValues).values;
  for (Eigen::Index j = 6; j < values.size(); j += 7) {
    if (values[j] - values[j - 1] < 1e-6 * values[j]) continue;
    const double mu = 0.5 * (values[j] + values[j - 1]);
    EXPECT_EQ(count_below(box.K, box.M, mu).negative, j);
  }
}

TEST(HardC4, FactorsBeyond32BitsAreCountedAndRefusedBeforeTheyAreMade) {
  // A 3-D grid in its natural order has a band of 74 x 74: lnz is about 74^5 > 2^31.
  const int n = 76;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(4) * n * n * n);
  for (int i = 0; i < n * n * n; ++i) {
    entries.emplace_back(i, i, 7.0);
    if (i % n != n - 1) entries.emplace_back(i + 1, i, -1.0);
    if (i / n % n != n - 1) entries.emplace_back(i + n, i, -1.0);
    if (i / (n * n) != n - 1) entries.emplace_back(i + n * n, i, -1.0);
  }
  const SparseMatrix A = test::from_triplets(n * n * n, entries);
  FactorOptions options;
  options.ordering = Ordering::kNatural;
  test::expect_at_least("predicted entries of the factor",
                        static_cast<double>(SupernodalFactor::predict(A, options).entries),
                        2147483649.0);
  options.memory_limit_gib = 4.0;
  test::expect_parts(
      test::refusal_of<NumericsError>([&] { SupernodalFactor(A, options); }),
      {"the factor of 438976 unknowns needs", "GiB (",
       "entries), 4 GiB are left: use a coarser mesh or raise the limit (--memory-limit)"});
}

TEST(HardC5, MetisIsNotGivenMoreEntriesThanItCanCount) {
  EXPECT_EQ(safe_ordering(Ordering::kMetis, 1000, int64_t{1} << 20), Ordering::kMetis);
  EXPECT_EQ(safe_ordering(Ordering::kMetis, 1000, int64_t{1} << 31), Ordering::kAmd);
  EXPECT_EQ(safe_ordering(Ordering::kMetis, int64_t{1} << 32, int64_t{1} << 32), Ordering::kAmd);
}

TEST(HardC9, TheVerdictOnABorderlineMatrixDoesNotDependOnThreads) {
  const auto box = spring_box(6, 6, 6);
  // Supported so weakly that the ratio of pivots is near 1e-10, a thousand times the limit.
  const SparseMatrix A = box.K + 2.5e-2 * box.M;
  for (const int threads : {1, 2, 4}) {
    set_blas_threads(threads);
    const SupernodalFactor factor(A);
    EXPECT_GT(factor.report().rcond, 1e-12) << threads;
    test::expect_at_most("condition estimate of the borderline matrix", factor.report().rcond,
                         1e-8);
    test::expect_parts(test::refusal_of<NotPositiveDefinite>([&] { SupernodalFactor{box.K}; }),
                       {"matrix is"});
  }
  set_blas_threads(2);
}

}  // namespace
}  // namespace clatter::sparse
