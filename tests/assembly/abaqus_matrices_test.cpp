// SPDX-License-Identifier: GPL-3.0-or-later
// Our matrices against those that Abaqus wrote for a beam of C3D10 elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <unordered_map>

#include "core/fe/assemble.hpp"
#include "mesh/deck/abaqus/reader.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {
namespace {

using Entries = std::unordered_map<int64_t, double>;  // key 2^20 row + column, zero-based, lower

Entries read_entries(const std::filesystem::path& path) {
  std::ifstream file(path);
  Entries entries;
  int64_t i = 0, j = 0;
  for (double value = 0.0; file >> i >> j >> value;)
    if (i >= j) entries[((i - 1) << 20) + (j - 1)] = value;
  return entries;
}

/// Largest difference of any entry, over the largest entry; supported rows are excluded.
double worst_difference(const SparseMatrix& ours, const Entries& theirs,
                        const std::vector<bool>& held) {
  double worst = 0.0, largest = 0.0;
  size_t met = 0;
  for (Eigen::Index c = 0; c < ours.cols(); ++c)
    for (SparseMatrix::InnerIterator it(ours, c); it; ++it) {
      const auto found = theirs.find((it.row() << 20) + c);
      met += found != theirs.end() ? 1 : 0;
      if (held[it.row()] || held[c]) continue;
      const double other = found != theirs.end() ? found->second : 0.0;
      worst = std::max(worst, std::abs(it.value() - other));
      largest = std::max(largest, std::abs(other));
    }
  EXPECT_EQ(met, theirs.size()) << "entries of theirs that we do not have";
  return worst / largest;
}

const std::filesystem::path kFolder = CLATTER_SHARED_DATA "/abaqus_beam";
const fe::Material kAbaqusSteel{208000.0, 0.3, 7.85e-9};  // N, mm, t

class AbaqusBeam : public ::testing::Test {
 protected:
  void SetUp() override {
    mesh_ = mesh::deck::read_abaqus(kFolder / "abq_beam.inp", {}).mesh;
    ASSERT_EQ(mesh_.nodes.rows(), 518);
    ASSERT_EQ(mesh_.cells[0].nodes.rows(), 233);
    for (int32_t n = 0; n < 518; ++n)  // so that rows are Abaqus' rows
      ASSERT_TRUE(mesh_.node_ids.empty() || mesh_.node_ids[n] == n + 1);
    matrices_ = fe::assemble(mesh_, materials_of(mesh_, kAbaqusSteel), fe::node_pattern(mesh_));
    held_.assign(3 * 518, false);
    ASSERT_EQ(mesh_.node_sets.at("fixed").size(), 9U);
    for (const int32_t node : mesh_.node_sets.at("fixed"))
      for (int d = 0; d < 3; ++d) held_[3 * node + d] = true;
  }
  mesh::Mesh mesh_;
  fe::NodalMatrices matrices_;
  std::vector<bool> held_;
};

TEST_F(AbaqusBeam, StiffnessAgreesEntryByEntry) {
  // Abaqus also uses four points; its cells are straight to seven digits of the coordinates.
  const Entries theirs = read_entries(kFolder / "STIF1_coord_style.mtx");
  EXPECT_LT(worst_difference(matrices_.K, theirs, held_), 1e-6);
}

TEST_F(AbaqusBeam, MassAgreesEntryByEntry) {
  const Entries theirs = read_entries(kFolder / "MASS1_coord_style.mtx");
  EXPECT_LT(worst_difference(matrices_.M, theirs, std::vector<bool>(held_.size(), false)), 1e-6);
}

TEST_F(AbaqusBeam, FrequenciesAgree) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  SparseMatrix keep(3 * 518, 3 * (518 - 9));
  int32_t next = 0;
  for (int32_t dof = 0; dof < 3 * 518; ++dof)
    if (!held_[dof]) entries.emplace_back(dof, next++, 1.0);
  keep.setFromTriplets(entries.begin(), entries.end());
  const auto reduce = [&](const SparseMatrix& lower) {
    const SparseMatrix both = lower.selfadjointView<Eigen::Lower>();
    return SparseMatrix(
        SparseMatrix(keep.transpose() * both * keep).triangularView<Eigen::Lower>());
  };
  const Eigen::VectorXd hz = lowest_hz(reduce(matrices_.K), reduce(matrices_.M), 10);
  const double want[] = {66.79947,  66.81689,  416.1196,  416.2134,  1154.0607,
                         1154.3076, 1596.5447, 2235.0158, 2235.2421, 2578.8752};
  // The references carry seven digits.
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(hz(k) / want[k], 1.0, 2e-7) << "mode " << k + 1;
}

}  // namespace
}  // namespace clatter::assembly::testing
