// SPDX-License-Identifier: GPL-3.0-or-later
// Reuse of permutations (hard case C7); threads that help or at least do no harm (C8).
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <mutex>
#include <set>
#include <thread>
#include <vector>

#include "core/base/blas_kernel.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/multifrontal.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/factor/tree_schedule.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/observed.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::sparse {
namespace {

using Eigen::MatrixXd;
using test::spring_box;

TEST(HardC7, AStoredPermutationIsUsedAgainWithTheSameFill) {
  const auto box = spring_box(12, 10, 11);
  const SparseMatrix A = box.K - default_shift(box.K, box.M) * box.M;
  const SupernodalFactor first(A);
  FactorOptions stored;
  stored.permutation = first.permutation();
  ASSERT_EQ(static_cast<int64_t>(stored.permutation.size()), A.rows());
  const SupernodalFactor second(A, stored);
  EXPECT_EQ(second.report().ordering, "given");
  EXPECT_EQ(second.report().entries, first.report().entries);
  EXPECT_EQ(second.permutation(), first.permutation());
  const MatrixXd b = test::random_matrix(A.rows(), 3);
  test::expect_at_most("difference of the solutions",
                       (second.solve(b) - first.solve(b)).norm() / first.solve(b).norm(), 1e-12);
  FactorOptions natural;  // another permutation has other fill: shows that the stored one is used
  natural.ordering = Ordering::kNatural;
  EXPECT_NE(SupernodalFactor::predict(A, natural).entries, first.report().entries);
  // The inertia count of another shifted matrix with the same pattern uses it too.
  const double mu = 0.5 * value_of_hz(2500.0);
  EXPECT_EQ(count_below(box.K, box.M, mu, stored.permutation).negative,
            count_below(box.K, box.M, mu).negative);
}

TEST(HardC7, TwoRunsOrderAlike) {
  const auto box = spring_box(9, 8, 7);
  const SparseMatrix A = box.K - default_shift(box.K, box.M) * box.M;
  EXPECT_EQ(SupernodalFactor(A).permutation(), SupernodalFactor(A).permutation());
}

/// Threads that BLAS would use now; 0 when it is not OpenBLAS.
int blas_threads() {
  const auto get = reinterpret_cast<int (*)()>(dlsym(RTLD_DEFAULT, "openblas_get_num_threads"));
  return get != nullptr ? get() : 0;
}

/// Threads of BLAS at the elimination of each front, and the number of our threads.
struct Teams {
  std::vector<int> blas;
  size_t ours = 0;
};

Teams teams_of(const SupernodeTree& tree, const SparseMatrix& A) {
  Teams teams;
  teams.blas.resize(tree.supernodes());
  std::mutex mutex;
  std::set<std::thread::id> ours;
  const FrontKernel kernel = [&](int32_t s, const Front& front) {
    EXPECT_EQ(eliminate_definite(front), 0);
    teams.blas[s] = blas_threads();
    const std::lock_guard<std::mutex> lock(mutex);
    ours.insert(std::this_thread::get_id());
  };
  eliminate(tree, permuted(tree, A, power_of_two_scale(A)), kernel, nullptr, nullptr);
  teams.ours = ours.size();
  return teams;
}

// bench/condense.py measures the speed of each count: a test on a shared machine cannot.
TEST(HardC8, ThreadsOfBlasAndOursDoNotMultiplyAndTheSolutionStays) {
  const auto box = spring_box(20, 20, 20);
  const SparseMatrix A = box.K + 1e5 * box.M;
  const SupernodeTree tree = analyse_tree(A, {});
  const MatrixXd b = test::random_matrix(A.rows(), 64);
  MatrixXd alone;
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    set_blas_threads(threads);
    // Without OpenBLAS there is no team that could be nested.
    const int alone_in_blas = blas_threads() > 0 ? 1 : 0, all = blas_threads();
    const Teams teams = teams_of(tree, A);
    EXPECT_LE(teams.ours, static_cast<size_t>(threads));
    const TreeSchedule plan = schedule(tree, threads);
    EXPECT_EQ(plan.subtrees.empty(), threads == 1);
    for (const int32_t root : plan.subtrees)  // side by side
      for (int32_t s = plan.lowest[root]; s <= root; ++s)
        EXPECT_EQ(teams.blas[s], alone_in_blas) << threads << ", front " << s;
    for (const int32_t s : plan.top)  // one after another
      EXPECT_EQ(teams.blas[s], all) << threads << ", front " << s;
    const SupernodalFactor factor(A);
    set_blas_threads(threads + 1);
    const MatrixXd x = factor.solve(b);
    // The solution runs on our threads alone and gives BLAS back as many as there are.
    EXPECT_EQ(blas_threads(), all) << threads;
    if (threads == 1) alone = x;
    test::expect_at_most("difference of the solution with several threads",
                         (x - alone).norm() / alone.norm(), 1e-11);
  }
  set_thread_count(0);
  set_blas_threads(2);
}

}  // namespace
}  // namespace clatter::sparse
