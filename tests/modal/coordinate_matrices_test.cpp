// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices as Abaqus writes them, "row column value" with 1e36 where a DoF is held: ten frequencies
// of two chains with formulas for them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/base/matrix_text.hpp"
#include "core/modes/analysis.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/scratch.hpp"

namespace clatter::modal {
namespace {

constexpr int kMasses = 60;                   // of each chain, the first one is held
constexpr double kSpring = 1e7, kMass = 0.1;  // the other chain is stiffer by 0.05 %
constexpr double kStiffer = 1.0005;

/// Both triangles, 17 digits.
std::filesystem::path write_coordinates(const std::string& name, const SparseMatrix& lower) {
  const auto path = test::scratch_path(fmt::format("{}.mtx", name));
  std::ofstream file(path);
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it) {
      file << fmt::format("{} {} {:.17g}\n", it.row() + 1, j + 1, it.value());
      if (it.row() != j) file << fmt::format("{} {} {:.17g}\n", j + 1, it.row() + 1, it.value());
    }
  return path;
}

TEST(CoordinateMatrices, TenFrequenciesOfHeldChainsAreFound) {
  test::Pencil chains = test::twice(test::free_chain(kMasses, kSpring, kMass));
  for (int j = kMasses; j < 2 * kMasses; ++j)
    for (SparseMatrix::InnerIterator it(chains.K, j); it; ++it) it.valueRef() *= kStiffer;
  chains.K.coeffRef(0, 0) = chains.K.coeffRef(kMasses, kMasses) = 1e36;
  const auto stiffness = write_coordinates("K", chains.K), mass = write_coordinates("M", chains.M);
  const SparseMatrix K = read_matrix_text(stiffness), M = read_matrix_text(mass);
  std::filesystem::remove(stiffness);
  std::filesystem::remove(mass);
  std::vector<int32_t> free_dofs;
  for (int j = 0; j < K.cols(); ++j)
    if (K.coeff(j, j) < 1e35) free_dofs.push_back(j);
  ASSERT_EQ(free_dofs.size(), 2u * (kMasses - 1));
  // Fixed at one end: lambda_j = 4 k/m sin^2((2 j - 1) pi / (2 (2 n + 1))) of n masses, close
  // pairs.
  std::vector<double> expected;
  for (const double k : {kSpring, kStiffer * kSpring})
    for (int j = 1; j <= 5; ++j) {
      const double sine =
          std::sin((2.0 * j - 1.0) * std::numbers::pi / (2.0 * (2.0 * (kMasses - 1) + 1.0)));
      expected.push_back(std::sqrt(4.0 * k / kMass) * sine / (2.0 * std::numbers::pi));
    }
  std::sort(expected.begin(), expected.end());
  for (const sparse::EigenMethod method : test::kBoth) {
    const sparse::ModeSet modes =
        sparse::solve_modes(modes::principal_submatrix(K, free_dofs),
                            modes::principal_submatrix(M, free_dofs), test::by_count(10, method));
    EXPECT_EQ(modes.rigid, 0);
    EXPECT_TRUE(modes.proof.proved);
    const Eigen::VectorXd hz = modes.frequencies_hz();
    ASSERT_EQ(hz.size(), 10);
    for (int j = 0; j < 10; ++j) EXPECT_NEAR(hz[j] / expected[j], 1.0, 1e-10) << j;
  }
}

}  // namespace
}  // namespace clatter::modal
