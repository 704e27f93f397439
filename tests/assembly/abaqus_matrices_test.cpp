// Our matrices against those that Abaqus wrote for a beam of C3D10 elements.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "assembly/assemble.hpp"
#include "small_solver.hpp"
#include "tests/shared_data.hpp"

namespace clatter::assembly::testing {
namespace {

using Entries = std::unordered_map<int64_t, double>;  // key 2^20 row + column, zero-based, lower

std::vector<double> numbers_in(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream stream(line);
  std::vector<double> values;
  for (double value; stream >> value;) values.push_back(value);
  return values;
}

/// *NODE and *ELEMENT of this one deck: millimetres, one-based, Abaqus order.
mesh::Mesh read_deck(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::vector<double>> nodes, cells;
  std::vector<std::vector<double>>* target = nullptr;
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("*", 0) == 0) {
      target = line.rfind("*Node", 0) == 0       ? &nodes
               : line.rfind("*Element,", 0) == 0 ? &cells
                                                 : nullptr;
      continue;
    }
    if (target != nullptr) target->push_back(numbers_in(line));
  }
  mesh::Mesh mesh;
  mesh.name = "abaqus_beam";
  mesh.regions = {"solid"};
  mesh.nodes.resize(static_cast<Eigen::Index>(nodes.size()), 3);
  for (size_t a = 0; a < nodes.size(); ++a)
    for (Eigen::Index d = 0; d < 3; ++d)
      mesh.nodes(static_cast<Eigen::Index>(a), d) = nodes[a][static_cast<size_t>(d) + 1];
  mesh::CellBlock block;
  block.nodes.resize(static_cast<Eigen::Index>(cells.size()), 10);
  const auto order = mesh::traits(block.type).to_vtk;
  for (size_t c = 0; c < cells.size(); ++c)
    for (size_t a = 0; a < 10; ++a)
      block.nodes(static_cast<Eigen::Index>(c), order[a]) = static_cast<int>(cells[c][a + 1]) - 1;
  mesh.cells.push_back(block);
  return mesh;
}

Entries read_entries(const std::filesystem::path& path) {
  std::ifstream file(path);
  Entries entries;
  int64_t i = 0, j = 0;
  for (double value = 0.0; file >> i >> j >> value;)
    if (i >= j) entries[((i - 1) << 20) + (j - 1)] = value;
  return entries;
}

/// Largest difference of any entry, over the largest entry; supported rows are left out.
double worst_difference(const SparseMatrix& ours, const Entries& theirs,
                        const std::vector<bool>& held) {
  double worst = 0.0, largest = 0.0;
  size_t met = 0;
  for (Eigen::Index c = 0; c < ours.cols(); ++c)
    for (SparseMatrix::InnerIterator it(ours, c); it; ++it) {
      const auto found = theirs.find((it.row() << 20) + c);
      met += found != theirs.end() ? 1 : 0;
      if (held[static_cast<size_t>(it.row())] || held[static_cast<size_t>(c)]) continue;
      const double other = found != theirs.end() ? found->second : 0.0;
      worst = std::max(worst, std::abs(it.value() - other));
      largest = std::max(largest, std::abs(other));
    }
  EXPECT_EQ(met, theirs.size()) << "entries of theirs that we do not have";
  return worst / largest;
}

const Material kAbaqusSteel{208000.0, 0.3, 7.85e-9};  // N, mm, t
constexpr int kHeldNodes[] = {3, 4, 6, 7, 293, 395, 511, 512, 514};

class AbaqusBeam : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = test::shared_data("abaqus_beam");
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no reference data at " << folder;
    mesh_ = read_deck(folder / "abq_beam.inp");
    ASSERT_EQ(mesh_.nodes.rows(), 518);
    ASSERT_EQ(mesh_.cells[0].nodes.rows(), 233);
    matrices_ = assemble(mesh_, materials_of(mesh_, kAbaqusSteel), node_pattern(mesh_));
    held_.assign(3 * 518, false);
    for (const int node : kHeldNodes)
      for (int d = 0; d < 3; ++d) held_[static_cast<size_t>(3 * (node - 1) + d)] = true;
  }
  mesh::Mesh mesh_;
  NodalMatrices matrices_;
  std::vector<bool> held_;
};

TEST_F(AbaqusBeam, StiffnessAgreesEntryByEntry) {
  // Abaqus takes four points too; its cells are straight to seven digits of the coordinates.
  const Entries theirs = read_entries(test::shared_data("abaqus_beam") / "STIF1_coord_style.mtx");
  EXPECT_LT(worst_difference(matrices_.K, theirs, held_), 1e-6);
}

TEST_F(AbaqusBeam, MassAgreesEntryByEntry) {
  const Entries theirs = read_entries(test::shared_data("abaqus_beam") / "MASS1_coord_style.mtx");
  EXPECT_LT(worst_difference(matrices_.M, theirs, std::vector<bool>(held_.size(), false)), 1e-6);
}

TEST_F(AbaqusBeam, FrequenciesAgree) {
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  SparseMatrix keep(3 * 518, 3 * (518 - 9));
  int32_t next = 0;
  for (int32_t dof = 0; dof < 3 * 518; ++dof)
    if (!held_[static_cast<size_t>(dof)]) entries.emplace_back(dof, next++, 1.0);
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
