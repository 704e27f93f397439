// SPDX-License-Identifier: GPL-3.0-or-later
// ARPACK, block Lanczos and AMLS on an elastic solid: the same frequencies, the same motions.
#include <gtest/gtest.h>

#include "core/dense/symmetric_eigen.hpp"
#include "core/modes/analysis.hpp"
#include "core/sparse/symmetric_product.hpp"
#include "tests/condense/solid_model.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kModes = 40;

struct Body {
  const char* name;
  int rigid;
  SparseMatrix K, M;
  MatrixXd motions;  // free rigid-body motions
};

/// A bar of square section, about 5 000 unknowns, free and held at one end: its bending modes come
/// in close pairs, slightly separated by the tetrahedral mesh.
const std::vector<Body>& bodies() {
  static const std::vector<Body> both = [] {
    const auto bar = test::solid_bar({0.25, 0.05, 0.05}, {10, 4, 4}, 0.3,
                                     "[[nodes]]\nname = \"foot\"\nnode_set = \"x0\"\n");
    std::vector<char> held(static_cast<size_t>(bar.size()), 0);
    for (const int32_t dof : bar.set("foot").dofs) held[dof] = 1;
    std::vector<int32_t> left;
    for (int32_t dof = 0; dof < bar.size(); ++dof)
      if (held[dof] == 0) left.push_back(dof);
    return std::vector<Body>{
        {"free", 6, bar.K, bar.M, bar.rigid},
        {"held", 0, modes::principal_submatrix(bar.K, left),
         modes::principal_submatrix(bar.M, left), MatrixXd(static_cast<Index>(left.size()), 0)}};
  }();
  return both;
}

sparse::ModeSet solve(const Body& body, sparse::EigenMethod method, double accuracy = 5e-3) {
  sparse::EigenOptions options;
  options.count = kModes;
  options.method = method;
  options.accuracy = accuracy;
  options.rigid = body.motions;
  sparse::ModeSet modes = sparse::solve_modes(body.K, body.M, options);
  EXPECT_EQ(modes.method, sparse::name_of(method));
  EXPECT_EQ(modes.rigid, body.rigid);
  return modes;
}

/// Modes [first, last) without a gap of 1 % between them, and the narrower relative gap around
/// them.
struct Cluster {
  Index first, last;
  double gap;
};

std::vector<Cluster> clusters_of(const VectorXd& values, int rigid) {
  constexpr double kGap = 0.01;
  std::vector<Cluster> out;
  Index first = rigid;
  double before = 1.0;
  for (Index j = rigid + 1; j < values.size(); ++j) {
    const double gap = values[j] / values[j - 1] - 1.0;
    if (gap < kGap) continue;
    out.push_back({first, j, std::min(before, gap)});
    first = j;
    before = gap;
  }
  return out;  // the cluster after the last gap may be incomplete
}

/// Sine of the largest principal angle, in M, between the motions of a cluster.
double largest_sine(const sparse::SymmetricProduct& M, const MatrixXd& X, const MatrixXd& Y,
                    const Cluster& at) {
  const Index count = at.last - at.first;
  const MatrixXd x = X.middleCols(at.first, count), y = Y.middleCols(at.first, count);
  const MatrixXd rest = y - x * (x.transpose() * (M * y));
  const MatrixXd gram = rest.transpose() * (M * rest);
  return std::sqrt(
      std::max(0.0, dense::symmetric_eigen(gram, dense::EigenParts::kValues).values.maxCoeff()));
}

TEST(Agreement, TheBarHasClosePairsOfBendingModes) {
  for (const Body& body : bodies()) {
    const sparse::ModeSet modes = solve(body, sparse::EigenMethod::kArpack);
    int pairs = 0;
    for (const Cluster& cluster : clusters_of(modes.values, body.rigid))
      pairs += cluster.last - cluster.first == 2 ? 1 : 0;
    EXPECT_GE(pairs, 5) << body.name;
  }
}

TEST(Agreement, BlockLanczosFindsTheFrequenciesAndMotionsOfArpack) {
  for (const Body& body : bodies()) {
    const sparse::SymmetricProduct M(body.M);
    const sparse::ModeSet arpack = solve(body, sparse::EigenMethod::kArpack);
    const sparse::ModeSet block = solve(body, sparse::EigenMethod::kBlockLanczos);
    EXPECT_TRUE(arpack.proof.proved && block.proof.proved);
    for (Index j = body.rigid; j < kModes; ++j)  // errors are squares of residuals, then rounding
      EXPECT_NEAR(block.values[j], arpack.values[j], 1e-9 * arpack.values[j]) << body.name << j;
    const double residual = arpack.residuals.maxCoeff() + block.residuals.maxCoeff();
    for (const Cluster& cluster : clusters_of(arpack.values, body.rigid))
      // Davis and Kahan: residual over gap, both relative to lambda; a cluster adds its residuals.
      EXPECT_LT(largest_sine(M, arpack.vectors, block.vectors, cluster),
                4.0 * residual / cluster.gap + 1e-9)
          << body.name << cluster.first;
  }
}

TEST(Agreement, AmlsFindsThemFromAboveWithinItsAccuracy) {
  for (const Body& body : bodies()) {
    const sparse::SymmetricProduct M(body.M);
    const sparse::ModeSet exact = solve(body, sparse::EigenMethod::kBlockLanczos);
    for (const double accuracy : {5e-3, 1e-5}) {
      const sparse::ModeSet amls = solve(body, sparse::EigenMethod::kAmls, accuracy);
      const auto elastic = [&](const sparse::ModeSet& modes) {
        return VectorXd(modes.frequencies_hz().tail(kModes - body.rigid));
      };
      const VectorXd error = (elastic(amls) - elastic(exact)).cwiseQuotient(elastic(exact));
      EXPECT_GT(error.minCoeff(), -1e-9) << body.name;  // only rounding goes below
      EXPECT_LT(error.maxCoeff(), accuracy) << body.name;
      for (const Cluster& cluster : clusters_of(exact.values, body.rigid)) {
        // Components of higher modes in a Ritz vector raise its value by sin^2 times their
        // distance.
        const double lifted =
            2.0 * error.segment(cluster.first - body.rigid, cluster.last - cluster.first)
                      .cwiseMax(1e-10)
                      .sum();
        const double sine = largest_sine(M, exact.vectors, amls.vectors, cluster);
        EXPECT_LT(sine * sine, 2.0 * lifted / cluster.gap) << body.name << cluster.first;
      }
    }
  }
}

TEST(Agreement, EachGivesTheSameBitsTwice) {
  const Body& body = bodies().front();
  for (const sparse::EigenMethod method :
       {sparse::EigenMethod::kArpack, sparse::EigenMethod::kBlockLanczos,
        sparse::EigenMethod::kAmls}) {
    const sparse::ModeSet one = solve(body, method), two = solve(body, method);
    EXPECT_EQ(one.values, two.values) << sparse::name_of(method);
    EXPECT_EQ(one.vectors, two.vectors) << sparse::name_of(method);
    EXPECT_EQ(one.residuals, two.residuals) << sparse::name_of(method);
  }
}

}  // namespace
}  // namespace clatter::modal
