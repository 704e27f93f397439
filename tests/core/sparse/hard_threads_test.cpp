// SPDX-License-Identifier: GPL-3.0-or-later
// Reuse of permutations (hard case C7); threads that help or at least do no harm (C8).
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "core/base/blas_kernel.hpp"
#include "core/base/threads.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "tests/core/sparse/spring_models.hpp"

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
  const MatrixXd b = MatrixXd::Random(A.rows(), 3);
  EXPECT_LT((second.solve(b) - first.solve(b)).norm(), 1e-12 * first.solve(b).norm());
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

/// Threads of this process: maximum number, and mean number running.
class ThreadWatch {
 public:
  ThreadWatch() : watcher_([this] { watch(); }) {}
  ~ThreadWatch() { stop(); }
  void stop() {
    done_ = true;
    if (watcher_.joinable()) watcher_.join();
  }
  int most() const { return most_; }
  double mean_running() const { return samples_ > 0 ? running_ / samples_ : 0.0; }
  int samples() const { return samples_; }

 private:
  void watch() {
    while (!done_) {
      int threads = 0;
      for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
        std::ifstream file(entry.path() / "stat");
        std::string line;
        std::getline(file, line);
        const size_t name_end = line.rfind(')');
        ++threads;
        if (name_end != std::string::npos && line[name_end + 2] == 'R') running_ += 1.0;
      }
      running_ -= 1.0;  // the sampling thread itself
      most_ = std::max(most_, threads - 1);
      ++samples_;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::atomic<bool> done_{false};
  int most_ = 0, samples_ = 0;
  double running_ = 0.0;
  std::thread watcher_;
};

// bench/condense.py measures the speed of each count: a test on a shared machine cannot.
TEST(HardC8, ThreadsOfBlasAndOursDoNotMultiplyAndTheSolutionStays) {
  const auto box = spring_box(20, 20, 20);
  const SparseMatrix A = box.K + 1e5 * box.M;
  const MatrixXd b = MatrixXd::Random(A.rows(), 64);
  MatrixXd alone;
  for (const int threads : {1, 2, 4}) {
    set_thread_count(threads);
    set_blas_threads(threads);
    ThreadWatch watch;
    const SupernodalFactor factor(A);
    const MatrixXd x = factor.solve(b);
    watch.stop();
    if (threads == 1) alone = x;
    EXPECT_LT((x - alone).norm(), 1e-11 * alone.norm()) << threads;
    ASSERT_GT(watch.samples(), 20);
    // BLAS, OpenMP inside CHOLMOD and our own loops each may keep a thread team, but not nested
    // teams.
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    EXPECT_LE(watch.most(), 1 + 2 * 4 + std::max(cores, 4)) << threads;
    // Nested (our threads, each with a BLAS team) there would be 4 for 2 and 16 for 4; an OpenMP
    // team that busy-waits briefly after its loop adds less than one on average.
    EXPECT_LE(watch.mean_running(), threads + 1.5) << threads;
  }
  set_thread_count(0);
  set_blas_threads(2);
}

}  // namespace
}  // namespace clatter::sparse
