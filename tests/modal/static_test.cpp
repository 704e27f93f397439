#include "modal/statics.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "block_mesh.hpp"
#include "core/error.hpp"
#include "small_solver.hpp"

namespace clatter::modal {
namespace {

using assembly::FeModel;
using assembly::testing::block_mesh;
using assembly::testing::brick;

/// A bar of 0.1 x 0.2 x 0.4 m that stands on z0.
FeModel bar(const std::string& toml) {
  mesh::Mesh mesh = block_mesh({2, 2, 4}, brick({0.1, 0.2, 0.4}));
  mesh.node_sets["corner"] = {0};
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    if (mesh.nodes.row(a).norm() < 1e-12) mesh.node_sets["corner"][0] = static_cast<int32_t>(a);
  return assembly::testing::build(mesh, toml).model;
}

constexpr const char* kSlide =
    "[[support]]\nname = \"floor\"\nsurface = \"z0\"\ndirections = \"z\"\n"
    "[[support]]\nname = \"wall_x\"\nsurface = \"x0\"\ndirections = \"x\"\n"
    "[[support]]\nname = \"wall_y\"\nsurface = \"y0\"\ndirections = \"y\"\n";

const StaticCase& one(const StaticSolution& solution, const std::string& name) {
  for (const StaticCase& found : solution.cases)
    if (found.name == name) return found;
  throw std::runtime_error("no case " + name);
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
  EXPECT_NEAR(pull.energy, 0.5 * 2000.0 * strain * 0.4, 1e-9 * pull.energy);
  // The floor pulls down with all of it, at the middle of the face: M_x = y F, M_y = -x F.
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
  // The bar hangs on a hub beside it: weight m g, moment m g times the arm.
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
  // A turned hub turns the free bar with it: no force, no energy.
  const StaticCase& turn = solution.cases[1];
  EXPECT_LT(turn.energy, 1e-6);  // against 1e6 J of a bar that is bent by as much
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
  // The slope pushes along its normal only.
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
  EXPECT_NE(refusal("").find("6 rigid motions"), std::string::npos) << refusal("");
  const std::string one_free = refusal("[[support]]\nsurface = \"z0\"\ndirections = \"yz\"\n");
  EXPECT_NE(one_free.find("1 rigid motions"), std::string::npos) << one_free;
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
  EXPECT_THROW(bar("[[support]]\nsurface = \"z0\"\n[[load]]\nname = \"d\"\nkind = "
                   "\"displacement\"\nsurface = \"z1\"\ndirections = \"z\"\nvalue = 1.0\n"),
               InputError);
}

}  // namespace
}  // namespace clatter::modal
