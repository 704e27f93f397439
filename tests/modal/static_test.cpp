// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/statics.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "core/base/error.hpp"
#include "static_bar.hpp"
#include "tests/refusal.hpp"

namespace clatter::modal {
namespace {

using assembly::testing::block_mesh;
using assembly::testing::brick;
using fe::FeModel;
using testing::bar;
using testing::kSlide;

const StaticCase& one(const StaticSolution& solution, std::string_view name) {
  for (const StaticCase& found : solution.cases)
    if (found.name == name) return found;
  throw std::runtime_error("no case " + std::string(name));
}

TEST(Statics, AStretchedBarIsHookesLawAndItsReactionsBalance) {
  const FeModel model = bar(std::string(kSlide) + R"(
[[load]]
name = "pull"
kind = "resultant"
surface = "z1"
direction = [0.0, 0.0, 1.0]
total = 2000.0
[[case]]
name = "twice"
loads = { pull = 2.0 }
)");
  const StaticSolution solution = solve_static(model, {});
  ASSERT_EQ(solution.cases.size(), 2u);
  const StaticCase& pull = one(solution, "pull");
  const double E = 2.1e11, A = 0.02, strain = 2000.0 / (E * A);
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
    EXPECT_NEAR(pull.displacement(3 * a + 2), strain * model.nodes(a, 2), 1e-10 * strain);
    EXPECT_NEAR(pull.displacement(3 * a), -0.3 * strain * model.nodes(a, 0), 1e-10 * strain);
  }
  ASSERT_EQ(pull.stress.size(), 1u);
  EXPECT_EQ(pull.stress[0].nodes.size(), static_cast<size_t>(model.nodes.rows()));
  const fe::Voigt tension = (fe::Voigt() << 0, 0, 2000.0 / A, 0, 0, 0).finished();
  const fe::StressRows off = pull.stress[0].stress.rowwise() - tension.transpose();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), 1e-9 * tension(2));
  EXPECT_NEAR(largest_stress(pull).von_mises, 2000.0 / A, 1e-9 * tension(2));
  EXPECT_NEAR(pull.energy, 0.5 * 2000.0 * strain * 0.4, 1e-9 * pull.energy);
  // The floor reaction is the full force, at the centre of the face: M_x = y F, M_y = -x F.
  EXPECT_NEAR(pull.support_sums(0, 2), -2000.0, 1e-7);
  EXPECT_NEAR(pull.support_sums(0, 3), -200.0, 1e-7);
  EXPECT_NEAR(pull.support_sums(0, 4), 100.0, 1e-7);
  EXPECT_LT(pull.balance, 1e-11);
  EXPECT_LT((one(solution, "twice").displacement - 2.0 * pull.displacement).norm(),
            1e-10 * pull.displacement.norm());
}

TEST(Statics, APrescribedDisplacementMovesWhatItNamesAndTheReactionsCarryIt) {
  const FeModel model = bar(std::string(kSlide) + R"(
[[support]]
name = "top"
surface = "z1"
directions = "z"
[[load]]
name = "stretch"
kind = "displacement"
surface = "z1"
directions = "z"
value = 1.0e-4
)");
  const StaticCase stretch = solve_static(model, {"stretch"}).cases[0];
  const double strain = 1e-4 / 0.4, force = 2.1e11 * 0.02 * strain;
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
    EXPECT_NEAR(stretch.displacement(3 * a + 2), strain * model.nodes(a, 2), 1e-14);
  EXPECT_NEAR(stretch.support_sums(3, 2), force, 1e-9 * force);
  EXPECT_NEAR(stretch.support_sums(0, 2), -force, 1e-9 * force);
  EXPECT_NEAR(stretch.energy, 0.5 * force * 1e-4, 1e-9 * stretch.energy);
}

TEST(Statics, AHeldReferencePointTakesForceAndMoment) {
  // The bar is fixed to a hub at a distance: weight m g, moment m g times the arm.
  const FeModel model = bar(R"(
[[point]]
name = "hub"
at = [0.5, 0.1, 0.4]
[[coupling]]
type = "rigid"
point = "hub"
surface = "z1"
[[support]]
name = "hub"
point = "hub"
directions = ["x", "y", "z", "rx", "ry", "rz"]
[[load]]
name = "weight"
kind = "acceleration"
direction = [0.0, 0.0, -1.0]
[[load]]
name = "turn"
kind = "displacement"
point = "hub"
directions = ["rz"]
value = 0.01
)");
  const StaticSolution solution = solve_static(model, {"weight", "turn"});
  const double m = 7800.0 * 0.1 * 0.2 * 0.4;
  const StaticCase& weight = solution.cases[0];
  EXPECT_NEAR(weight.reactions(2), m, 1e-9 * m);         // 1 m/s2
  EXPECT_NEAR(weight.reactions(4), 0.45 * m, 1e-9 * m);  // (hub - centre) x F about the hub
  EXPECT_NEAR(weight.reactions(3), 0.0, 1e-9 * m);
  // Rotating the hub rotates the free bar: no force, no energy.
  const StaticCase& turn = solution.cases[1];
  EXPECT_LT(turn.energy, 1e-6);  // compared with 1e6 J if the bar were bent by as much
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a) {
    EXPECT_NEAR(turn.displacement(3 * a), -0.01 * (model.nodes(a, 1) - 0.1), 1e-10);
    EXPECT_NEAR(turn.displacement(3 * a + 1), 0.01 * (model.nodes(a, 0) - 0.5), 1e-10);
  }
  EXPECT_NEAR(turn.points(5), 0.01, 1e-16);
}

TEST(Statics, ReactionsInObliqueDirectionsBalance) {
  const FeModel model = bar(R"(
[system.tilt]
kind = "rectangular"
z = [0.0, 0.6, 0.8]
x = [1.0, 0.0, 0.0]
[[support]]
name = "slope"
surface = "z0"
directions = "z"
system = "tilt"
[[support]]
name = "rest"
node_set = "corner"
[[support]]
name = "wall"
surface = "x0"
directions = "x"
[[load]]
name = "weight"
kind = "gravity"
direction = [0.0, 0.0, -1.0]
)");
  const StaticCase weight = solve_static(model, {}).cases[0];
  EXPECT_LT(weight.balance, 1e-10);
  EXPECT_NEAR(weight.support_sums.col(2).sum(), 62.4, 1e-8);
  // The slope reacts only along its normal.
  EXPECT_NEAR(0.8 * weight.support_sums(0, 1), 0.6 * weight.support_sums(0, 2), 1e-8);
}

TEST(Statics, AFreeBodyIsRefusedAndItsMotionsAreNamed) {
  const std::string load = "[[load]]\nname = \"p\"\nkind = \"pressure\"\nsurface = \"z1\"\n";
  const auto refusal = [&](const std::string& supports) {
    try {
      solve_static(bar(supports + load), {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(refusal("").find("6 unsupported rigid-body motions"), std::string::npos) << refusal("");
  const std::string one_free = refusal("[[support]]\nsurface = \"z0\"\ndirections = \"yz\"\n");
  EXPECT_NE(one_free.find("1 unsupported rigid-body motions"), std::string::npos) << one_free;
  EXPECT_NE(one_free.find("displacement along x"), std::string::npos) << one_free;
}

TEST(Statics, UnknownCasesListWhatThereIs) {
  const FeModel model =
      bar("[[support]]\nsurface = \"z0\"\n[[load]]\nname = \"p\"\nkind = "
          "\"pressure\"\nsurface = \"z1\"\n");
  try {
    solve_static(model, {"q"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("expected one of: p"), std::string::npos);
  }
}

TEST(Statics, APrescribedDirectionMustBeHeld) {
  test::expect_parts(
      test::refusal_of([&] {
        bar("[[support]]\nsurface = \"z0\"\n[[load]]\nname = \"d\"\nkind = "
            "\"displacement\"\nsurface = \"z1\"\ndirections = \"z\"\nvalue = 1.0\n");
      }),
      {"test.fe.toml:", "load d: found ", ", which no support holds, expected one that does"});
}

TEST(Statics, AWarmBarGrowsFreelyAndPushesWhenItIsHeld) {
  mesh::Mesh mesh = block_mesh({2, 2, 4}, brick({0.1, 0.2, 0.4}));
  mesh.fields["kelvin"] = RowMatrix::Constant(mesh.nodes.rows(), 1, 393.15);
  const std::string material =
      "[material.steel]\nregions = [\"body\"]\nE = 2.0e11\nnu = 0.3\nrho = 7800.0\n"
      "expansion = 1.2e-5\n";
  const std::string loads = R"(
[[load]]
name = "warm"
kind = "temperature"
value = 100.0
[[load]]
name = "field"
kind = "temperature"
field = "kelvin"
reference = 293.15
)";
  const auto model_of = [&](const std::string& toml) {
    StepClock clock;
    const Config config = Config::parse(toml, "warm.fe.toml");
    return assembly::build_fe_model(mesh, assembly::read_recipe(config, mesh), clock).model;
  };
  const FeModel free = model_of(material + kSlide + loads);
  const StaticSolution grown = solve_static(free, {"warm", "field"});
  for (const StaticCase& found : grown.cases) {
    for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
      for (int d = 0; d < 3; ++d)
        EXPECT_NEAR(found.displacement(3 * a + d), 1.2e-3 * mesh.nodes(a, d), 1e-14);
    // Compared with 4.8e6 N and 2.4e8 Pa for fixed ends.
    EXPECT_LT(found.reactions.cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT(found.stress[0].stress.cwiseAbs().maxCoeff(), 1e-2);
  }
  // Between two floors: stress E alpha dT.
  const FeModel held = model_of(material + kSlide + loads +
                                "[[support]]\nname = \"roof\"\nsurface = \"z1\"\ndirections = "
                                "\"z\"\n");
  const double force = 2.0e11 * 1.2e-3 * 0.02;
  const StaticCase pressed = solve_static(held, {"warm"}).cases[0];
  EXPECT_NEAR(pressed.support_sums(3, 2), -force, 1e-9 * force);
  EXPECT_NEAR(pressed.stress[0].stress.col(2).mean(), -2.4e8, 1e-9 * 2.4e8);
  EXPECT_NEAR(pressed.stress[0].von_mises.maxCoeff(), 2.4e8, 1e-9 * 2.4e8);
}

TEST(Statics, StressIsPrintedAtANodeNumberAPositionAndASensor) {
  FeModel model = bar(std::string(kSlide) + R"(
[[sensor]]
name = "gauge"
surface = "z1"
near = [0.1, 0.2, 0.4]
[[load]]
name = "pull"
kind = "resultant"
surface = "z1"
direction = [0.0, 0.0, 1.0]
total = 2000.0
)");
  for (int32_t a = 0; a < model.nodes.rows(); ++a) model.cells.node_ids.push_back(1000 + a);
  const StaticSolution solution = solve_static(model, {});
  const auto said = [&](const std::string& location) {
    std::string lines;
    for (const int32_t node : nodes_at(model, {location}))
      for (const std::string& line : describe_stress(model, solution.cases[0], node)) lines += line;
    return lines;
  };
  EXPECT_NE(said("1007").find("pull: node 1007 at"), std::string::npos) << said("1007");
  EXPECT_NE(said("1007").find("zz 100000 "), std::string::npos) << said("1007");
  const std::string corner = said("0.09,0.2,0.4");
  EXPECT_NE(corner.find("at (0.1000, 0.2000, 0.4000) m, body"), std::string::npos) << corner;
  EXPECT_EQ(corner, said("gauge"));
  for (const char* wrong : {"7", "gaug", "0.1,0.2", "1,2,x", ""})
    test::expect_parts(
        test::refusal_of([&] { nodes_at(model, {wrong}); }),
        {std::string("--stress-at: found \"") + wrong +
         "\", expected a node number, a position x,y,z in metres, or one of: gauge"});
  model.cells = {};
  EXPECT_TRUE(solve_static(model, {}).cases[0].stress.empty());
  test::expect_parts(
      test::refusal_of([&] { nodes_at(model, {"gauge"}); }),
      {"--stress-at: found a model without cells, expected one of clatter-assembly"});
}

}  // namespace
}  // namespace clatter::modal
