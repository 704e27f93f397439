// SPDX-License-Identifier: GPL-3.0-or-later
// CENTRIF, *MPC PLANE and STRAIGHT, constants by temperature.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kStep = "*STEP\n*STATIC\n";

TEST(AbaqusCentrif, KeepsOmegaSquaredAxisAndTheSectionsThatTurn) {
  const Deck deck =
      read(kModel + kStep + "*DLOAD\nEALL, CENTRIF, 4.E6, 1, 2, 3, 0, 0, 2\n*END STEP\n");
  ASSERT_EQ(deck.steps[0].rotations.size(), 1u);
  const Step::Rotation& one = deck.steps[0].rotations[0];
  EXPECT_EQ(one.omega_squared, 4e6);
  EXPECT_EQ(one.point, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(one.axis, Eigen::Vector3d::UnitZ());
  EXPECT_TRUE(one.regions.empty());
}

TEST(AbaqusCentrif, OnPartOfASectionMakesThatARegionOfItsOwn) {
  const Deck deck = read(kCube +
                         "*NODE\n11, 0, 0, 2\n12, 1, 0, 2\n13, 1, 1, 2\n14, 0, 1, 2\n"
                         "*ELEMENT, TYPE=C3D8, ELSET=EALL\n2, 5, 6, 7, 8, 11, 12, 13, 14\n" +
                         kSteel + kStep + "*DLOAD\n2, CENTRIF, 4., 0,0,0, 0,0,1\n*END STEP\n");
  EXPECT_EQ(deck.mesh.regions, (std::vector<std::string>{"EALL", "EALL_2"}));
  EXPECT_EQ(deck.regions[1].material, "Steel");
  EXPECT_EQ(deck.steps[0].rotations.at(0).regions, std::vector<std::string>{"EALL_2"});
  EXPECT_EQ(deck.mesh.cells[1].ids, std::vector<int32_t>{2});
}

TEST(AbaqusCentrif, IsReplacedByTheNextStepAndRefusedWithoutAnAxis) {
  const Deck deck = read(kModel + kStep + "*DLOAD\nEALL, CENTRIF, 4., 0,0,0, 0,0,1\n*END STEP\n" +
                         kStep + "*DLOAD\nEALL, CENTRIF, 9., 0,0,0, 0,0,1\n*END STEP\n");
  ASSERT_EQ(deck.steps[1].rotations.size(), 1u);
  EXPECT_EQ(deck.steps[1].rotations[0].omega_squared, 9.0);
  EXPECT_THAT(refusal(kModel + kStep + "*DLOAD\nEALL, CENTRIF, 4., 0,0,0\n*END STEP\n"),
              HasSubstr("deck.inp:27: expected a direction of the axis"));
  EXPECT_THAT(refusal(kModel + kStep + "*DLOAD\nEALL, CENTRIF, -4., 0,0,0, 0,0,1\n*END STEP\n"),
              HasSubstr("omega^2 = -4, expected 0 or more"));
}

/// sum coefficient * u(x) of an equation for a displacement field.
template <class Field>
double residue(const Deck& deck, const Equation& equation, const Field& u) {
  double sum = 0.0;
  for (const Equation::Term& term : equation.terms) {
    const Eigen::Vector3d x = deck.mesh.nodes.row(term.node_index).transpose();
    sum += term.coefficient * u(x)[term.direction];
  }
  return sum;
}

TEST(AbaqusMpc, PlaneKeepsRigidMotionsAndMotionsWithinThePlaneOnly) {
  const Deck deck = read(kModel + "*MPC\nPLANE, 5, 6, 7, 8\n");
  ASSERT_EQ(deck.equations.size(), 1u);  // four nodes, three of which span the plane
  const Equation& e = deck.equations[0];
  EXPECT_EQ(e.terms[0].direction, 2);
  const auto rigid = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(.1, .2, .3).cross(x));
  };
  const auto within = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(x[0] * x[1], 3 * x[0] * x[1], 1 + 2 * x[0] - x[1]);
  };
  const auto bent = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, 0, x[0] * x[1]); };
  EXPECT_NEAR(residue(deck, e, rigid), 0.0, 1e-14);
  EXPECT_NEAR(residue(deck, e, within), 0.0, 1e-14);
  EXPECT_NEAR(std::abs(residue(deck, e, bent)), 1.0, 1e-14);
  EXPECT_THAT(refusal(kModel + "*MPC\nPLANE, 1, 2, 3, 8\n"), HasSubstr("is not in the plane"));
  EXPECT_THAT(refusal(kModel + "*MPC\nPLANE, 1, 2, 3\n"), HasSubstr("found 3 nodes, expected 4"));
}

TEST(AbaqusMpc, LinearFollowsTheLineBetweenTwoNodes) {
  const Deck deck = read(kCube + "*MPC\nLINEAR, 6, 5, 7\nLINEAR, 2, 1, 3\n");
  ASSERT_EQ(deck.equations.size(), 6u);
  const Equation& y = deck.equations[1];
  ASSERT_EQ(y.terms.size(), 3u);
  EXPECT_EQ(y.terms[0].node_index, node(deck, 6));
  EXPECT_EQ(y.terms[0].direction, 1);
  EXPECT_EQ(y.terms[0].coefficient, 1.0);
  // (1, 0) is half of the way from (0, 0) to (1, 1).
  EXPECT_EQ(y.terms[1].coefficient, -0.5);
  EXPECT_EQ(y.terms[2].coefficient, -0.5);
  EXPECT_THAT(refusal(kCube + "*MPC\nLINEAR, 6, 5\n"), HasSubstr("found 2 nodes, expected 3"));
  EXPECT_THAT(refusal(kCube + "*MPC\nLINEAR, 1, 9, 10\n"),
              HasSubstr("its second and third node coincide"));
}

TEST(AbaqusMpc, StraightIsTwoEquationsPerNodeAndContinuesAfterAZero) {
  const std::string edge =
      kCubeNodes +
      "*ELEMENT, TYPE=C3D10, ELSET=EALL\n1, 1, 2, 4, 5, 21, 22, 23, 24, 25, 26\n"
      "*NODE\n21, .5, 0, 0\n22, .5, .5, 0\n23, 0, .5, 0\n24, 0, 0, .5\n"
      "25, .5, 0, .5\n26, 0, .5, .5\n" +
      kSteel;
  const Deck deck = read(edge + "*MPC\nSTRAIGHT, 2,\n0, 22, 4, 0\n");
  ASSERT_EQ(deck.equations.size(), 2u);
  EXPECT_NE(deck.equations[0].terms[0].direction, deck.equations[1].terms[0].direction);
  const auto rigid = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(.1, .2, .3).cross(x));
  };
  const auto along = [](const Eigen::Vector3d& x) {
    return Eigen::Vector3d(Eigen::Vector3d(1, -1, 0) * x[0] * x[0]);
  };
  const auto bent = [](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, 0, x[0] * x[1]); };
  double off = 0.0;
  for (const Equation& e : deck.equations) {
    EXPECT_EQ(ids_of(deck, {e.terms[0].node_index}), std::vector<int32_t>{22});
    EXPECT_NEAR(residue(deck, e, rigid), 0.0, 1e-14);
    EXPECT_NEAR(residue(deck, e, along), 0.0, 1e-14);
    off = std::max(off, std::abs(residue(deck, e, bent)));
  }
  EXPECT_NEAR(off, 0.25, 1e-14);
  EXPECT_THAT(refusal(edge + "*MPC\nSTRAIGHT, 2, 22, 5\n"), HasSubstr("is not on the line"));
}

std::string steel(const std::string& elastic) {
  return kCube + "*MATERIAL, NAME=S\n*ELASTIC\n" + elastic +
         "*SOLID SECTION, ELSET=EALL, MATERIAL=S\n";
}

TEST(AbaqusTemperature, ConstantsAtOneTemperatureAreConstant) {
  const Deck deck = read(steel("2.1E5, .3, 20.\n"));
  EXPECT_EQ(deck.materials.at("S").constants, (std::vector<double>{2.1e5, .3}));
}

TEST(AbaqusTemperature, ConstantsAtSeveralAreTakenAtTheInitialOneWithANote) {
  const std::string table = steel("2.E5, .3, 0.\n1.E5, .2, 100.\n");
  const Deck deck =
      read(table + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 25.\n" + kStep + "*END STEP\n");
  EXPECT_THAT(deck.materials.at("S").constants,
              ElementsAre(DoubleEq(1.75e5), DoubleEq(.275)));  // interpolated, to rounding
  ASSERT_EQ(deck.notes.size(), 1u);
  EXPECT_THAT(deck.notes[0],
              HasSubstr("deck.inp:15: *ELASTIC is taken at the initial temperature 25"));
  EXPECT_THAT(refusal(table), HasSubstr("deck.inp:15: *ELASTIC: constants that depend on the "
                                        "temperature need one initial temperature"));
  EXPECT_THAT(refusal(table + "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 25.\n" + kStep +
                      "*TEMPERATURE\nNALL, 50.\n*END STEP\n"),
              HasSubstr("in steps that change it (deck.inp:23)"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
