// SPDX-License-Identifier: GPL-3.0-or-later
// [[spring]]: its contribution to K, the motions that it holds, and cells of rigid bodies.
#include <gtest/gtest.h>

#include "bar_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

using test::expect_parts;

std::string spring_refusal(const std::string& toml) {
  return test::refusal_of([&] { build(bar(), toml); });
}

/// All nodes of the bar move with the point hub.
mesh::Mesh stiff_bar() {
  mesh::Mesh mesh = bar();
  for (int32_t a = 0; a < mesh.nodes.rows(); ++a) mesh.node_sets["all"].push_back(a);
  return mesh;
}
constexpr const char* kHub =
    "[[point]]\nname = \"hub\"\nat = [0.05, 0.05, 0.15]\n"
    "[[coupling]]\ntype = \"rigid\"\npoint = \"hub\"\nnode_set = \"all\"\n";

TEST(Springs, OnARigidBodyAreAllOfItsStiffness) {
  const fe::FeModel model = build(stiff_bar(), std::string(kHub) + R"(
[[spring]]
stiffness = 200.0
terms = [ { point = "hub", direction = "x" } ]
[[spring]]
stiffness = 3.0
terms = [ { point = "hub", direction = "ry" } ]
)")
                                .model;
  ASSERT_EQ(model.size(), 6);
  Eigen::MatrixXd want = Eigen::MatrixXd::Zero(6, 6);
  want(0, 0) = 200.0;
  want(4, 4) = 3.0;
  EXPECT_EQ(full(model.K), want);  // cells of a rigid body leave no rounding
  EXPECT_NEAR(model.M.coeff(0, 0), 0.1 * 0.1 * 0.3 * 7800.0, 1e-9);
}

TEST(Springs, AddTheirRankOneTermToTheStiffness) {
  const mesh::Mesh mesh = bar();
  const BuiltModel without = build(mesh, kFoot);
  const BuiltModel with = build(mesh, std::string(kFoot) + R"(
[[spring]]
stiffness = 5.0e6
terms = [ { node_set = "n0", direction = "x", coefficient = 2.0 },
          { node_set = "n100", direction = "y", coefficient = -1.0 } ]
)");
  Eigen::VectorXd c = Eigen::VectorXd::Zero(3 * mesh.nodes.rows());
  c(3 * mesh.node_sets.at("n0")[0]) = 2.0;
  c(3 * mesh.node_sets.at("n100")[0] + 1) = -1.0;
  const Eigen::VectorXd t = with.model.T.transpose() * c;
  const Eigen::MatrixXd change = full(with.model.K) - full(without.model.K);
  EXPECT_LT((change - 5.0e6 * t * t.transpose()).norm(), 1e-15 * full(with.model.K).norm());
}

TEST(Springs, HoldTheRigidMotionsThatStretchThem) {
  const auto held = [](const std::string& terms) {
    const BuiltModel built =
        build(bar(), "[[spring]]\nstiffness = 1.0e3\nterms = [ " + terms + " ]\n");
    EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
    return built.certificate.rigid_motions_held_by_equations.value();
  };
  EXPECT_EQ(held(R"({ node_set = "n0", direction = "z" })"), 1.0);
  // Along the line between both ends no rigid motion stretches it, across the line a rotation does.
  const std::string one = "{ node_set = \"n0\", direction = ",
                    other = "{ node_set = \"n100\", coefficient = -1.0, direction = ";
  EXPECT_EQ(held(one + "\"x\" }, " + other + "\"x\" }"), 0.0);
  EXPECT_EQ(held(one + "\"y\" }, " + other + "\"y\" }"), 1.0);
}

TEST(Springs, ToAHeldPointGiveItsReaction) {
  const mesh::Mesh mesh = bar();
  const fe::FeModel model = build(mesh, std::string(kFoot) + R"(
[[point]]
name = "wall"
at = [1.0, 0.0, 0.2]
[[support]]
name = "wall"
point = "wall"
directions = "xyz"
[[spring]]
stiffness = 4.0e5
terms = [ { point = "wall", direction = "x" },
          { node_set = "n100", direction = "x", coefficient = -1.0 } ]
)")
                                .model;
  int s = -1;
  for (int k = 0; k < model.supports.size(); ++k)
    if (model.supports.set.labels[k] == "wall.wall.x") s = k;
  ASSERT_GE(s, 0) << model.supports.set.labels.back();
  EXPECT_EQ(model.supports.K_ss.coeff(s, s), 4.0e5);
  // A displacement of 1 at the spring's end alone.
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.T.rows());
  u(3 * mesh.node_sets.at("n100")[0]) = 1.0;
  const Eigen::VectorXd q = model.T.transpose() * u;
  EXPECT_EQ((model.supports.K_sq * q)(s), -4.0e5);
}

TEST(Springs, AloneHoldAPointWithoutMass) {
  const fe::FeModel model = build(bar(), std::string(kFoot) + R"(
[[point]]
name = "end"
at = [0.5, 0.1, 0.2]
[[spring]]
stiffness = 10.0
terms = [ { point = "end", direction = "x" },
          { node_set = "n100", direction = "x", coefficient = -1.0 } ]
)")
                                .model;
  const rom::DofSet& end = model.set("end");
  ASSERT_EQ(end.dofs.size(), 1u);  // x alone: nothing is attached to the others
  EXPECT_EQ(model.K.coeff(end.dofs[0], end.dofs[0]), 10.0);
  EXPECT_EQ(model.M.coeff(end.dofs[0], end.dofs[0]), 0.0);
}

TEST(Springs, ThatMeanNothingAreRefused) {
  const std::string head = "[[spring]]\nname = \"s\"\nstiffness = 1.0\n";
  expect_parts(spring_refusal(head), {"terms", "found none"});
  expect_parts(spring_refusal("[[spring]]\nstiffness = -2.0\n"), {"stiffness", "-2"});
  expect_parts(spring_refusal(head + "terms = [ { node_set = \"z0\", direction = \"x\" } ]\n"),
               {"node_set", "expected one"});
  expect_parts(spring_refusal(head + "terms = [ { node_set = \"n0\", direction = \"rx\" } ]\n"),
               {"direction", "\"rx\""});
  expect_parts(spring_refusal(head + "terms = [ { node_set = \"n0\", direction = \"x\", "
                                     "coefficient = 0.0 } ]\n"),
               {"coefficient", "found 0"});
  expect_parts(
      spring_refusal(head + "length = 1.0\nterms = [ { node_set = \"n0\", direction = \"x\" } ]\n"),
      {"length"});
  expect_parts(spring_refusal("[[point]]\nname = \"p\"\nat = [0.0, 0.0, 0.0]\n" + head +
                              "terms = [ { node_set = \"n0\", direction = \"x\" }, "
                              "{ point = \"p\", direction = \"rx\" } ]\n"),
               {"coefficient", "rotation beside a displacement", "a lever arm"});
}

TEST(Matrices, OfStiffnessAndMassAreAddedOnTheirDofs) {
  const mesh::Mesh mesh = bar();
  const std::string terms =
      "terms = [ { node_set = \"n0\", direction = \"x\" }, { node_set = \"n100\", direction = "
      "\"y\" } ]\n";
  const fe::FeModel without = build(mesh, kFoot).model;
  const fe::FeModel with =
      build(mesh, kFoot + ("[[matrix]]\n" + terms + "K = [4.0e6, -1.0e6, 3.0e6]\n[[matrix]]\n" +
                           terms + "M = [5.0, 2.0, 7.0]\n"))
          .model;
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2, 3 * mesh.nodes.rows());
  C(0, 3 * mesh.node_sets.at("n0")[0]) = 1.0;
  C(1, 3 * mesh.node_sets.at("n100")[0] + 1) = 1.0;
  const Eigen::MatrixXd t = C * with.T;
  Eigen::Matrix2d K, M;
  K << 4.0e6, -1.0e6, -1.0e6, 3.0e6;
  M << 5.0, 2.0, 2.0, 7.0;
  const Eigen::MatrixXd dK = full(with.K) - full(without.K), dM = full(with.M) - full(without.M);
  EXPECT_LT((dK - t.transpose() * K * t).norm(), 1e-15 * full(with.K).norm());
  EXPECT_LT((dM - t.transpose() * M * t).norm(), 1e-15 * full(with.M).norm());
}

// The weight of a mass matrix m I is that of a mass m.
TEST(Matrices, OfMassHaveWeightAndCountInTheTotal) {
  const mesh::Mesh mesh = bar();
  const std::string load =
      "[[load]]\nname = \"g\"\nkind = \"acceleration\"\ndirection = [0.6, 0.0, 0.8]\n";
  const std::string on = "[[nodes]]\nname = \"p\"\nnode_set = \"n0\"\n";
  const fe::FeModel mass =
      build(mesh, on + load + "[[point_mass]]\non = \"p\"\nmass = 2.5\n").model;
  const fe::FeModel matrix =
      build(mesh,
            on + load +
                "[[matrix]]\nterms = [ { node_set = \"n0\", direction = \"x\" }, { node_set = "
                "\"n0\", direction = \"y\" }, { node_set = \"n0\", direction = \"z\" } ]\n"
                "M = [2.5, 0.0, 2.5, 0.0, 0.0, 2.5]\n")
          .model;
  EXPECT_LT((mass.loads.at("g") - matrix.loads.at("g")).norm(), 1e-14 * mass.loads.at("g").norm());
  EXPECT_NEAR(mass.mass.mass, matrix.mass.mass, 1e-12 * mass.mass.mass);
  EXPECT_LT((mass.mass.centre - matrix.mass.centre).norm(), 1e-12);
}

TEST(Matrices, WithoutMeaningAreRefused) {
  const std::string one = "[[matrix]]\nterms = [ { node_set = \"n0\", direction = \"x\" } ]\n";
  expect_parts(spring_refusal(one), {"K: give K or M"});
  expect_parts(spring_refusal(one + "K = [1.0]\nM = [1.0]\n"), {"M: K and M exclude each other"});
  expect_parts(spring_refusal(one + "K = [1.0, 2.0]\n"),
               {"found 2 numbers for 1 terms, expected 1: the lower triangle"});
}

TEST(Springs, MayHaveLeverArms) {
  const fe::FeModel model = build(stiff_bar(), std::string(kHub) + R"(
[[spring]]
stiffness = 200.0
terms = [ { point = "hub", direction = "x" }, { point = "hub", direction = "ry", coefficient = 0.5 } ]
)")
                                .model;
  Eigen::MatrixXd want = Eigen::MatrixXd::Zero(6, 6);
  want(0, 0) = 200.0;
  want(0, 4) = want(4, 0) = 100.0;
  want(4, 4) = 50.0;
  EXPECT_EQ(full(model.K), want);
}

}  // namespace
}  // namespace clatter::assembly::testing
