// SPDX-License-Identifier: GPL-3.0-or-later
// Eigen-solvers against closed forms and against each other.
#include <gtest/gtest.h>

#include <limits>

#include "core/base/error.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/mode_check.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/refusal.hpp"

namespace clatter::sparse {
namespace {

using Eigen::MatrixXd;
using test::by_count;
using test::free_chain;
using test::free_chain_value;
using test::kBoth;
using test::Pencil;
using test::spring_box;

TEST(Eigen, ResidualsAboveTheirLimitAreRefined) {
  const Pencil box = spring_box(12, 10, 9);
  EigenOptions options = by_count(9);
  options.sigma = 300.0 * default_shift(box.K, box.M);  // far away: all nu lie close together
  const ModeSet plain = solve_modes(box.K, box.M, options);
  const double largest = plain.residuals.maxCoeff();
  ASSERT_GT(largest, 1e-12);  // improvement is possible before rounding
  options.max_residual = 0.1 * largest;
  const ModeSet refined = solve_modes(box.K, box.M, options);
  EXPECT_LE(refined.residuals.maxCoeff(), options.max_residual);
  EXPECT_GT(refined.solves, plain.solves);
  const double scale = std::abs(plain.sigma);
  for (int j = 0; j < 9; ++j) EXPECT_NEAR(refined.values[j], plain.values[j], 1e-9 * scale);
  const MatrixXd mass = dense_symmetric(box.M);
  const MatrixXd gram = refined.vectors.transpose() * mass * refined.vectors;
  EXPECT_LT((gram - MatrixXd::Identity(9, 9)).cwiseAbs().maxCoeff(), 1e-10);
  options.max_residual = 1e-30;  // only rounding remains: the modes are those of K within 1e-12
  EXPECT_NO_THROW((void)solve_modes(box.K, box.M, options));
  ModeSet spoiled = refined;
  spoiled.vectors.col(8) += 1e-6 * Eigen::VectorXd::Unit(box.K.rows(), 17);
  spoiled.residuals[8] = 1.0;
  try {
    refuse_residuals(LocalPencil(box.K, box.M), spoiled, 1e-5);
    FAIL();
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("mode 9 at"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("backward error"), std::string::npos);
  }
}

TEST(Eigen, FreeChainHasItsClosedFormSpectrum) {
  const int n = 1000;
  const Pencil chain = free_chain(n);
  for (const EigenMethod method : kBoth) {
    const ModeSet modes = solve_modes(chain.K, chain.M, by_count(12, method));
    ASSERT_EQ(modes.size(), 12);
    EXPECT_EQ(modes.rigid, 1);
    EXPECT_TRUE(modes.proof.proved);
    for (int j = 1; j < 12; ++j) {
      const double exact = free_chain_value(n, j);
      EXPECT_NEAR(modes.values[j], exact, 1e-8 * exact) << j;  // shift-invert: eps * sigma/lambda_1
    }
  }
}

TEST(Eigen, BothMethodsAndDenseAgreeOnAFreeBox) {
  const auto box = spring_box(6, 5, 6);
  const EigenResult dense =
      solve_dense(dense_symmetric(box.K), MatrixXd(box.M), default_shift(box.K, box.M), 40);
  ASSERT_TRUE(dense.ok());
  for (const EigenMethod method : kBoth) {
    const ModeSet modes = solve_modes(box.K, box.M, by_count(40, method));
    EXPECT_EQ(modes.rigid, 6);
    for (int j = 6; j < 40; ++j)
      EXPECT_NEAR(modes.values[j], dense.values[j], 1e-9 * dense.values[j]) << j;
    const MatrixXd gram = modes.vectors.transpose() * (MatrixXd(box.M) * modes.vectors);
    EXPECT_LT((gram - MatrixXd::Identity(40, 40)).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT(modes.residuals.maxCoeff(), 1e-7);
  }
}

TEST(Eigen, AskingByFrequencyGivesAllModesBelowIt) {
  const auto box = spring_box(6, 5, 6);
  const ModeSet many = solve_modes(box.K, box.M, by_count(40));
  for (const int wanted : {6, 17, 30}) {
    EigenOptions options;
    options.fmax_hz =
        0.5 * (hz_of_value(many.values[wanted - 1]) + hz_of_value(many.values[wanted]));
    for (const EigenMethod method : kBoth) {
      options.method = method;
      const ModeSet modes = solve_modes(box.K, box.M, options);
      EXPECT_EQ(modes.size(), wanted);
      EXPECT_TRUE(modes.proof.proved);
    }
    options.prove_count = false;
    EXPECT_EQ(solve_modes(box.K, box.M, options).size(), wanted);
  }
}

TEST(Eigen, AFrequencyBelowTheFirstModeGivesNone) {
  const auto box = spring_box(6, 5, 6);
  const SparseMatrix held = box.K + 1e6 * box.M;
  EigenOptions options;
  options.fmax_hz = 1.0;
  const ModeSet modes = solve_modes(held, box.M, options);
  EXPECT_EQ(modes.size(), 0);
  EXPECT_TRUE(modes.proof.proved);
}

TEST(Eigen, InvalidRequestsAreRefused) {
  const Pencil chain = free_chain(10);
  const auto refusal = [&](const EigenOptions& request) {
    return test::refusal_of([&] { solve_modes(chain.K, chain.M, request); });
  };
  const std::string one = ", expected exactly one of them to be positive";
  EigenOptions options;
  EXPECT_EQ(refusal(options), "modes: found count = 0 and fmax_hz = 0" + one);
  options.count = 3;
  options.fmax_hz = 100.0;
  EXPECT_EQ(refusal(options), "modes: found count = 3 and fmax_hz = 100" + one);
  EXPECT_EQ(refusal(by_count(11)), "modes: found count = 11, expected at most 10 (the unknowns)");
  options.count = 0;
  options.fmax_hz = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal(options), "modes: found count = 0 and fmax_hz = nan" + one);
}

}  // namespace
}  // namespace clatter::sparse
