// SPDX-License-Identifier: GPL-3.0-or-later
// *SPRING and *DASHPOT, *MPC MEANROT, steps with the stiffness of loads.
#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include "mesh/deck/units.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::HasSubstr;

const std::string kAxial = "*ELEMENT, TYPE=SPRINGA, ELSET=SPR\n7, 7, 9\n";

TEST(AbaqusSpring, BetweenTwoNodesPullsAlongTheirLine) {
  // From node 7 at (1, 1, 1) to node 9 at (.5, .5, 2), which belongs to no cell.
  const Deck deck = read(kModel + kAxial + "*SPRING, ELSET=SPR\n\n12.\n");
  ASSERT_EQ(deck.springs.size(), 1u);
  const Spring& spring = deck.springs[0];
  EXPECT_EQ(spring.stiffness, 12.0);
  EXPECT_EQ(spring.where, "deck.inp:25");
  ASSERT_EQ(spring.terms.size(), 6u);
  const Eigen::Vector3d along = Eigen::Vector3d(-.5, -.5, 1).normalized();
  for (const Equation::Term& term : spring.terms) {
    const bool far = term.node_index == point(deck, 9);
    EXPECT_TRUE(far || term.node_index == node(deck, 7));
    EXPECT_NEAR(term.coefficient, (far ? 1 : -1) * along[term.direction], 1e-15);
  }
}

TEST(AbaqusSpring, OfOneDirectionActsOnOneNodeOrTwo) {
  const Deck deck = read(kModel +
                         "*ELEMENT, TYPE=SPRING1, ELSET=ONE\n7, 7\n"
                         "*ELEMENT, TYPE=SPRING2, ELSET=TWO\n8, 7, 9\n"
                         "*SPRING, ELSET=ONE\n2\n5.\n*SPRING, ELSET=TWO\n1, 3\n6.\n");
  ASSERT_EQ(deck.springs.size(), 2u);
  ASSERT_EQ(deck.springs[0].terms.size(), 1u);
  EXPECT_EQ(deck.springs[0].terms[0].direction, 1);
  ASSERT_EQ(deck.springs[1].terms.size(), 2u);
  EXPECT_EQ(deck.springs[1].terms[0].direction, 0);
  EXPECT_EQ(deck.springs[1].terms[1].direction, 2);
  EXPECT_EQ(deck.springs[1].terms[1].coefficient, -1.0);
}

TEST(AbaqusSpring, ActsAlongItsOrientation) {
  const std::string head = kModel + "*ORIENTATION, NAME=O\n3., 4., 0., -4., 3., 0.\n";
  const std::string one = "*ELEMENT, TYPE=SPRING1, ELSET=ONE\n7, 7\n";
  const Deck deck = read(head + one + "*SPRING, ELSET=ONE, ORIENTATION=o\n2\n5.\n");
  ASSERT_EQ(deck.springs.size(), 1u);
  ASSERT_EQ(deck.springs[0].terms.size(), 2u);
  EXPECT_NEAR(deck.springs[0].terms[0].coefficient, -.8, 1e-15);
  EXPECT_NEAR(deck.springs[0].terms[1].coefficient, .6, 1e-15);
  EXPECT_THAT(refusal(head + one + "*SPRING, ELSET=ONE, ORIENTATION=P\n2\n5.\n"),
              HasSubstr("found no orientation 'P'"));
  const std::string turned = "*TRANSFORM, NSET=TOP, TYPE=R\n3,4,0,-4,3,0\n";
  EXPECT_THAT(refusal(head + turned + one + "*SPRING, ELSET=ONE\n2\n5.\n"),
              HasSubstr("a SPRING1 without ORIENTATION on a node with *TRANSFORM"));
  const std::string along = "*SPRING, ELSET=ONE, ORIENTATION=O\n2\n5.\n";
  EXPECT_EQ(read(head + turned + one + along).springs.size(), 1u);
}

TEST(AbaqusSpring, OfATableIsReadWhenItIsOneLineThroughZero) {
  const std::string head = kModel + kAxial + "*SPRING, ELSET=SPR, NONLINEAR\n\n";
  EXPECT_EQ(read(head + "-24., -2.\n0., 0.\n12., 1.\n").springs[0].stiffness, 12.0);
  EXPECT_THAT(refusal(head + "-24., -2.\n0., 0.\n13., 1.\n"),
              HasSubstr("deck.inp:26: *SPRING, NONLINEAR: its forces are not on one line"));
}

TEST(AbaqusSpring, WithoutMeaningIsRefusedByLine) {
  EXPECT_THAT(refusal(kModel + kAxial),
              HasSubstr("deck.inp:25: element 7 of type SPRINGA has no value (*SPRING)"));
  EXPECT_THAT(refusal(kModel + kAxial + "*SPRING, ELSET=SPR\n\n-1.\n"),
              HasSubstr("deck.inp:26: *SPRING: found a stiffness of -1, expected more than 0"));
  EXPECT_THAT(refusal(kModel + kAxial + "*SPRING, ELSET=SPR\n\n1.,,20.\n2.,,30.\n"),
              HasSubstr("deck.inp:26: *SPRING: found 2 lines of stiffness, expected one"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=SPRINGA, ELSET=SPR\n7, 9, 10\n"
                               "*SPRING, ELSET=SPR\n\n1.\n"),
              HasSubstr("deck.inp:25: element 7: both ends have the same position"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=SPRING1, ELSET=SPR\n7, 7\n"
                               "*SPRING, ELSET=SPR\n4\n1.\n"),
              HasSubstr("deck.inp:25: element 7: node 7 has no rotations"));
  EXPECT_THAT(refusal(kModel + kAxial + "*SPRING, ELSET=SPR\n\n1.\n*SPRING, ELSET=SPR\n\n2.\n"),
              HasSubstr("deck.inp:29: *SPRING: element 7 has a value already"));
  EXPECT_THAT(refusal(kModel + "*SPRING, ELSET=EALL\n\n1.\n"),
              HasSubstr("*SPRING: expected elements SPRING in EALL"));
}

TEST(AbaqusSpring, StiffnessChangesItsUnitsWithTheDeck) {
  Deck deck = read(kModel + kAxial + "*SPRING, ELSET=SPR\n\n12.\n");
  convert_units(deck, unit_system_named("mm-t-s", "test"));
  EXPECT_NEAR(deck.springs[0].stiffness, 12e3, 1e-9);  // N/mm
}

TEST(AbaqusDashpot, IsSkippedWithOneNote) {
  const Deck deck = read(kModel +
                         "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n7, 7, 9\n8, 8, 9\n"
                         "*DASHPOT, ELSET=D\n\n1.E-5\n");
  EXPECT_TRUE(deck.springs.empty());
  EXPECT_TRUE(deck.points.empty());
  ASSERT_EQ(deck.notes.size(), 2u);  // and the missing *STEP
  EXPECT_THAT(deck.notes[1],
              HasSubstr("deck.inp:27: *DASHPOT is left out: dampers have no effect"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=DASHPOTA, ELSET=D\n7, 7, 9\n"),
              HasSubstr("element 7 of type DASHPOTA has no value (*DASHPOT)"));
}

const std::string kTurning = kModel + "*NODE\n30, 0, 0, 4\n";

TEST(AbaqusMpc, MeanRotationOfRigidTurnsIsTheirAngleAndOfShiftsNone) {
  const Deck deck = read(kTurning + "*MPC\nMEANROT,5,5,5,6,6,6,7,7,7,8,8,8,30\n");
  ASSERT_EQ(deck.equations.size(), 1u);
  const auto residue = [&](const Eigen::Vector3d& shift, const Eigen::Vector3d& turn,
                           double angle) {
    double sum = 0.0;
    for (const Equation::Term& term : deck.equations[0].terms) {
      if (term.node_index == point(deck, 30)) {
        EXPECT_EQ(term.direction, 3);  // a rotation: DoF 1 of the node after the others
        sum += term.coefficient * angle;
        continue;
      }
      const Eigen::Vector3d x = deck.mesh.nodes.row(term.node_index).transpose();
      sum += term.coefficient * (shift + turn.cross(x))[term.direction];
    }
    return sum;
  };
  EXPECT_NEAR(residue({1, 2, 3}, {0, 0, .25}, .25), 0.0, 1e-15);
  EXPECT_NEAR(residue({0, 0, 0}, {.3, .4, 0}, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(std::abs(residue({0, 0, 0}, {0, 0, .25}, 0.0)), .25, 1e-15);
}

TEST(AbaqusMpc, MeanRotationNeedsAnAxisAndNodesOffIt) {
  EXPECT_THAT(refusal(kTurning + "*MPC\nMEANROT,5,5,5,6,6,6,7\n"),
              HasSubstr("deck.inp:27: *MPC MEANROT: found node 7, expected one of its own"));
  EXPECT_THAT(refusal(kTurning + "*MPC\nMEANROT,1,1,1,5,5,5,30\n"),
              HasSubstr("node 1 lies on the axis through the nodes' centre"));
}

TEST(AbaqusSteps, WithTheStiffnessOfLoadsAreSkippedWithAllAfterThem) {
  const std::string push = "*STEP\n*STATIC\n*CLOAD\n5, 1, 1.\n*END STEP\n";
  const Deck deck = read(kModel + push + "*STEP, PERTURBATION\n*FREQUENCY\n7\n*END STEP\n" + push);
  EXPECT_EQ(deck.steps.size(), 1u);
  ASSERT_EQ(deck.notes.size(), 2u);
  EXPECT_THAT(deck.notes[0],
              HasSubstr("deck.inp:29: *STEP is left out: its stiffness depends on the loads"));
  EXPECT_THAT(deck.notes[1],
              HasSubstr("deck.inp:33: *STEP is left out: it continues a step that is"));
  const Deck large = read(kModel + push + "*STEP, NLGEOM\n*STATIC\n*END STEP\n");
  EXPECT_EQ(large.steps.size(), 1u);
  EXPECT_THAT(large.notes[0], HasSubstr("its displacements are large (NLGEOM)"));
}

TEST(AbaqusSteps, AnEmptyOneAtTheEndIsSkippedWithANote) {
  const std::string push = "*STEP\n*STATIC\n*CLOAD\n5, 1, 1.\n*END STEP\n";
  const Deck deck = read(kModel + push + "*STEP\n");
  EXPECT_EQ(deck.steps.size(), 1u);
  ASSERT_EQ(deck.notes.size(), 1u);
  EXPECT_THAT(deck.notes[0], HasSubstr("deck.inp:29: the deck ends here, with an empty *STEP"));
  EXPECT_THAT(refusal(kModel + push + "*STEP\n*STATIC\n"),
              HasSubstr("deck.inp:29: found *STEP without *END STEP"));
  EXPECT_THAT(refusal(kModel + "*STEP\n"), HasSubstr("deck.inp:24: found *STEP without"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
