// SPDX-License-Identifier: GPL-3.0-or-later
// Heat conduction against closed forms; what a [[heat]] refuses.
#include "core/fe/heat.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "assembly/recipe/profile.hpp"
#include "core/base/artefact.hpp"
#include "one_cell.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"
#include "two_parts.hpp"
#include "warm_wall.hpp"

namespace clatter::assembly::testing {
namespace {

using mesh::CellType;

fe::Material conductor(double k) {
  fe::Material material = kSteel;
  material.conductivity.setConstant(k);
  return material;
}

TEST(CellConduction, OfAUnitTetrahedronByHand) {
  // Gradients (-1,-1,-1), (1,0,0), (0,1,0), (0,0,1), volume 1/6.
  Eigen::Matrix4d by_hand;
  by_hand << 3, -1, -1, -1, -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  const Eigen::MatrixXd K =
      fe::cell_conduction(CellType::kTet4, reference(CellType::kTet4), conductor(12.0));
  EXPECT_LT((K - 2.0 * by_hand).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(CellConduction, AConstantGradientHasItsEnergyInEveryDistortedCell) {
  // T^T K T = grad T . k grad T V and K 1 = 0, with conductivities along turned axes.
  fe::Material material = conductor(1.0);
  material.conductivity << 3.0, 5.0, 11.0;
  fe::Axes axes;
  axes.frame << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // its x is the global y
  material.axes = axes;
  const Eigen::Vector3d slope(2.0, -1.0, 0.5);
  const double energy = 11.0 * 4.0 + 3.0 * 1.0 + 5.0 * 0.25;
  for (const CellType type : kAllCells) {
    const mesh::CellNodes x = distorted(type);
    const Eigen::MatrixXd K = fe::cell_conduction(type, x, material);
    double volume = 0.0;
    const mesh::CellRule& rule = mesh::fine_rule(type);
    for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
      const Eigen::Matrix3d J =
          x.transpose() * mesh::cell_shape(type, rule.points.row(q).transpose()).gradient;
      volume += rule.weights(q) * J.determinant();
    }
    const Eigen::VectorXd T = x * slope;
    // Rules that are exact for dN/dx det J conserve heat; the energy of a straight field is one.
    EXPECT_NEAR(T.dot(K * T), energy * volume, 1e-12 * energy) << mesh::traits(type).name;
    EXPECT_LT((K * Eigen::VectorXd::Ones(x.rows())).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(CellConduction, AnInvertedCellIsRefused) {
  mesh::CellNodes x = reference(CellType::kTet4);
  x.row(3) *= -1.0;
  test::expect_parts(
      test::refusal_of([&] { fe::cell_conduction(CellType::kTet4, x, conductor(1.0)); }),
      {"conduction at (", "found det J = -1, expected > 0 (inverted cell)"});
}

TEST(Heat, AWallBetweenTwoFilmsHasResistancesInSeries) {
  const double area = 0.02, flux = 280.0 / (1.0 / 500.0 + 0.4 / 50.0 + 1.0 / 200.0);
  for (const CellType type : kAllCells) {
    const BuiltModel built = build_all(wall_of(type), kIron + kWall);
    const fe::HeatField& warm = built.model.heat.at("warm");
    for (Eigen::Index a = 0; a < built.model.nodes.rows(); ++a) {
      const double exact = 293.15 + flux / 500.0 + flux / 50.0 * built.model.nodes(a, 2);
      EXPECT_NEAR(warm.temperature(a), exact, 1e-9) << mesh::traits(type).name;
    }
    ASSERT_EQ(warm.boundaries, (std::vector<std::string>{"film z0", "film z1"}));
    EXPECT_NEAR(warm.heat(0), -flux * area, 1e-9 * flux);
    EXPECT_NEAR(warm.heat(1), flux * area, 1e-9 * flux);
    EXPECT_LT(built.certificate.heat_balance.at("warm"), 1e-11);
  }
}

TEST(Heat, FixedTemperaturesFluxAndSourceAddUp) {
  // k T'' = -s: T = T0 + (q'' + s L) z / k - s z^2 / (2 k).
  BlockOptions options;
  options.type = CellType::kHex20;  // straight ones contain quadratic fields
  const mesh::Mesh mesh = block_mesh({2, 2, 3}, brick({0.1, 0.2, 0.4}), options);
  const BuiltModel built = build_all(mesh, kIron + R"(
[[heat]]
name = "warm"
[[heat.fixed]]
surface = "z0"
temperature_c = 90.0
[[heat.flux]]
surface = "z1"
flux = 2.0e4
[[heat.source]]
power = 1.0e5
)");
  const fe::HeatField& warm = built.model.heat.at("warm");
  for (Eigen::Index a = 0; a < built.model.nodes.rows(); ++a) {
    const double z = built.model.nodes(a, 2);
    const double exact = 363.15 + (2e4 + 1e5 * 0.4) * z / 50.0 - 1e5 * z * z / 100.0;
    EXPECT_NEAR(warm.temperature(a), exact, 1e-9) << z;
  }
  ASSERT_EQ(warm.boundaries, (std::vector<std::string>{"flux z1", "source body", "fixed z0"}));
  EXPECT_NEAR(warm.heat(0), 2e4 * 0.02, 1e-9);
  EXPECT_NEAR(warm.heat(1), 1e5 * 0.008, 1e-9);
  EXPECT_NEAR(warm.heat(2), -1200.0, 1e-8);
  EXPECT_LT(warm.balance, 1e-11);
}

TEST(Heat, OfAPartInABathOfOneTemperatureIsNone) {
  const BuiltModel built = build_all(wall_of(CellType::kTet10), kIron + R"(
[[heat]]
name = "bath"
[[heat.film]]
surface = "skin"
coefficient = 500.0
temperature_c = 80.0
)");
  const fe::HeatField& bath = built.model.heat.at("bath");
  EXPECT_LT((bath.temperature.array() - 353.15).abs().maxCoeff(), 1e-10);
  EXPECT_LT(bath.balance, 1e-8);
}

TEST(Heat, AFilmThatVariesAlongADirectionHasItsMean) {
  // One body of nearly one temperature: the heat of h (T_f - T) over a linear h T_f.
  std::string hot = kIron;
  hot.replace(hot.find("50.0"), 4, "1.0e9");
  const BuiltModel built = build_all(wall_of(CellType::kHex8), hot + R"(
[[heat]]
name = "warm"
[[heat.film]]
surface = "x1"
along = [0.0, 0.0, 1.0]
at = [0.0, 0.1, 0.3]
coefficient = [100.0, 200.0, 400.0]
temperature_c = 100.0
[[heat.fixed]]
surface = "x0"
temperature_c = 0.0
)");
  // Mean of h over 0.4 m: 150 on 0.1 m, 300 on 0.2 m, 400 on 0.1 m.
  const double heat = 0.2 * 100.0 * (150.0 * 0.1 + 300.0 * 0.2 + 400.0 * 0.1);
  EXPECT_NEAR(built.model.heat.at("warm").heat(0), heat, 0.02 * heat);
}

TEST(Profile, IsLinearBetweenItsPositionsAndConstantBeyond) {
  const Profile profile{Eigen::Vector3d::UnitZ(), {0.0, 0.1, 0.3}, {100.0, 200.0, 400.0}};
  const auto at = [&](double z) { return profile(Eigen::Vector3d(5.0, -7.0, z)); };
  EXPECT_EQ(at(-1.0), 100.0);
  EXPECT_NEAR(at(0.05), 150.0, 1e-12);
  EXPECT_NEAR(at(0.2), 300.0, 1e-12);
  EXPECT_EQ(at(0.5), 400.0);
}

/// Two slabs of 1 x 1 x 1 m with different meshes, tied at z = 1; heat along z.
std::string two_slabs(const std::string& more) {
  return R"(
[material.a]
regions = ["a"]
E = 1.0e11
nu = 0.3
rho = 7800.0
conductivity = 40.0
[material.b]
regions = ["b"]
E = 1.0e11
nu = 0.3
rho = 7800.0
conductivity = 160.0
[[tie]]
name = "joint"
slave = "a_z1"
master = "b_z0"
[[heat]]
name = "warm"
[[heat.fixed]]
surface = "a_z0"
temperature_c = 0.0
[[heat.fixed]]
surface = "b_z1"
temperature_c = 100.0
)" + more;
}

class HeatTie : public ::testing::TestWithParam<std::tuple<CellType, CellType>> {};
INSTANTIATE_TEST_SUITE_P(Cells, HeatTie,
                         ::testing::Values(std::tuple{CellType::kHex8, CellType::kTet4},
                                           std::tuple{CellType::kTet10, CellType::kHex20},
                                           std::tuple{CellType::kWedge15, CellType::kTet10}));

TEST_P(HeatTie, PassesAConstantFluxWithoutAJumpOrThroughAConductance) {
  const auto [lower, upper] = GetParam();
  const mesh::Mesh mesh = two_parts(slab(lower, {2, 3, 2}, 0.2), slab(upper, {3, 2, 2}, 0.2, 1.0));
  for (const double h : {0.0, 80.0}) {
    const std::string contact =
        h > 0.0 ? "[[heat.contact]]\ntie = \"joint\"\nconductance = 80.0\n" : "";
    const fe::FeModel model = build_all(mesh, two_slabs(contact)).model;
    const double flux = 100.0 / (1.0 / 40.0 + 1.0 / 160.0 + (h > 0.0 ? 1.0 / h : 0.0));
    const fe::HeatField& warm = model.heat.at("warm");
    const Eigen::Index in_a = warm.temperature.size() - slab(upper, {3, 2, 2}, 0.2).nodes.rows();
    for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
      const double z = model.nodes(a, 2);
      const double exact = a < in_a ? flux * z / 40.0 : 100.0 - flux * (2.0 - z) / 160.0;
      EXPECT_NEAR(warm.temperature(a) - 273.15, exact, 1e-8) << z << " " << h;
    }
    EXPECT_NEAR(warm.heat(1), flux, 1e-8 * flux);
    EXPECT_LT(warm.balance, 1e-10);
  }
}

/// The message with which a wall's recipe is refused.
std::string refused(const std::string& toml) {
  return test::refusal_of([&] { build_all(wall_of(CellType::kHex8), toml); });
}

TEST(HeatInput, ABodyWhoseTemperatureNothingFixesIsRefused) {
  test::expect_parts(
      refused(kIron + "[[heat]]\nname = \"warm\"\n[[heat.flux]]\nsurface = \"z1\"\nflux = 1.0\n"),
      {"test.fe.toml:8: heat warm: found nothing that fixes the temperature of the body at (",
       "expected a film or a fixed temperature on it"});
  // Two parts, only one of them with a film.
  const mesh::Mesh mesh =
      two_parts(slab(CellType::kHex8, {1, 1, 1}, 0.0), slab(CellType::kHex8, {1, 1, 1}, 0.0, 1.0));
  std::string apart = two_slabs("");
  apart.erase(apart.find("[[tie]]"), apart.find("[[heat]]") - apart.find("[[tie]]"));
  apart.erase(apart.rfind("[[heat.fixed]]"));
  test::expect_parts(test::refusal_of([&] { build_all(mesh, apart); }),
                     {"found nothing that fixes the temperature of the body at (0, 0, 1) m"});
}

TEST(HeatInput, AFilmInsideThePartIsRefused) {
  mesh::Mesh mesh = wall_of(CellType::kHex8);
  mesh::SurfaceBuilder inside;
  const auto& first = mesh.cells[0].nodes;
  // The face at the end of the first cell of three along z.
  std::vector<int32_t> top;
  for (const int32_t node : first.row(0))
    if (mesh.nodes(node, 2) > 0.06) top.push_back(node);
  ASSERT_EQ(top.size(), 4u);
  inside.add(mesh::FaceType::kQuad4, top);
  mesh.surfaces["inside"] = inside.finish();
  for (const char* boundary : {"[[heat.film]]\nsurface = \"inside\"\ncoefficient = "
                               "1.0\ntemperature_c = 20.0\n",
                               "[[heat.flux]]\nsurface = \"inside\"\nflux = 1.0\n"})
    test::expect_parts(test::refusal_of([&] { build_all(mesh, kIron + kWall + boundary); }),
                       {"heat warm: found a face of inside inside the part, at (",
                        "expected faces of its boundary"});
}

TEST(Heat, MidSideNodesOfStraightEdgesHaveTheMeanOfTheirEnds) {
  BlockOptions options;
  options.type = CellType::kHex20;
  mesh::Mesh mesh = block_mesh({1, 1, 1}, brick({0.1, 0.2, 0.4}), options);
  // An upright edge and the parabola of a source along it.
  const auto ends = mesh.cells[0].nodes.row(0).head(8);
  int32_t middle = -1, low = -1, high = -1;
  for (int32_t a = 0; a < mesh.nodes.rows(); ++a) {
    if (mesh.nodes.row(a).head<2>().norm() > 1e-12) continue;
    (mesh.nodes(a, 2) < 0.1 ? low : mesh.nodes(a, 2) > 0.3 ? high : middle) = a;
  }
  ASSERT_TRUE((ends.array() == low).any() && (ends.array() == high).any() && middle >= 0);
  mesh.node_sets["edge"] = {middle};
  const std::string heat = kIron + kWall + "[[heat.source]]\npower = 1.0e6\n";
  const auto bow = [&](const std::string& toml) {
    const Eigen::VectorXd T = build_all(mesh, toml).model.heat.at("warm").temperature;
    return T(middle) - 0.5 * (T(low) + T(high));
  };
  EXPECT_GT(bow(heat), 100.0);
  EXPECT_NEAR(bow(heat + "[[straight_edges]]\nnode_set = \"edge\"\n"), 0.0, 1e-10);
}

TEST(HeatInput, WrongKeysAndValuesAreNamed) {
  std::string bare = kIron;
  bare.erase(bare.find("conductivity"));
  test::expect_parts(refused(bare + kWall),
                     {"heat[0].name: found no conductivity of the material of region \"body\""});
  std::string negative = kIron;
  negative.replace(negative.find("50.0"), 4, "-5.0");
  test::expect_parts(refused(negative), {"conductivity: found -5.0, expected a number above 0"});
  test::expect_parts(refused(kIron + kWall + kWall.substr(0, kWall.find("[[heat.film"))),
                     {"heat[1].name: found \"warm\" twice"});
  const std::string start = kIron + "[[heat]]\nname = \"warm\"\n";
  test::expect_parts(refused(start + "[[heat.film]]\nsurface = \"z0\"\ncoefficient = 0.0\n"),
                     {"coefficient: found 0"});
  test::expect_parts(refused(start + "[[heat.fixed]]\nsurface = \"z0\"\ntemperature_c = -300.0\n"),
                     {"temperature_c: found -300"});
  test::expect_parts(
      refused(start + "[[heat.film]]\nsurface = \"z0\"\nalong = [0, 0, 1]\n"
                      "at = [0.0, 1.0]\ncoefficient = [1.0]\ntemperature_c = 20.0\n"),
      {"coefficient: found 1 numbers for 2 positions `at`"});
  test::expect_parts(refused(start + "[[heat.contact]]\ntie = \"joint\"\nconductance = 1.0\n"),
                     {"tie: found \"joint\", expected one of: "});
  test::expect_parts(refused(start + "[[heat.fixed]]\nsurface = \"z0\"\ntemperature_c = 20.0\n"
                                     "[[heat.fixed]]\nsurface = \"x0\"\ntemperature_c = 30.0\n"),
                     {"found a node of x0 that fixed z0 fixes at another temperature"});
  test::expect_parts(refused(kIron + kWall +
                             "[[load]]\nname = \"t\"\nkind = \"temperature\"\n"
                             "heat = \"wram\"\n"),
                     {"heat: found \"wram\", expected one of: warm"});
  test::expect_parts(refused(kIron + kWall +
                             "[[load]]\nname = \"t\"\nkind = \"temperature\"\n"
                             "heat = \"warm\"\nvalue = 2.0\n"),
                     {"heat: heat and value exclude each other: give one source of temperatures"});
}

TEST(HeatInput, OneTieHasOneConductance) {
  const mesh::Mesh mesh =
      two_parts(slab(CellType::kHex8, {1, 1, 1}, 0.0), slab(CellType::kHex8, {1, 1, 1}, 0.0, 1.0));
  const std::string contact = "[[heat.contact]]\ntie = \"joint\"\nconductance = 1.0\n";
  test::expect_parts(test::refusal_of([&] { build_all(mesh, two_slabs(contact + contact)); }),
                     {"tie: found \"joint\" twice"});
}

TEST(HeatFile, ReturnsTheFieldsAndTheConductivity) {
  const std::filesystem::path path = test::scratch_path("heat.fe.h5");
  const fe::FeModel model = build_all(wall_of(CellType::kTet4), kIron + kWall).model;
  H5File file = H5File::create(path);
  write_provenance(file, {fe::kFeSchema, "", {}});
  fe::write_fe_model(file, model);
  file.commit();
  const fe::FeModel back = fe::read_fe_model(path);
  std::filesystem::remove(path);
  const fe::HeatField &warm = model.heat.at("warm"), &read = back.heat.at("warm");
  EXPECT_EQ(read.temperature, warm.temperature);
  EXPECT_EQ(read.boundaries, warm.boundaries);
  EXPECT_EQ(read.heat, warm.heat);
  EXPECT_EQ(read.balance, warm.balance);
  EXPECT_EQ(back.cells.materials[0].conductivity, Eigen::Vector3d::Constant(50.0));
}

}  // namespace
}  // namespace clatter::assembly::testing
