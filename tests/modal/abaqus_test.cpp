// SPDX-License-Identifier: GPL-3.0-or-later
// Matrices that Abaqus wrote for a C3D10 beam, in N, mm and t: ten frequencies known.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "core/modes/analysis.hpp"
#include "tests/core/sparse/spring_models.hpp"
#include "tests/shared_data.hpp"

namespace clatter::modal {
namespace {

/// "row column value", 1-based, both triangles.
SparseMatrix read_coordinates(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0, column = 0, size = 0;
  double value = 0.0;
  while (file >> row >> column >> value) {
    size = std::max({size, row, column});
    entries.emplace_back(row - 1, column - 1, value);
  }
  return test::from_triplets(size, entries);
}

TEST(AbaqusMatrices, TenFrequenciesOfTheBeamAreFound) {
  const auto data = test::shared_data("abaqus_beam");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no " << data;
  const SparseMatrix K = read_coordinates(data / "STIF1_coord_style.mtx");
  const SparseMatrix M = read_coordinates(data / "MASS1_coord_style.mtx");
  std::vector<int32_t> free_dofs;
  for (int j = 0; j < K.cols(); ++j) {
    if (K.coeff(j, j) < 1e35) free_dofs.push_back(j);  // Abaqus holds a DoF by 1e36 on its diagonal
  }
  const Eigen::VectorXd expected{{66.79947, 66.81689, 416.1196, 416.2134, 1154.0607, 1154.3076,
                                  1596.5447, 2235.0158, 2235.2421, 2578.8752}};
  for (const sparse::EigenMethod method :
       {sparse::EigenMethod::kBlockLanczos, sparse::EigenMethod::kArpack}) {
    sparse::EigenOptions options;
    options.count = 10;
    options.method = method;
    const sparse::ModeSet modes =
        sparse::solve_modes(modes::principal_submatrix(K, free_dofs),
                            modes::principal_submatrix(M, free_dofs), options);
    EXPECT_EQ(modes.rigid, 0);
    EXPECT_TRUE(modes.proof.proved);
    const Eigen::VectorXd hz = modes.frequencies_hz();
    for (int j = 0; j < 10; ++j) {
      EXPECT_NEAR(hz[j], expected[j], 1e-6 * expected[j]);  // seven digits were printed
    }
  }
}

}  // namespace
}  // namespace clatter::modal
