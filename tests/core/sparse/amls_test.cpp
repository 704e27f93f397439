// SPDX-License-Identifier: GPL-3.0-or-later
// Multilevel substructuring against dense spectra and block Lanczos.
#include <gtest/gtest.h>

#include "core/dense/svd.hpp"
#include "core/modes/analysis.hpp"
#include "core/sparse/eigen/amls.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/local_modes.hpp"
#include "core/sparse/eigen/mode_density.hpp"
#include "core/sparse/eigen/substructures.hpp"
#include "tests/core/sparse/spring_models.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::by_count;
using test::spring_box;

/// AMLS with its own factor, as called by solve_modes.
EigenResult direct(const test::Pencil& box, const AmlsOptions& options) {
  const MatrixXd nothing_known(box.K.rows(), 0);
  const LocalPencil matrices(box.K, box.M);
  ShiftedPencil pencil(matrices, {}, nothing_known);
  pencil.shift_to(default_shift(box.K, box.M));
  return solve_amls(pencil, options);
}

VectorXd dense_values(const test::Pencil& box, int count) {
  return solve_dense(dense_symmetric(box.K), MatrixXd(box.M), default_shift(box.K, box.M), count)
      .values;
}

AmlsOptions small_leaves(int count, double cutoff, int refinements) {
  AmlsOptions options;
  options.count = count;
  options.cutoff = cutoff;
  options.leaf = 60;
  options.accuracy = 1e30;  // accepts the projection after one step
  options.max_refinements = refinements;
  return options;
}

TEST(Amls, SubstructuresHoldEverySupernodeOnceAndCoverTheirSubtrees) {
  const auto box = spring_box(9, 8, 7);
  const SupernodeTree tree = analyse_tree(box.K, {});
  const auto parts = partition(tree, {100, 20});
  EXPECT_GT(parts.size(), 8U);
  int32_t next = 0;
  for (size_t k = 0; k < parts.size(); ++k) {
    EXPECT_EQ(parts[k].from, next);
    next = parts[k].to;
    for (int32_t s = parts[k].from; s < parts[k].to; ++s) {
      EXPECT_LE(parts[k].lowest, s);
    }
    const auto first = static_cast<size_t>(parts[k].first_inside);
    EXPECT_EQ(parts[first].from, parts[k].lowest);
  }
  EXPECT_EQ(next, tree.supernodes());
}

TEST(Amls, LocalModesOfADiagonalOperatorAreThoseAboveTheCut) {
  const int n = 400;
  const VectorXd nu = VectorXd::LinSpaced(n, 1.0, 0.001).array().cube();
  LocalOperator A{n, 0, [&](const MatrixXd& Q, MatrixXd& W, MatrixXd& C) {
                    W = nu.asDiagonal() * Q;
                    C.resize(0, Q.cols());
                  }};
  const double cut = 0.5 * (nu[19] + nu[20]);
  const LocalModes modes = local_modes(A, {cut, 8, 1});
  ASSERT_EQ(modes.values.size(), 20);
  for (int k = 0; k < 20; ++k) EXPECT_NEAR(modes.values[k], nu[k], 1e-3 * nu[k]);
  const MatrixXd gram = modes.vectors.transpose() * modes.vectors;
  EXPECT_LT((gram - MatrixXd::Identity(20, 20)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(Amls, IsExactWhenNoLocalModeIsLeftOut) {
  const auto box = spring_box(7, 6, 6);
  const EigenResult found = direct(box, small_leaves(30, 1e4, 1));
  ASSERT_TRUE(found.ok()) << found.message;
  const VectorXd exact = dense_values(box, 30);
  for (int j = 6; j < 30; ++j) EXPECT_NEAR(found.values[j], exact[j], 1e-10 * exact[j]) << j;
  // The step after the projection lowered nothing: the projection itself was exact.
  EXPECT_LT(found.errors.maxCoeff(), 1e-10);
}

TEST(Amls, FrequenciesComeFromAboveAndFallAsTheCutOffRises) {
  const auto box = spring_box(9, 8, 7);
  const VectorXd exact = dense_values(box, 40);
  double last = 1e300;
  for (const double cutoff : {1.2, 1.8, 3.0}) {
    const EigenResult found = direct(box, small_leaves(40, cutoff, 1));
    ASSERT_TRUE(found.ok()) << found.message;
    const VectorXd error = (found.values - exact).tail(34).cwiseQuotient(exact.tail(34));
    EXPECT_GT(error.minCoeff(), -1e-10);  // only rounding may go below
    EXPECT_LT(error.maxCoeff(), last);
    last = error.maxCoeff();
  }
}

TEST(Amls, TheErrorOfABoxIsBelowTheRequestedAccuracy) {
  const auto box = spring_box(12, 10, 9);
  const ModeSet exact = solve_modes(box.K, box.M, by_count(40, EigenMethod::kArpack));
  for (const double accuracy : {5e-3, 2e-4}) {
    EigenOptions options = by_count(40, EigenMethod::kAmls);
    options.accuracy = accuracy;
    options.rigid = box.rigid;
    const ModeSet modes = solve_modes(box.K, box.M, options);
    EXPECT_EQ(modes.method, "amls");
    EXPECT_EQ(modes.rigid, 6);
    ASSERT_EQ(modes.errors.size(), 40);
    EXPECT_LE(modes.errors.maxCoeff(), accuracy);
    const VectorXd error = (modes.frequencies_hz() - exact.frequencies_hz())
                               .tail(34)
                               .cwiseQuotient(exact.frequencies_hz().tail(34));
    EXPECT_GT(error.minCoeff(), -1e-9);
    EXPECT_LT(error.maxCoeff(), accuracy);
    // The 20 lowest: cosines of the angles between both subspaces, in M.
    const MatrixXd cosines =
        exact.vectors.leftCols(20).transpose() * (MatrixXd(box.M) * modes.vectors.leftCols(24));
    EXPECT_GT(dense::singular_values(cosines).minCoeff(), 1.0 - accuracy);
    const MatrixXd gram = modes.vectors.transpose() * (MatrixXd(box.M) * modes.vectors);
    EXPECT_LT((gram - MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Amls, RepeatedRunsGiveTheSameBits) {
  const auto box = spring_box(12, 10, 9);
  const EigenOptions options = by_count(30, EigenMethod::kAmls);
  const ModeSet one = solve_modes(box.K, box.M, options);
  const ModeSet two = solve_modes(box.K, box.M, options);
  EXPECT_EQ(one.values, two.values);
  EXPECT_EQ(one.vectors, two.vectors);
}

TEST(Amls, ByFrequencyTheProofSaysHowManyThereAre) {
  const auto box = spring_box(12, 10, 9);
  const ModeSet many = solve_modes(box.K, box.M, by_count(40));
  for (const int wanted : {10, 30}) {
    EigenOptions options;
    options.method = EigenMethod::kAmls;
    options.fmax_hz =
        0.5 * (hz_of_value(many.values[wanted - 1]) + hz_of_value(many.values[wanted]));
    const ModeSet modes = solve_modes(box.K, box.M, options);
    EXPECT_EQ(modes.size(), wanted);
    EXPECT_TRUE(modes.proof.proved);
  }
}

TEST(Amls, ALimitWithinTheErrorOfAFrequencyIsCountedButNotProved) {
  const auto box = spring_box(12, 10, 9);
  const ModeSet exact = solve_modes(box.K, box.M, by_count(50, EigenMethod::kArpack));
  EigenOptions loose;
  loose.method = EigenMethod::kAmls;
  loose.accuracy = 0.1;
  loose.amls_cutoff = 1.3;
  EigenOptions count = loose;
  count.count = 40;
  count.prove_count = false;
  const ModeSet rough = solve_modes(box.K, box.M, count);
  Index worst = 0;  // the mode with the largest error, separated from the next
  for (Index j = 6; j < 40; ++j) {
    const auto error = [&](Index k) { return rough.values[k] / exact.values[k] - 1.0; };
    if (rough.values[j] < exact.values[j + 1] && error(j) > error(worst)) worst = j;
  }
  ASSERT_GT(rough.values[worst], (1.0 + 1e-7) * exact.values[worst]);
  // Between the exact value and that of AMLS: inertia counts the mode, AMLS finds it above the
  // limit.
  loose.fmax_hz =
      hz_of_value(exact.values[worst] + 0.02 * (rough.values[worst] - exact.values[worst]));
  const ModeSet modes = solve_modes(box.K, box.M, loose);
  EXPECT_EQ(modes.proof.below, worst + 1);
  EXPECT_EQ(modes.size(), worst + 1);
  EXPECT_GT(modes.values[worst], value_of_hz(loose.fmax_hz));
  EXPECT_FALSE(modes.proof.proved);
  modes::PartModes part;
  part.modes = modes;
  EXPECT_NE(modes::describe(part).back().find("not proved: inertia counts"), std::string::npos)
      << modes::describe(part).back();
  // Without the count that mode is omitted, and the range known to be complete ends below the
  // limit.
  loose.prove_count = false;
  const ModeSet uncounted = solve_modes(box.K, box.M, loose);
  EXPECT_EQ(uncounted.size(), worst);
  EXPECT_LT(uncounted.next_value, exact.values[worst]);
  // In the middle of a wide gap the same errors do not matter.
  Index wide = 10;
  for (Index j = 10; j < 40; ++j)
    if (exact.values[j + 1] / exact.values[j] > exact.values[wide + 1] / exact.values[wide])
      wide = j;
  loose.prove_count = true;
  loose.fmax_hz = hz_of_value(0.5 * (exact.values[wide] + exact.values[wide + 1]));
  const ModeSet clear = solve_modes(box.K, box.M, loose);
  EXPECT_EQ(clear.size(), wide + 1);
  EXPECT_TRUE(clear.proof.proved);
}

TEST(Amls, ByFrequencyWithoutProofItSolvesOnceForAboutTheRightCount) {
  const auto box = spring_box(10, 9, 8);
  const ModeSet many = solve_modes(box.K, box.M, by_count(120));
  for (const EigenMethod method : {EigenMethod::kAmls, EigenMethod::kBlockLanczos}) {
    EigenOptions options;
    options.method = method;
    options.prove_count = false;
    options.fmax_hz = hz_of_value(0.5 * (many.values[99] + many.values[100]));
    const ModeSet modes = solve_modes(box.K, box.M, options);
    EXPECT_EQ(modes.size(), 100);
    EXPECT_FALSE(modes.proof.proved);
    EigenOptions known = by_count(150, method);  // 50 % more modes is the cost of a poor estimate
    known.prove_count = false;
    EXPECT_LT(modes.solves, solve_modes(box.K, box.M, known).solves + ModeDensity::kSolves);
  }
}

TEST(Amls, AnEstimateTooLowIsCorrectedWithTheFactorRecomputed) {
  // Many values just below the limit: the density, smooth there, counts about half of them.
  const auto box = spring_box(8, 7, 6);
  const VectorXd values = solve_modes(box.K, box.M, by_count(40)).values;
  constexpr int kOscillators = 150;
  const auto with_oscillators = [](const SparseMatrix& lower, double value, double spread) {
    const auto n = static_cast<int>(lower.rows());
    SparseMatrix out(n + kOscillators, n + kOscillators);
    out.reserve(lower.nonZeros() + kOscillators);
    for (int j = 0; j < n; ++j) {
      out.startVec(j);
      for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
        out.insertBack(it.row(), j) = it.value();
    }
    for (int j = n; j < n + kOscillators; ++j) {
      out.startVec(j);
      out.insertBack(j, j) = value + spread * (j - n) / kOscillators;
    }
    out.finalize();
    return out;
  };
  const double gap = values[31] - values[30];
  ASSERT_GT(gap, 1e-3 * values[31]);
  const SparseMatrix K = with_oscillators(box.K, values[30] + 0.1 * gap, 0.2 * gap);
  const SparseMatrix M = with_oscillators(box.M, 1.0, 0.0);
  const double limit = values[30] + 0.5 * gap, sigma = default_shift(K, M);

  const SupernodalFactor factor(SparseMatrix(K - sigma * M));
  const SymmetricProduct mass(reordered(M, factor.permutation()));
  const ModeDensity density(SubtreeProduct(factor, mass), K.rows(), EigenOptions().seed);
  ASSERT_LT(density.count_above(1.0 / (limit - sigma)), 31 + kOscillators - 40);

  for (const EigenMethod method : {EigenMethod::kAmls, EigenMethod::kBlockLanczos}) {
    EigenOptions options;
    options.method = method;
    options.fmax_hz = hz_of_value(limit);
    options.prove_count = false;
    const ModeSet found = solve_modes(K, M, options);
    EXPECT_EQ(found.size(), 31 + kOscillators) << name_of(method);
    EXPECT_EQ(found.method, name_of(method));
  }
}

TEST(Amls, TheDensityCountsModesToAHalf) {
  const auto box = spring_box(12, 10, 9);
  const double sigma = default_shift(box.K, box.M);
  const SupernodalFactor factor(SparseMatrix(box.K - sigma * box.M));
  const SymmetricProduct mass(reordered(box.M, factor.permutation()));
  const ModeDensity density(SubtreeProduct(factor, mass), box.K.rows(), 1);
  const VectorXd values = solve_modes(box.K, box.M, by_count(300)).values;
  for (const int count : {30, 100, 290}) {
    const double nu = 1.0 / (0.5 * (values[count - 1] + values[count]) - sigma);
    // 16 random vectors estimate `count` modes with a deviation of sqrt(2 / (16 count)): 6.5 % of
    // 30.
    EXPECT_GT(density.count_above(nu), 0.8 * count);
    EXPECT_LT(density.count_above(nu), 1.5 * count);  // few of the ten nodes are near
    const double back = density.count_above(density.nu_above(count));
    EXPECT_NEAR(back, count, 0.01 * count);  // nu is accurate to 0.1 %
  }
}

TEST(Amls, ATightAccuracyProvesTheCountUnlessDisabled) {
  const auto box = spring_box(9, 8, 7);
  EigenOptions options = by_count(20, EigenMethod::kAmls);
  options.accuracy = 1e-6;
  EXPECT_TRUE(solve_modes(box.K, box.M, options).proof.proved);
  options.prove_count = false;
  EXPECT_FALSE(solve_modes(box.K, box.M, options).proof.proved);
}

}  // namespace
}  // namespace clatter::sparse
