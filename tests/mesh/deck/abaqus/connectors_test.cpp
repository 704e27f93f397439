// SPDX-License-Identifier: GPL-3.0-or-later
// CONN3D2, *NONSTRUCTURAL MASS.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <bit>
#include <numbers>
#include <set>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

constexpr double kRounding = 1e-12;  // of numbers near 1

/// Two nodes of no cell, 2 apart along z and 1 along x; x' of SKEW is at 30 degrees in the plane x
/// y.
const std::string kEnds =
    "*NODE\n21, 0, 0, 3\n22, 1, 0, 5\n*ELEMENT, TYPE=CONN3D2, ELSET=C\n50, 21, 22\n"
    "*ORIENTATION, NAME=SKEW\n0.8660254037844387, 0.5, 0, -0.5, 0.8660254037844387, 0\n";
const Vector3d kArm(1, 0, 2);

std::string connector(const std::string& type, const std::string& behavior = "") {
  return kModel + kEnds + "*CONNECTOR SECTION, ELSET=C" + (behavior.empty() ? "" : ", BEHAVIOR=K") +
         "\n" + type + "\nSKEW\n" +
         (behavior.empty() ? "" : "*CONNECTOR BEHAVIOR, NAME=K\n" + behavior);
}

/// Coefficients at the displacements and rotations of nodes 21 and 22.
Eigen::Matrix<double, 1, 12> row_of(const Deck& deck, const std::vector<Equation::Term>& terms) {
  Eigen::Matrix<double, 1, 12> row = Eigen::Matrix<double, 1, 12>::Zero();
  for (const Equation::Term& term : terms) {
    const bool first = term.node_index == point(deck, 21);
    EXPECT_TRUE(first || term.node_index == point(deck, 22));
    row((first ? 0 : 6) + term.direction) += term.coefficient;
  }
  return row;
}

/// Displacements and rotations of both nodes when the second one moves by `move` and turns by
/// `turn` in the axes of the first one, which moves and turns arbitrarily.
Eigen::Matrix<double, 12, 1> motion(const Vector3d& move, const Vector3d& turn) {
  const Vector3d shift(.3, -.7, .2), theta(.4, .1, -.6);
  Eigen::Matrix<double, 12, 1> u;
  u << shift, theta, shift + theta.cross(kArm) + move, theta + turn;
  return u;
}

Eigen::Matrix3d skew() {
  return Eigen::AngleAxisd(std::numbers::pi / 6, Vector3d::UnitZ()).toRotationMatrix();
}

TEST(AbaqusConnector, RigidKindsLeaveTheMotionsThatTheManualLists) {
  // What stays free: components 1 to 3 along, 4 to 6 about the axes of the first node.
  const std::pair<const char*, std::vector<int>> kinds[] = {{"Join", {4, 5, 6}},
                                                            {"Hinge,", {4}},
                                                            {"Join, Revolute", {4}},
                                                            {"Ujoint", {4, 6}},
                                                            {"Translator", {1}},
                                                            {"Cylindrical", {1, 4}},
                                                            {"Planar", {2, 3, 4}},
                                                            {"Slot", {1, 4, 5, 6}},
                                                            {"Align", {1, 2, 3}},
                                                            {"Revolute, Slot", {1, 4}},
                                                            {"Slide-Plane", {2, 3, 4, 5, 6}}};
  for (const auto& [name, free] : kinds) {
    const Deck deck = read(connector(name));
    EXPECT_EQ(deck.equations.size(), 6 - free.size()) << name;
    std::set<std::pair<NodeIndex, int>> dependents;
    for (const Equation& equation : deck.equations) {
      dependents.emplace(equation.terms[0].node_index, equation.terms[0].direction);
      for (int k = 0; k < 6; ++k) {
        Vector3d relative[2] = {Vector3d::Zero(), Vector3d::Zero()};
        if (std::ranges::count(free, k + 1) > 0) relative[k / 3] = skew().col(k % 3);
        EXPECT_NEAR(row_of(deck, equation.terms) * motion(relative[0], relative[1]), 0, kRounding)
            << name << k;
      }
    }
    EXPECT_EQ(dependents.size(), deck.equations.size()) << name;
  }
}

TEST(AbaqusConnector, BeamAndWeldAreRigidLinks) {
  for (const char* name : {"Beam,", "Weld", "Join, Align"}) {
    const Deck deck = read(connector(name));
    ASSERT_EQ(deck.rigid.size(), 1u) << name;
    EXPECT_EQ(deck.rigid[0].reference, point(deck, 21));
    EXPECT_EQ(deck.rigid[0].dependents, std::vector<NodeIndex>{point(deck, 22)});
    EXPECT_TRUE(deck.equations.empty());
  }
}

TEST(AbaqusConnector, ALinkKeepsTheDistance) {
  const Deck deck = read(connector("Link"));
  ASSERT_EQ(deck.equations.size(), 1u);
  const auto row = row_of(deck, deck.equations[0].terms);
  EXPECT_NEAR(row * motion(Vector3d(2, 5, -1), Vector3d(1, 2, 3)), 0, kRounding);  // across
  EXPECT_GT(std::abs(row * motion(kArm, Vector3d::Zero())), 0.1);
}

/// Force and moment on the second node for that motion.
Eigen::Matrix<double, 6, 1> force(const Deck& deck, const Eigen::Matrix<double, 12, 1>& u) {
  Eigen::Matrix<double, 12, 1> all = Eigen::Matrix<double, 12, 1>::Zero();
  for (const Spring& spring : deck.springs) {
    const auto row = row_of(deck, spring.terms);
    all += spring.stiffness * row.transpose() * (row * u);
  }
  // Force and moment are in balance about the first node.
  EXPECT_LT((all.head<3>() + all.segment<3>(6)).norm(), 1e-9);
  EXPECT_LT((all.segment<3>(3) + all.tail<3>() + kArm.cross(Vector3d(all.segment<3>(6)))).norm(),
            1e-9);
  return all.tail<6>();
}

TEST(AbaqusConnector, ElasticComponentsAreSpringsAlongAndAboutTheAxesOfTheFirstNode) {
  const std::string elastic =
      "*CONNECTOR ELASTICITY, COMPONENT=1\n500.,\n*CONNECTOR ELASTICITY, COMPONENT=5\n70.\n"
      "*CONNECTOR DAMPING, COMPONENT=1\n.1\n";
  const Deck deck = read(connector("Cartesian, Cardan", elastic));
  EXPECT_EQ(deck.springs.size(), 2u);
  EXPECT_LT(force(deck, motion(Vector3d::Zero(), Vector3d::Zero())).norm(), 1e-9);
  const auto along = force(deck, motion(skew().col(0), Vector3d::Zero()));
  EXPECT_LT((along.head<3>() - 500.0 * skew().col(0)).norm(), 1e-9);
  EXPECT_LT(along.tail<3>().norm(), 1e-9);
  const auto about = force(deck, motion(Vector3d::Zero(), skew().col(1)));
  EXPECT_LT((about.tail<3>() - 70.0 * skew().col(1)).norm(), 1e-9);
  EXPECT_THAT(deck.passed, HasSubstr("damping: *CONNECTOR DAMPING"));
  // Across is free.
  EXPECT_LT(force(deck, motion(skew().col(1), skew().col(0))).norm(), 1e-9);
}

TEST(AbaqusConnector, TheAxesOfABushingTurnWithBothNodes) {
  const Deck deck = read(connector("Bushing", "*CONNECTOR ELASTICITY, COMPONENT=1\n500.\n"));
  // The second node alone turns by w: the axes by w / 2, which see the arm move by -w / 2 x arm.
  const Vector3d w(0, 0, 1);
  Eigen::Matrix<double, 12, 1> u = Eigen::Matrix<double, 12, 1>::Zero();
  u.tail<3>() = w;
  const double seen = skew().col(0).dot(-0.5 * w.cross(kArm));
  EXPECT_LT((force(deck, u).head<3>() - 500.0 * seen * skew().col(0)).norm(), 1e-9);
}

TEST(AbaqusConnector, ACoupledStiffnessIsThatMatrix) {
  // D = diag(1 .. 6) + 0.1 of (1, 2) and of (3, 6).
  const Deck deck = read(connector(
      "Cartesian, Cardan",
      "*CONNECTOR ELASTICITY\n1., .1, 2., 0., 0., 3., 0., 0.\n0., 4., 0., 0., 0., 0., 5., 0.\n"
      "0., .1, 0., 0., 6.\n"));
  const auto found = force(deck, motion(skew().col(0) + skew().col(2), Vector3d::Zero()));
  EXPECT_LT((skew().transpose() * found.head<3>() - Vector3d(1, .1, 3)).norm(), 1e-9);
  EXPECT_LT((skew().transpose() * found.tail<3>() - Vector3d(0, 0, .1)).norm(), 1e-9);
}

TEST(AbaqusConnector, ARigidComponentOfAnElasticKindIsAnEquation) {
  const Deck deck = read(
      connector("Bushing",
                "*CONNECTOR ELASTICITY, COMPONENT=2, RIGID\n*CONNECTOR ELASTICITY, COMPONENT=1, "
                "NONLINEAR\n-500., -1.\n0., 0.\n500., 1.\n"));
  EXPECT_EQ(deck.equations.size(), 1u);
  ASSERT_EQ(deck.springs.size(), 1u);
  EXPECT_EQ(deck.springs[0].stiffness, 500.0);
}

TEST(AbaqusConnector, AnEndMayBeTheGroundOrANodeOfASolid) {
  const std::string tail =
      "*CONNECTOR SECTION, ELSET=C, BEHAVIOR=K\nCartesian\n*CONNECTOR BEHAVIOR, NAME=K\n"
      "*CONNECTOR ELASTICITY, COMPONENT=3\n9.\n";
  for (const char* ends : {"50, , 7", "50, 7,"}) {
    const Deck deck = read(kModel + "*ELEMENT, TYPE=CONN3D2, ELSET=C\n" + ends + "\n" + tail);
    ASSERT_EQ(deck.springs.size(), 1u) << ends;
    ASSERT_EQ(deck.springs[0].terms.size(), 1u);
    EXPECT_EQ(deck.springs[0].terms[0].node_index, node(deck, 7));
    EXPECT_EQ(deck.springs[0].terms[0].direction, 2);
  }
  // A node of no cell on a node of one.
  const Deck joined = read(kModel +
                           "*NODE\n30, 1, 1, 1\n*ELEMENT, TYPE=CONN3D2, ELSET=C\n"
                           "50, 30, 7\n*CONNECTOR SECTION, ELSET=C\nWeld\n");
  EXPECT_EQ(joined.equations.size(), 3u);
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=CONN3D2, ELSET=C\n50, 9, 7\n" +
                      "*CONNECTOR SECTION, ELSET=C, BEHAVIOR=K\nBushing\n*CONNECTOR BEHAVIOR, "
                      "NAME=K\n*CONNECTOR ELASTICITY, COMPONENT=1\n9.\n"),
              HasSubstr("node 7 belongs to a solid and has no rotations"));
  const Deck link = read(kModel +
                         "*ELEMENT, TYPE=CONN3D2, ELSET=C\n50, 7, 9\n"
                         "*CONNECTOR SECTION, ELSET=C\nBeam\n");
  ASSERT_EQ(link.rigid.size(), 1u);
  EXPECT_EQ(link.rigid[0].reference, point(link, 9));
  EXPECT_EQ(link.rigid[0].dependents, std::vector<NodeIndex>{node(link, 7)});
}

TEST(AbaqusConnector, TheNodeThatNothingElseMovesFollows) {
  const Deck deck = read(connector("Hinge") + "*BOUNDARY\n22, 1, 6\n");
  ASSERT_EQ(deck.equations.size(), 5u);
  for (const Equation& equation : deck.equations)
    EXPECT_EQ(equation.terms[0].node_index, point(deck, 21));
}

TEST(AbaqusConnector, WhatIsNotLinearIsRefusedByName) {
  EXPECT_THAT(refusal(connector("Slipring")),
              HasSubstr("deck.inp:32: *CONNECTOR SECTION: connection 'Slipring' is not supported, "
                        "expected BEAM, WELD, HINGE"));
  EXPECT_THAT(refusal(connector("Beam, Cardan")),
              HasSubstr("a translational and a rotational one"));
  EXPECT_THAT(refusal(connector("Cartesian", "*CONNECTOR ELASTICITY, COMPONENT=5\n7.\n")),
              HasSubstr("deck.inp:28: element 50 (Cartesian): its behavior has the component 5"));
  EXPECT_THAT(refusal(kModel + kEnds +
                      "*ELEMENT, TYPE=CONN3D2, ELSET=D\n60, 21, 21\n"
                      "*CONNECTOR SECTION, ELSET=D\nHinge\n"),
              HasSubstr("element 60 (Hinge): found one node twice"));
  EXPECT_THAT(refusal(kModel + kEnds),
              HasSubstr("deck.inp:28: element 50 of type CONN3D2 has no *CONNECTOR SECTION"));
  EXPECT_THAT(refusal(kModel + "*NODE\n21, 0, 0, 0\n22, 1E20, 1E19, 0\n*ELEMENT, TYPE=CONN3D2, "
                               "ELSET=C\n50, 21, 22\n*CONNECTOR SECTION, ELSET=C\nHinge\n"),
              HasSubstr("element 50 (Hinge): its nodes are too far from each other"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=CONN3D2, ELSET=C\n50, 7, 9\n"
                               "*CONNECTOR SECTION, ELSET=C\nHinge\n"),
              HasSubstr("node 7 belongs to a solid and has no rotations"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=CONN3D2, ELSET=C\n50, 7,\n"
                               "*CONNECTOR SECTION, ELSET=C\nBeam\n"),
              HasSubstr("*BOUNDARY of its node replaces it"));
  EXPECT_THAT(refusal(connector("Bushing",
                                "*CONNECTOR ELASTICITY, COMPONENT=1\n7.\n"
                                "*CONNECTOR ELASTICITY\n1., 0., 1.\n")),
              HasSubstr("*CONNECTOR ELASTICITY: its components have an elasticity already"));
  EXPECT_THAT(refusal(connector("Bushing", "*CONNECTOR STOP, COMPONENT=1\n0., 1.\n")),
              HasSubstr("its connections: [[spring]] and [[equation]]"));
  EXPECT_THAT(refusal(kModel + kEnds + "*CONNECTOR SECTION, ELSET=C, BEHAVIOR=X\nBushing\n"),
              HasSubstr("found no *CONNECTOR BEHAVIOR 'X'"));
}

/// Two cubes, one above the other, of one section.
const std::string kTower =
    kCubeNodes + "11, 0, 0, 3\n12, 1, 0, 3\n13, 1, 1, 3\n14, 0, 1, 3\n" +
    "*ELEMENT, TYPE=C3D8, ELSET=EALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n2, 5, 6, 7, 8, 11, 12, 13, 14\n"
    "*ELSET, ELSET=UP\n2\n" +
    kSteel;

double density(const Deck& deck, const std::string& region) {
  const auto at = std::find(deck.mesh.regions.begin(), deck.mesh.regions.end(), region);
  return deck.materials.at(deck.regions.at(at - deck.mesh.regions.begin()).material).density;
}

TEST(AbaqusNonstructuralMass, IsAnAddedDensityOfItsCells) {
  // Volumes 1 and 2, density 7.8e-9.
  const std::string card = "*NONSTRUCTURAL MASS, ELSET=";
  const Deck per_volume = read(kTower + card + "UP, UNITS=MASS PER VOLUME\n1.E-9\n");
  EXPECT_NEAR(density(per_volume, "EALL"), 7.8e-9, 1e-20);
  EXPECT_NEAR(density(per_volume, "EALL_UP"), 8.8e-9, 1e-20);
  const Deck total = read(kTower + card + "UP, UNITS=TOTAL MASS\n1.E-9\n");
  EXPECT_NEAR(density(total, "EALL_UP"), 8.3e-9, 1e-20);
  // 3e-9 over both in proportion to their mass, then 2e-9 on the upper one by volume.
  const Deck both = read(kTower + card + "EALL, UNITS=TOTAL MASS\n3.E-9\n" + card +
                         "UP, UNITS=TOTAL MASS, DISTRIBUTION=VOLUME PROPORTIONAL\n2.E-9\n");
  EXPECT_NEAR(density(both, "EALL"), 8.8e-9, 1e-20);
  EXPECT_NEAR(density(both, "EALL_UP"), 9.8e-9, 1e-20);
}

TEST(AbaqusNonstructuralMass, ThatIsNoneOfSolidsIsRefused) {
  EXPECT_THAT(refusal(kTower + "*NONSTRUCTURAL MASS, ELSET=UP, UNITS=MASS PER AREA\n1.\n"),
              HasSubstr("expected UNITS=TOTAL MASS or MASS PER VOLUME"));
  EXPECT_THAT(refusal(kTower + "*NONSTRUCTURAL MASS, ELSET=UP, UNITS=TOTAL MASS\n-1.\n"),
              HasSubstr("expected more than 0"));
  EXPECT_THAT(refusal(kTower + "*NONSTRUCTURAL MASS, ELSET=NO, UNITS=TOTAL MASS\n1.\n"),
              HasSubstr("'NO'"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
