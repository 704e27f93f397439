// SPDX-License-Identifier: GPL-3.0-or-later
// Gaskets and springs between reduced parts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/condense/part_files.hpp"

namespace clatter::condense {
namespace {

using namespace testing;

TEST(Gaskets, BetweenBlockAndPlateGiveTheFrequenciesOfAnotherProgram) {
  // Fine hex20 mesh of the reference; here 12 x 5 x (3 + 1) cells.
  const TwoFiles files = coarse_parts(32e3, {12, 5, 1});
  const std::string parts = part("block", files.block) + part("plate", files.plate);
  const auto compare = [&](double k, std::vector<double> expected, double error) {
    const VectorXd hz = free_hz(joined(parts + gasket(k, 0.1 * k)).model, 14);
    EXPECT_LT(hz(5), 1.0);
    for (size_t j = 0; j < expected.size(); ++j)
      EXPECT_NEAR(hz(static_cast<Eigen::Index>(6 + j)) / expected[j], 1.0, error) << k << " " << j;
  };
  compare(1e10, {914.273, 923.522, 949.334, 2852.055, 2856.546, 2886.564, 2895.540, 3104.95}, 3e-3);
  compare(1e11, {2817.97, 2906.996, 2992.431, 3474.136, 4165.218, 4899.958}, 5e-3);
  compare(1e12, {3726.712, 4116.550, 4956.348, 7679.689, 8200.820, 8222.275}, 5e-3);
  compare(1e14, {4010.957, 4539.350, 4973.513, 8264.332, 8642.573, 8973.118}, 5e-3);
}

TEST_F(CompleteParts, HardB14_AGasketIsATieAtItsStiffestAndTwoBodiesAtItsSoftest) {
  const std::string parts = part("block", files_.block) + part("plate", files_.plate);
  const VectorXd tied = free_hz(joined(parts + kTie).model, 16);
  const auto error = [&](double k) {
    const VectorXd hz = free_hz(joined(parts + gasket(k, k)).model, 16);
    return (hz.tail(10).array() / tied.tail(10).array() - 1.0).abs().maxCoeff();
  };
  // Of first order in 1 / k, until rounding: 1e16 N/m3 on steel is four digits from either.
  EXPECT_NEAR(error(1e14) / error(1e15), 10.0, 0.1);
  EXPECT_LT(error(1e16), 1e-5);
  EXPECT_LT(error(1e17), 1e-6);
  // Soft: both are rigid, and slide and bounce at the closed forms of masses per area.
  const VectorXd soft = free_hz(joined(parts + gasket(1e8, 1e7)).model, 13);
  const double m1 = 0.06 * 7200.0, m2 = 0.012 * 2700.0, mu = m1 * m2 / (m1 + m2);
  const double slide = std::sqrt(1e7 / mu) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(soft(6) / slide, 1.0, 1e-3);
  EXPECT_LT(soft(5), 0.1);
  double nearest = 1.0;
  for (int j = 6; j < 12; ++j)
    nearest = std::min(nearest, std::abs(soft(j) / (std::sqrt(10.0) * slide) - 1.0));
  EXPECT_LT(nearest, 1e-3);
  EXPECT_GT(soft(12), 500.0);
}

TEST_F(CompleteParts, OfTheGasketMeetTheSameGasketOnTheWholeMesh) {
  const fe::FeModel mesh =
      build_all(assembly::testing::two_parts(block({4, 2, 2}, CellType::kHex8),
                                             plate({3, 2, 1}, CellType::kHex8)),
                "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                    kAluminium + gasket(1e11, 1e10, "b_z0", "a_z1"))
          .model;
  const VectorXd expected = free_hz(mesh, 40);
  const VectorXd found = free_hz(
      joined(part("block", files_.block) + part("plate", files_.plate) + gasket(1e11, 1e10)).model,
      40);
  expect_same_elastic(found, expected, 1e-9);
}

TEST(Gaskets, LeaveRigidMotionsFreeAcrossAGap) {
  // The plate 3 mm above the block, on slave faces that the block's do not match.
  const mesh::Mesh above = box({0.01, 0.005, 0.063}, {0.22, 0.09, 0.012}, {3, 2, 1});
  const assembly::BuiltModel built =
      build_all(assembly::testing::two_parts(block({4, 2, 2}), above),
                "[material.a]\nregions = [\"a\"]\n" + kIron + "[material.b]\nregions = [\"b\"]\n" +
                    kAluminium + gasket(1e12, 1e11, "b_z0", "a_z1") + "distance = 0.005\n");
  EXPECT_LE(built.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_EQ(built.certificate.rigid_motions_held_by_equations.value(), 0.0);
  const VectorXd hz = free_hz(built.model, 7);
  EXPECT_LT(hz(5), 1.0);
  EXPECT_GT(hz(6), 100.0);
}

/// The nodes at the corners of a face that both meshes have, each a set of its own too.
std::string corners(const std::string& surface) {
  std::string toml;
  for (int c = 0; c < 4; ++c)
    toml +=
        fmt::format("[[sensor]]\nname = \"corner_{}\"\nsurface = \"{}\"\nnear = [{}, {}, 0.06]\n",
                    c, surface, c % 2 == 0 ? 0.0 : 0.24, c < 2 ? 0.0 : 0.1);
  return toml;
}

TEST(ReducedParts, HardB13_SoftSpringsBetweenThemBounceAtTheClosedForm) {
  const auto reduced = [](const std::string& name, const mesh::Mesh& mesh, const std::string& of,
                          const std::string& surface) {
    const fe::FeModel model =
        build_all(mesh, material("body", of) + kept(surface) + corners(surface)).model;
    CondenseOptions options = complete(model);
    options.boundary = {"joint", "corner_0", "corner_1", "corner_2", "corner_3"};
    return reduced_file(name, model, options);
  };
  std::string toml =
      part("block", reduced("block", block({4, 2, 2}, CellType::kHex8), kIron, "z1")) +
      part("plate", reduced("plate", plate({3, 2, 1}, CellType::kHex8), kAluminium, "z0"));
  const double k = 1e3;
  for (int c = 0; c < 4; ++c)
    toml += fmt::format(
        "[[spring]]\nstiffness = {}\nterms = [{{node_set = \"block_corner_{}\", direction = \"z\", "
        "coefficient = -1.0}}, {{node_set = \"plate_corner_{}\", direction = \"z\"}}]\n",
        k, c, c);
  const fe::FeModel engine = joined(toml).model;
  const VectorXd hz = free_hz(engine, 13);
  // Nine motions are free: three of the assembly in the plane for each part, three of both.
  EXPECT_LT(hz(8), 0.1);
  EXPECT_GT(hz(9), 5.0);
  EXPECT_GT(hz(12), 500.0);
  const double m1 = 0.24 * 0.1 * 0.06 * 7200.0, m2 = 0.24 * 0.1 * 0.012 * 2700.0;
  const double bounce = std::sqrt(4.0 * k * (m1 + m2) / (m1 * m2)) / (2.0 * std::numbers::pi);
  double nearest = 1.0;
  for (int j = 9; j < 12; ++j) nearest = std::min(nearest, std::abs(hz(j) / bounce - 1.0));
  EXPECT_LT(nearest, 2e-4);
}

}  // namespace
}  // namespace clatter::condense
