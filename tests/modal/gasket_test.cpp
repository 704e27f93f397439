// SPDX-License-Identifier: GPL-3.0-or-later
// Gaskets that follow curves and open, and models of the pressed state.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "block_mesh.hpp"
#include "core/base/artefact.hpp"
#include "core/base/log.hpp"
#include "modal/gasket_statics.hpp"
#include "modal/statics.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"
#include "two_parts.hpp"

namespace clatter::modal {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::build_all;
using assembly::testing::free_hz;
using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using fe::FeModel;
using mesh::CellType;

constexpr double kLength = 0.2, kWidth = 0.05, kHeight = 0.02;  // of both bodies [m]

/// A body on the ground and another one on it, each of nx x 2 x 1 cells.
mesh::Mesh bodies(int nx, CellType type = CellType::kHex20) {
  const auto body = [&](double bottom, int cells) {
    return block_mesh({cells, 2, 1},
                      [=](const Vector3d& x) -> Vector3d {
                        return Vector3d(kLength * x(0), kWidth * x(1), bottom + kHeight * x(2));
                      },
                      {type, false, false});
  };
  return assembly::testing::two_parts(body(0.0, nx), body(kHeight, nx));
}

std::string materials(double E) {
  return fmt::format(
      "[material.a]\nregions = [\"a\", \"b\"]\nE = {:.3e}\nnu = 0.3\nrho = 7800.0\n"
      "[[support]]\nname = \"ground\"\nsurface = \"a_z0\"\n",
      E);
}

std::string gasket(double normal, double tangential, const std::string& more = "") {
  return fmt::format(
      "[[gasket]]\nname = \"seal\"\nslave = \"b_z0\"\nmaster = \"a_z1\"\nnormal_stiffness = "
      "{:.1f}\ntangential_stiffness = {:.1f}\n{}",
      normal, tangential, more);
}

/// A force on the top of the upper body at x, and the case "pressed" of it.
std::string force_at(double x, double newton) {
  return fmt::format(
      "[[coupling]]\nname = \"hub\"\nsurface = \"b_z1\"\npoint = [{}, {}, {}]\n"
      "[[load]]\nname = \"push\"\nkind = \"force\"\nset = \"hub\"\nforce = [0.0, 0.0, -1.0]\n"
      "[[case]]\nname = \"pressed\"\nloads = {{ push = {} }}\n",
      x, 0.5 * kWidth, 2.0 * kHeight, newton);
}

FeModel built(const std::string& toml, int nx = 8) { return build_all(bodies(nx), toml).model; }

StaticCase solved(const FeModel& model, const std::string& name = "pressed") {
  return solve_static(model, {name}).cases.at(0);
}

/// 1e11 N/m3 up to 10 um, 5e11 beyond.
const std::string kTwoLines = "closure_um = [0.0, 10.0, 12.0]\npressure_mpa = [0.0, 1.0, 2.0]\n";

TEST(GasketCurve, IsLinearBetweenItsPointsAndOpensBelowTheFirst) {
  const fe::GasketCurve curve{{1e-5, 3e-5, 4e-5}, {0.0, 2e6, 5e6}};
  EXPECT_EQ(curve.line(0.9e-5), 0);
  EXPECT_EQ(curve.line(2e-5), 1);
  EXPECT_EQ(curve.line(9e-5), 2);
  EXPECT_EQ(curve.pressure_at(-1.0), 0.0);
  EXPECT_NEAR(curve.pressure_at(2e-5), 1e6, 1e-6);
  EXPECT_NEAR(curve.pressure_at(5e-5), 8e6, 1e-6);
  EXPECT_NEAR(curve.slope(2), 3e11, 1.0);
  EXPECT_EQ(curve.energy(0.0), 0.0);
  EXPECT_NEAR(curve.energy(3e-5), 20.0, 1e-9);
  EXPECT_NEAR(curve.energy(5e-5), 20.0 + 2e-5 * 5e6, 1e-9);
}

TEST(Gaskets, FollowTheirCurveUnderAnEvenPressure) {
  // 5 MPa on a gasket that begins to carry at 30 um: 30 + 10 + 8 um.
  const std::string curve = "closure_um = [30.0, 40.0, 42.0]\npressure_mpa = [0.0, 1.0, 2.0]\n";
  const FeModel model = built(materials(2.1e15) + gasket(5e12, 0.0, curve) +
                              "[[support]]\nname = \"x\"\nsurface = \"b_x0\"\ndirections = \"x\"\n"
                              "[[support]]\nname = \"y\"\nsurface = \"b_y0\"\ndirections = \"y\"\n"
                              "[[load]]\nname = \"push\"\nkind = \"pressure\"\nsurface = \"b_z1\"\n"
                              "[[case]]\nname = \"pressed\"\nloads = { push = 5.0e6 }\n");
  ASSERT_EQ(model.gaskets.size(), 1u);
  const StaticCase pressed = solved(model);
  ASSERT_EQ(pressed.gaskets.size(), 1u);
  const GasketSums sums = sums_of(model.gaskets[0], pressed.gaskets[0]);
  EXPECT_NEAR(sums.area, kLength * kWidth, 1e-12);
  EXPECT_NEAR(sums.pressed, kLength * kWidth, 1e-12);
  EXPECT_NEAR(sums.force, 5e6 * kLength * kWidth, 1e-3);
  EXPECT_NEAR(pressed.gaskets[0].closure.minCoeff(), 48e-6, 1e-9);
  EXPECT_NEAR(pressed.gaskets[0].closure.maxCoeff(), 48e-6, 1e-9);
  // 1 MPa x 10 um / 2 and (1 + 5) MPa x 8 um / 2.
  EXPECT_NEAR(pressed.energy, (5.0 + 24.0) * kLength * kWidth, 1e-4 * pressed.energy);
}

TEST(Gaskets, AForceBesideTheKernOpensThemAsTheClosedForm) {
  // A rigid body on a layer without pull: a triangle of pressure, 3 (L / 2 - e) long.
  const double eccentric = 0.06, newton = 2e4;
  const FeModel model =
      built(materials(2.1e15) +
                gasket(1e12, 1e10, "closure_um = [0.0, 1.0]\npressure_mpa = [0.0, 1.0]\n") +
                force_at(0.5 * kLength + eccentric, newton),
            40);
  const StaticCase pressed = solved(model);
  const double length = 3.0 * (0.5 * kLength - eccentric), most = 2.0 * newton / (kWidth * length);
  const fe::FeGasket& seal = model.gaskets.at(0);
  double error = 0.0;
  for (Index k = 0; k < seal.area.size(); ++k) {
    const double expected = most * std::max(0.0, 1.0 - (kLength - seal.points(k, 0)) / length);
    error = std::max(error, std::abs(pressed.gaskets[0].pressure(k) - expected));
  }
  EXPECT_LT(error, 2e-3 * most);
  EXPECT_NEAR(sums_of(seal, pressed.gaskets[0]).pressed, kWidth * length, 0.01 * kWidth * kLength);
  EXPECT_LT(pressed.steps, 12);
}

TEST(Gaskets, PressedAllOverHaveTheStiffnessOfTheirLine) {
  const std::string load = force_at(0.5 * kLength, 1e4);
  const FeModel linear = built(materials(2.1e11) + gasket(1e12, 1e11) + load);
  const FeModel curve =
      built(materials(2.1e11) +
            gasket(7e12, 1e11, "closure_um = [0.0, 1.0]\npressure_mpa = [0.0, 1.0]\n") + load);
  const VectorXd expected = solved(linear).displacement;
  const StaticCase found = solved(curve);
  EXPECT_EQ(sums_of(curve.gaskets[0], found.gaskets[0]).opening, 0.0);
  EXPECT_LT((found.displacement - expected).norm(), 1e-10 * expected.norm());
  EXPECT_NEAR(found.energy / solved(linear).energy, 1.0, 1e-10);
}

TEST(Gaskets, BetweenMovedFacesPressAsTheirCurveSays) {
  // The face itself is moved, so that its closure is by supported coordinates: 11 um, 1.5 MPa.
  const FeModel model = built(materials(2.1e17) + gasket(5e12, 0.0, kTwoLines) +
                              "[[support]]\nname = \"lid\"\nsurface = \"b_z0\"\n"
                              "[[load]]\nname = \"close\"\nkind = \"displacement\"\nsurface = "
                              "\"b_z0\"\ndirections = \"z\"\nvalue = -1.0e-6\n"
                              "[[case]]\nname = \"pressed\"\nloads = { close = 11.0 }\n");
  const StaticCase pressed = solved(model);
  const double force = 1.5e6 * kLength * kWidth;
  EXPECT_NEAR(pressed.gaskets[0].closure.minCoeff(), 11e-6, 1e-11);
  EXPECT_NEAR(pressed.support_sums(0, 2), force, 1e-4 * force);  // the ground
  EXPECT_NEAR(pressed.support_sums(1, 2), -force, 1e-4 * force);
  EXPECT_NEAR(pressed.energy, (5.0 + 1.25) * kLength * kWidth, 1e-4 * pressed.energy);
}

TEST(Gaskets, OfOneNameAreRefused) {
  std::string other = gasket(1e12, 1e10);
  other.erase(other.find("name = \"seal\"\n"), 14);  // gasket_2
  std::string second = gasket(1e12, 1e10);
  second.replace(second.find("\"seal\""), 6, "\"gasket_2\"");
  test::expect_parts(
      test::refusal_of([&] { built(materials(2.1e11) + second + other + force_at(0.1, 1.0)); }),
      {"gasket[1].name: found \"gasket_2\" twice, expected different names"});
}

TEST(Gaskets, TheDefaultIsTheCasesBecauseALoadAloneMayLift) {
  const FeModel model =
      built(materials(2.1e11) + gasket(1e12, 1e11, kTwoLines) + force_at(0.5 * kLength, 1e4));
  const StaticSolution all = solve_static(model, {});
  ASSERT_EQ(all.cases.size(), 1u);
  EXPECT_EQ(all.cases[0].name, "pressed");
}

/// The static results of a model in a file.
std::filesystem::path static_file(const FeModel& model, const std::string& name) {
  set_quiet(true);
  const std::filesystem::path path = test::scratch_path(name + ".static.h5");
  H5File file = H5File::create(path);
  write_provenance(file, {fe::kStaticSchema, "", {}});
  write_static(file, model, solve_static(model, {}));
  file.commit();
  return path;
}

TEST(Gaskets, InThePressedStateAnswerASmallLoadAsTheCurveDoes) {
  // Half open: a small additional force, by the curve and by the model of the pressed state.
  const auto recipe = [&](const std::string& more, double newton) {
    return materials(2.1e11) + gasket(1e12, 0.0, more) +
           "[[support]]\nname = \"x\"\nsurface = \"b_x0\"\ndirections = \"x\"\n"
           "[[support]]\nname = \"y\"\nsurface = \"b_y0\"\ndirections = \"y\"\n" +
           force_at(0.5 * kLength + 0.06, newton);
  };
  FeModel model = built(recipe("closure_um = [0.0, 1.0]\npressure_mpa = [0.0, 1.0]\n", 2e4));
  const StaticCase before = solved(model);
  EXPECT_GT(sums_of(model.gaskets[0], before.gaskets[0]).opening, 1e-6);
  const auto path = static_file(model, "half_open");
  const FeModel state = built(recipe(fmt::format("pressed = \"{}\"\n", path.string()), 1.0));
  EXPECT_TRUE(state.gaskets.empty());
  model.cases["pressed"]["push"] = 2e4 + 1.0;
  const VectorXd expected = solved(model).displacement - before.displacement;
  EXPECT_LT((solved(state).displacement - expected).norm(), 1e-6 * expected.norm());
}

TEST(Gaskets, PressedResultsOfAnotherMeshOrGasketAreRefusedWithTheWayOut) {
  const std::string load = force_at(0.5 * kLength + 0.06, 2e4);
  const FeModel model = built(materials(2.1e11) + gasket(1e12, 1e10, kTwoLines) + load);
  const auto path = static_file(model, "mesh");
  const auto refused = [&](const std::string& toml, int nx) {
    return test::refusal_of([&] { built(materials(2.1e11) + toml + load, nx); });
  };
  const std::string pressed = fmt::format("pressed = \"{}\"\n", path.string());
  test::expect_parts(refused(gasket(1e12, 1e10, pressed), 6),
                     {"gasket seal: pressed: found points that are not those of the faces of b_z0",
                      "static results of the same mesh and the same two surfaces"});
  test::expect_parts(refused(gasket(1e12, 1e10, pressed + "pressed_case = \"hot\"\n"), 8),
                     {"mesh.static.h5: cases: found hot, expected one of: pressed"});
  FeModel twice = model;
  twice.cases["again"] = twice.cases["pressed"];
  const auto two = static_file(twice, "two_cases");
  test::expect_parts(
      refused(gasket(1e12, 1e10, fmt::format("pressed = \"{}\"\n", two.string())), 8),
      {"cases: found 2 of them, expected pressed_case to name one of: again, pressed"});
  std::string other = gasket(1e12, 1e10, pressed);
  other.replace(other.find("\"seal\""), 6, "\"ring\"");
  test::expect_parts(refused(other, 8), {"gaskets: found ring, expected one of: seal"});
  const FeModel linear = built(materials(2.1e11) + gasket(1e12, 1e10) + load);
  const auto none = static_file(linear, "linear");
  test::expect_parts(
      refused(gasket(1e12, 1e10, fmt::format("pressed = \"{}\"\n", none.string())), 8),
      {"gaskets: found none, expected the state of a [[gasket]] with closure_um and pressure_mpa"});
}

TEST(Gaskets, CurvesThatFallOrEndFlatAreRefused) {
  const auto refused = [](const std::string& curve) {
    return test::refusal_of(
        [&] { built(materials(2.1e11) + gasket(1e12, 1e10, curve) + force_at(0.1, 1.0)); });
  };
  test::expect_parts(refused("closure_um = [0.0, 1.0]\n"), {"closure_um", "pressure_mpa"});
  test::expect_parts(refused("closure_um = [0.0, 1.0]\npressure_mpa = [0.0]\n"),
                     {"pressure_mpa: found 1 numbers for 2 of closure_um"});
  test::expect_parts(refused("closure_um = [1.0, 0.0]\npressure_mpa = [0.0, 1.0]\n"),
                     {"closure_um: found closures that do not ascend"});
  test::expect_parts(refused("closure_um = [0.0, 1.0, 2.0]\npressure_mpa = [0.0, 2.0, 1.0]\n"),
                     {"pressure_mpa: found pressures that do not ascend from 0"});
  test::expect_parts(refused("closure_um = [0.0, 1.0]\npressure_mpa = [0.5, 1.0]\n"),
                     {"pressure_mpa: found pressures that do not ascend from 0"});
  test::expect_parts(refused("closure_um = [0.0, 1.0, 2.0]\npressure_mpa = [0.0, 1.0, 1.0]\n"),
                     {"pressure_mpa: found the last two equal"});
}

TEST(Gaskets, HardB20_APartThatFloatsAboveAGapFindsItsPlace) {
  // Nothing touches at the start, and tangents are singular until the ring of the seal carries: two
  // gaskets beside one another, of which the second begins to carry 91 um later.
  mesh::Mesh mesh = bodies(8);
  const mesh::Surface whole = mesh.surfaces.at("b_z0");
  const auto half = [&](bool left) {
    mesh::Surface part = whole;
    for (mesh::FaceBlock& block : part.faces) {
      std::vector<Index> rows;
      for (Index f = 0; f < block.nodes.rows(); ++f) {
        double x = 0.0;
        for (Index a = 0; a < block.nodes.cols(); ++a) x += mesh.nodes(block.nodes(f, a), 0);
        if ((x / static_cast<double>(block.nodes.cols()) < 0.5 * kLength) == left)
          rows.push_back(f);
      }
      block.nodes = IndexMatrix(block.nodes(rows, Eigen::all));
    }
    return part;
  };
  mesh.surfaces["b_left"] = half(true);
  mesh.surfaces["b_right"] = half(false);
  const auto seal = [](const std::string& name, const std::string& curve) {
    std::string text = gasket(1e13, 0.0, curve);
    text.replace(text.find("\"seal\""), 6, "\"" + name + "\"");
    text.replace(text.find("\"b_z0\""), 6, "\"b_" + name + "\"");
    return text;
  };
  const FeModel model =
      build_all(mesh, materials(2.1e11) +
                          seal("left",
                               "closure_um = [20.0, 47.0, 74.0, 101.0, 128.0]\n"
                               "pressure_mpa = [0.0, 2.0, 8.0, 18.0, 32.0]\n") +
                          seal("right",
                               "closure_um = [111.0, 138.0, 165.0]\n"
                               "pressure_mpa = [0.0, 2.0, 8.0]\n") +
                          "[[support]]\nname = \"x\"\nsurface = \"b_x0\"\ndirections = \"x\"\n"
                          "[[support]]\nname = \"y\"\nsurface = \"b_y0\"\ndirections = \"y\"\n" +
                          force_at(0.5 * kLength, 1e5))
          .model;
  ASSERT_EQ(model.gaskets.size(), 2u);
  const StaticCase pressed = solved(model);
  EXPECT_LT(pressed.steps, 30);
  EXPECT_LE(pressed.backward_error, 1e-12);
  EXPECT_LE(pressed.balance, 1e-8);
  const GasketSums left = sums_of(model.gaskets[0], pressed.gaskets[0]),
                   right = sums_of(model.gaskets[1], pressed.gaskets[1]);
  EXPECT_NEAR((left.force + right.force) / 1e5, 1.0, 1e-9);
  EXPECT_GT(left.force, right.force);
  EXPECT_GT(right.force, 0.0);
}

TEST(Gaskets, HardB20_TheStateIsFoundFromAnyLoadAndSteepness) {
  // Lines that differ by 1e4, forces from the middle to the edge and over five decades.
  for (const double x : {0.5, 0.7, 0.95})
    for (const double newton : {1e1, 1e3, 1e5}) {
      FeModel model = built(materials(2.1e11) +
                            gasket(1e12, 1e9,
                                   "closure_um = [0.0, 5.0, 5.5, 6.0]\n"
                                   "pressure_mpa = [0.0, 0.005, 0.1, 100.0]\n") +
                            force_at(x * kLength, newton));
      const StaticCase pressed = solved(model);
      const GasketSums sums = sums_of(model.gaskets[0], pressed.gaskets[0]);
      EXPECT_NEAR(sums.force / newton, 1.0, 1e-6) << x << " " << newton;
      EXPECT_LT(pressed.steps, 30) << x << " " << newton;
    }
}

TEST(Gaskets, HardB20_AnEvenPullOnOneThatOnlyPressesIsNotSolved) {
  const FeModel model =
      built(materials(2.1e11) + gasket(1e12, 1e10, kTwoLines) + force_at(0.5 * kLength, -1e4));
  const std::string said =
      test::refusal_of<NumericsError>([&] { solve_static(model, {"pressed"}); });
  test::expect_parts(said, {"pressed: found no state of the gaskets that carries the loads",
                            "does a part hang on open gaskets alone?"});
}

}  // namespace
}  // namespace clatter::modal
