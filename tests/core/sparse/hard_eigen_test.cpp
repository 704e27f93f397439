// SPDX-License-Identifier: GPL-3.0-or-later
// Cases in which ARPACK fails or misleads.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "core/base/error.hpp"
#include "core/sparse/eigen/arpack_solver.hpp"
#include "core/sparse/eigen/block_lanczos.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/factor/inertia.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"
#include "core/sparse/symmetric_product.hpp"
#include "tests/core/sparse/four_cylinders.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/observed.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"

namespace clatter::sparse {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::by_count;
using test::free_chain;
using test::free_chain_value;
using test::kBoth;
using test::Pencil;
using test::spring_box;

/// Shift-invert problem of a pencil for the solvers below solve_modes.
struct Shifted {
  Shifted(const Pencil& pencil, double sigma)
      : factor(SparseMatrix(pencil.K - sigma * pencil.M)), mass(pencil.M) {
    problem.size = pencil.K.rows();
    problem.sigma = sigma;
    problem.solve = [this](const double* x, double* y, int count) {
      Eigen::Map<RowMatrix>(y, problem.size, count) =
          factor.solve(Eigen::Map<const RowMatrix>(x, problem.size, count));
    };
    problem.mass = [this](const double* x, double* y, int count) { mass.multiply(x, y, count); };
  }
  SupernodalFactor factor;
  SymmetricProduct mass;
  ShiftInvert problem;
};

TEST(HardA1, SixRigidModesAndOneSpectrumForThreeShifts) {
  const auto box = spring_box(7, 5, 6);
  const ModeSet reference = solve_modes(box.K, box.M, by_count(20));
  const double first = reference.values[6];
  for (const EigenMethod method : kBoth) {
    for (const double part : {-1.0, -0.1, -0.01}) {
      EigenOptions options = by_count(20, method);
      options.sigma = part * first;
      const ModeSet modes = solve_modes(box.K, box.M, options);
      EXPECT_EQ(modes.rigid, 6);
      test::expect_at_most("rigid modes over the first elastic one",
                           modes.values.head(6).cwiseAbs().maxCoeff() / first, 1e-6);
      EXPECT_LT((modes.values.tail(14) - reference.values.tail(14)).cwiseAbs().maxCoeff(),
                1e-8 * first);
    }
  }
}

TEST(HardA1, AShiftOnTheRigidModesIsRefused) {
  const auto box = spring_box(7, 5, 6);
  EigenOptions options = by_count(10);
  options.sigma = 0.0;
  test::expect_parts(
      test::refusal_of<NotPositiveDefinite>([&] { (void)solve_modes(box.K, box.M, options); }),
      {"matrix is"});
}

TEST(HardA1, EachSolveWithAShiftedFreeBodyHasASmallResidual) {
  const auto box = spring_box(7, 5, 6);
  const double first = solve_modes(box.K, box.M, by_count(8)).values[6];
  for (const double part : {-1.0, -0.1, -0.01}) {
    const SparseMatrix A = box.K - part * first * box.M;
    const SupernodalFactor factor(A);
    test::expect_at_most("probe residual of a shifted free body", factor.report().probe_residual,
                         1e-10);
    const VectorXd b = test::random_vector(A.rows());
    const VectorXd r = b - A.selfadjointView<Eigen::Lower>() * VectorXd(factor.solve(b));
    test::expect_at_most("residual of a solve", r.norm() / b.norm(), 1e-10);
  }
}

/// Start vector equal on both bars: it has no component in half of the spectrum.
VectorXd symmetric_start(int n) {
  VectorXd start(2 * n);
  for (int i = 0; i < n; ++i) start[i] = start[i + n] = std::sin(1.0 + 0.37 * i);
  return start;
}

TEST(HardA2, TwoEqualBarsWithASymmetricStartAreRefused) {
  const Pencil bars = test::twice(free_chain(200));
  EigenOptions options = by_count(6, EigenMethod::kArpack);
  options.start = symmetric_start(200);
  options.sigma = -1e5;
  options.factor.ordering = Ordering::kNatural;  // treats both bars identically, including rounding
  options.max_retries = 0;
  const auto refusal = [&] {
    return test::refusal_of<NumericsError>([&] { solve_modes(bars.K, bars.M, options); });
  };
  test::expect_parts(refusal(), {"modes: inertia counts", "modes below", "Hz, the solver found"});
  options.count = 0;
  options.fmax_hz = hz_of_value(0.5 * (free_chain_value(200, 2) + free_chain_value(200, 3)));
  test::expect_parts(refusal(), {"modes: inertia counts 6 modes below", "Hz, the solver found 3"});
}

TEST(HardA2, TwoEqualBarsAreCuredByANewStartAndRightAtDefaults) {
  const Pencil bars = test::twice(free_chain(200));
  for (const EigenMethod method : kBoth) {
    for (const bool symmetric : {true, false}) {
      EigenOptions options = by_count(6, method);
      if (symmetric) options.start = symmetric_start(200);
      const ModeSet modes = solve_modes(bars.K, bars.M, options);
      EXPECT_EQ(modes.rigid, 2);
      for (int j = 2; j < 6; ++j) {
        const double exact = free_chain_value(200, j / 2);
        EXPECT_NEAR(modes.values[j], exact, 1e-7 * exact) << j;
      }
    }
  }
}

/// A start that is its own mirror image: it has no antisymmetric component.
VectorXd mirrored_start(const test::FourCylinders& block) {
  VectorXd start(block.K.rows());
  for (int i = 0; i < start.size(); ++i) start[i] = std::sin(1.0 + 0.37 * i);
  return start + block.image(start);
}

TEST(HardA2, ASolverThatKeepsASymmetryMissesHalfOfTheModesAndTheCountShowsIt) {
  const auto block = test::four_cylinders(1.0);
  Shifted shifted(block, default_shift(block.K, block.M));
  const auto solve = shifted.problem.solve;
  shifted.problem.solve = [&](const double* x, double* y, int count) {
    ASSERT_EQ(count, 1);
    solve(x, y, 1);
    Eigen::Map<VectorXd> answer(y, shifted.problem.size);
    answer = (0.5 * (answer + block.image(answer))).eval();
  };
  ArpackOptions options;
  options.count = 12;
  options.start = mirrored_start(block);
  const EigenResult half = solve_arpack(shifted.problem, options);
  ASSERT_TRUE(half.ok());  // no error code, and every pair is correct:
  for (int j = 3; j < 12; ++j) {
    const VectorXd u = half.vectors.col(j);
    const VectorXd r = block.K.selfadjointView<Eigen::Lower>() * u - half.values[j] * block.M * u;
    EXPECT_LT(r.norm(), 1e-9 * half.values[j] * (block.M * u).norm()) << j;
  }
  const double limit = 1.0001 * half.values[11];
  EXPECT_GE(count_below(block.K, block.M, limit).negative, 20);
}

TEST(HardA2, AFourCylinderBlockIsCompleteFromASymmetricStart) {
  for (const double weak : {1.0, 1e-3}) {
    const auto block = test::four_cylinders(weak);
    const SparseMatrix full = block.K.selfadjointView<Eigen::Lower>();
    const EigenResult all =
        solve_dense(MatrixXd(full), MatrixXd(block.M), default_shift(block.K, block.M), 24);
    for (const EigenMethod method : kBoth) {
      EigenOptions options = by_count(24, method);
      options.start = mirrored_start(block);
      const ModeSet modes = solve_modes(block.K, block.M, options);
      EXPECT_TRUE(modes.proof.proved);
      EXPECT_EQ(modes.rigid, 6);
      EXPECT_LT((modes.values - all.values).cwiseAbs().maxCoeff(), 1e-9 * all.values[23]) << weak;
    }
  }
}

TEST(HardA3, AnOperatorThatReturnsNanEndsInAStatus) {
  const auto box = spring_box(6, 5, 6);
  Shifted shifted(box, default_shift(box.K, box.M));
  const auto healthy = shifted.problem.solve;
  int calls = 0;
  shifted.problem.solve = [&](const double* x, double* y, int count) {
    healthy(x, y, count);
    if (++calls == 3) y[0] = std::numeric_limits<double>::quiet_NaN();
  };
  ArpackOptions arpack;
  arpack.count = 6;
  const EigenResult result = solve_arpack(shifted.problem, arpack);
  EXPECT_EQ(result.status, EigenStatus::kOperatorFailed);
  EXPECT_EQ(result.values.size(), 0);
  calls = 0;
  BlockLanczosOptions block;
  block.count = 6;
  EXPECT_EQ(solve_block_lanczos(shifted.problem, block).status, EigenStatus::kOperatorFailed);
}

TEST(HardA4, TooFewIterationsAreNotConverged) {
  const auto box = spring_box(7, 7, 7);
  Shifted shifted(box, 100.0 * default_shift(box.K, box.M));
  ArpackOptions arpack;
  arpack.count = 30;
  arpack.basis = 40;
  arpack.max_restarts = 1;
  const EigenResult result = solve_arpack(shifted.problem, arpack);
  EXPECT_EQ(result.status, EigenStatus::kNotConverged);
  EXPECT_EQ(result.vectors.size(), 0);
  BlockLanczosOptions block;
  block.count = 30;
  block.basis = 40;
  block.max_restarts = 0;
  EXPECT_EQ(solve_block_lanczos(shifted.problem, block).status, EigenStatus::kNotConverged);
}

TEST(HardA5, SmallCountsGivePrefixesOfOneList) {
  const auto box = spring_box(6, 5, 6);
  const ModeSet reference = solve_modes(box.K, box.M, by_count(8));
  for (int count = 1; count <= 8; ++count) {
    for (const EigenMethod method : kBoth) {
      const ModeSet modes = solve_modes(box.K, box.M, by_count(count, method));
      ASSERT_EQ(modes.size(), count);
      EXPECT_LT((modes.values - reference.values.head(count)).cwiseAbs().maxCoeff(),
                1e-8 * reference.values[7]);
    }
  }
}

TEST(HardA6, SmallModelsFallBackToDenseAlgebra) {
  const Pencil chain = free_chain(8);
  for (const int count : {6, 8}) {
    const ModeSet modes = solve_modes(chain.K, chain.M, by_count(count, EigenMethod::kArpack));
    EXPECT_EQ(modes.method, "dense");
    for (int j = 1; j < count; ++j)
      EXPECT_NEAR(modes.values[j], free_chain_value(8, j), 1e-10 * free_chain_value(8, j));
  }
  Shifted shifted(chain, -1e5);
  ArpackOptions options;
  options.count = 8;
  EXPECT_EQ(solve_arpack(shifted.problem, options).status, EigenStatus::kBadInput);
}

TEST(HardA7, RepeatsAreEqualBitByBitAndSeedsAgree) {
  const auto box = spring_box(6, 5, 4);
  for (const EigenMethod method : kBoth) {
    const ModeSet first = solve_modes(box.K, box.M, by_count(10, method));
    const ModeSet again = solve_modes(box.K, box.M, by_count(10, method));
    EXPECT_EQ(first.values, again.values);
    EXPECT_EQ(first.vectors, again.vectors);
    for (uint64_t seed = 2; seed < 102; ++seed) {
      EigenOptions options = by_count(10, method);
      options.seed = seed;
      options.prove_count = false;
      const ModeSet modes = solve_modes(box.K, box.M, options);
      EXPECT_LT((modes.values - first.values).cwiseAbs().maxCoeff(), 1e-8 * first.values[9]);
    }
  }
  EXPECT_FALSE(arpack_version().empty());
}

TEST(HardA8, EightThreadsGiveTheSerialResult) {
  const auto box = spring_box(6, 5, 4);
  for (const EigenMethod method : kBoth) {
    const ModeSet serial = solve_modes(box.K, box.M, by_count(10, method));
    std::atomic<int> equal{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 8; ++t) {
      threads.emplace_back([&] {
        const ModeSet modes = solve_modes(box.K, box.M, by_count(10, method));
        const double error = (modes.values - serial.values).cwiseAbs().maxCoeff();
        if (error < 1e-10 * serial.values[9]) ++equal;
      });
    }
    for (auto& thread : threads) thread.join();
    EXPECT_EQ(equal, 8);
  }
}

TEST(HardA9, SizesBeyond32BitsAreRefusedBeforeTheCall) {
  ShiftInvert problem;  // without operators: a call would throw another exception
  ArpackOptions options;
  problem.size = 5'000'000;
  options.count = 1000;  // n * ncv = 1e10
  EXPECT_EQ(solve_arpack(problem, options).status, EigenStatus::kBadInput);
  problem.size = 46'337;
  options.count = 46'336;  // n * ncv = 2^31 - 366 079 fits, lworkl = ncv (ncv + 8) does not
  options.basis = 46'337;
  EXPECT_EQ(solve_arpack(problem, options).status, EigenStatus::kBadInput);
  problem.size = 800'000'000;
  options.count = 1;  // 3 n of the work array
  options.basis = 2;
  EXPECT_EQ(solve_arpack(problem, options).status, EigenStatus::kBadInput);
}

#ifdef INTERFACE64
#error "an ARPACK of 64-bit integers would read Debian's 32-bit ones as nonsense (hard case A9)"
#endif

}  // namespace
}  // namespace clatter::sparse
