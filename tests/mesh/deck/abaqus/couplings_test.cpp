// SPDX-License-Identifier: GPL-3.0-or-later
// Couplings, rigid bodies, ties, equations, masses.
#include <cmath>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::ids_of;
using testing::kModel;
using testing::node;
using testing::point;
using testing::read;
using testing::refusal;

TEST(AbaqusRigid, ARotNodesTranslationsAreRotationsOfTheReference) {
  const Deck deck = read(kModel +
                         "*RIGID BODY, NSET=TOP, REF NODE=9, ROTNODE=10\n"
                         "*BOUNDARY\n10, 3, 3, 0.1\n9, 1, 2\n"
                         "*STEP\n*STATIC\n*CLOAD\n10, 2, 5.\n9, 3, 7.\n*END STEP\n");
  ASSERT_EQ(deck.points.size(), 1u);
  ASSERT_EQ(deck.rigid.size(), 1u);
  EXPECT_EQ(deck.rigid[0].reference, point(deck, 9));
  EXPECT_EQ(deck.rigid[0].dofs, kAllDofs);
  EXPECT_EQ(ids_of(deck, deck.rigid[0].dependents), (std::vector<int32_t>{5, 6, 7, 8}));
  ASSERT_EQ(deck.supports.size(), 2u);
  EXPECT_EQ(deck.supports[0].dofs, kTranslations & 0b011);  // the lower value first
  EXPECT_EQ(deck.supports[1].dofs, 0b100000);
  EXPECT_EQ(deck.supports[1].value, 0.1);
  EXPECT_EQ(deck.supports[1].node_indices, std::vector<NodeIndex>{point(deck, 9)});
  const auto& forces = deck.steps.at(0).forces;
  ASSERT_EQ(forces.size(), 2u);
  EXPECT_EQ(forces[0].direction, 2);
  EXPECT_EQ(forces[1].direction, 4);
  EXPECT_EQ(forces[1].value, 5.0);
}

TEST(AbaqusRigid, AReferenceNodeOfASolidGetsAPointThatMovesIt) {
  const Deck deck = read(kModel + "*RIGID BODY, ELSET=EALL, REF NODE=7\n*BOUNDARY\n7, 1, 6\n");
  ASSERT_EQ(deck.points.size(), 1u);
  const Rigid& rigid = deck.rigid.at(0);
  EXPECT_EQ(rigid.reference, 8);
  EXPECT_EQ(deck.points[0].at, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(rigid.dependents.size(), 8u);  // node 7 itself among them
  EXPECT_EQ(deck.supports.at(0).node_indices, std::vector<NodeIndex>{8});
  EXPECT_EQ(deck.supports.at(0).dofs, kAllDofs);
}

TEST(AbaqusCoupling, AKinematicOneHoldsItsSurface) {
  const Deck deck = read(kModel +
                         "*SURFACE, NAME=LID\nEALL, S2\n*COUPLING, CONSTRAINT NAME=C, REF NODE=9, "
                         "SURFACE=LID\n*KINEMATIC\n1, 1\n3, 6\n");
  const Rigid& rigid = deck.rigid.at(0);
  EXPECT_EQ(rigid.name, "C");
  EXPECT_EQ(rigid.dofs, 0b111101);
  EXPECT_EQ(ids_of(deck, rigid.dependents), (std::vector<int32_t>{5, 6, 7, 8}));
}

TEST(AbaqusCoupling, ADistributingOneWeighsAreasOrNodesAlike) {
  const Deck deck =
      read(kModel +
           "*SURFACE, NAME=LID\nEALL, S2\n*SURFACE, NAME=NODES, TYPE=NODE\nTOP, 1.\n"
           "*COUPLING, CONSTRAINT NAME=A, REF NODE=9, SURFACE=LID\n*DISTRIBUTING\n1, 3\n"
           "*COUPLING, CONSTRAINT NAME=B, REF NODE=10, SURFACE=NODES\n*DISTRIBUTING\n");
  ASSERT_EQ(deck.distributing.size(), 2u);
  EXPECT_EQ(deck.distributing[0].surface, "LID");
  EXPECT_EQ(deck.distributing[0].dofs, kTranslations);
  EXPECT_EQ(deck.distributing[1].dofs, kAllDofs);
  ASSERT_EQ(deck.distributing[1].terms.size(), 1u);
  EXPECT_EQ(deck.distributing[1].terms[0].node_indices.size(), 4u);
  EXPECT_TRUE(deck.mesh.node_sets.contains("NODES"));
}

TEST(AbaqusCoupling, WhatItLacksIsNamed) {
  const std::string coupling = "*COUPLING, CONSTRAINT NAME=C, REF NODE=9, SURFACE=LID\n";
  EXPECT_NE(refusal(kModel + coupling + "*KINEMATIC\n").find("no surface 'LID'"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + coupling).find("expected *KINEMATIC or *DISTRIBUTING"),
            std::string::npos);
  EXPECT_EQ(refusal(kModel + "*KINEMATIC\n"),
            "deck.inp:24: found *KINEMATIC, expected it after *COUPLING");
}

const std::string kDcoup = "*ELEMENT, TYPE=DCOUP3D, ELSET=D\n33, ";

TEST(AbaqusCoupling, ADcoup3dBalancesTheMomentUnlessTheUserIgnoresIt) {
  const std::string card = "*DISTRIBUTING COUPLING, ELSET=D\nTOP, 2.\n";
  const Deck deck = read(kModel + "*NODE\n11, .5, .5, 1\n" + kDcoup + "11\n" + card);
  EXPECT_EQ(deck.distributing.at(0).terms.at(0).weight, 2.0);
  EXPECT_EQ(deck.distributing.at(0).reference, point(deck, 11));
  const Deck lever = read(kModel + kDcoup + "9\n" + card);
  EXPECT_EQ(lever.distributing.at(0).reference, point(lever, 9));
  EXPECT_NE(lever.notes.back().find("ignore = [\"MOMENT\"] loses it"), std::string::npos);
  const Deck mean = read(kModel + kDcoup + "9\n" + card, {"moment"});
  ASSERT_EQ(mean.equations.size(), 3u);
  ASSERT_EQ(mean.equations[2].terms.size(), 5u);
  EXPECT_EQ(mean.equations[2].terms[0].coefficient, 1.0);
  EXPECT_EQ(mean.equations[2].terms[4].coefficient, -0.25);
}

TEST(AbaqusTie, SurfacesOfFacesAndOfNodesAreTied) {
  const Deck deck = read(kModel +
                         "*SURFACE, NAME=UP\nEALL, S2\n*SURFACE, NAME=DOWN, TYPE=NODE\nBOT\n"
                         "*TIE, NAME=T, POSITION TOLERANCE=0.25, ADJUST=NO\nDOWN, UP\n");
  const Tie& tie = deck.ties.at(0);
  EXPECT_EQ(tie.name, "T");
  EXPECT_EQ(tie.master, "UP");
  EXPECT_EQ(tie.distance, 0.25);
  const Surface& slave = deck.mesh.surface(tie.slave);
  EXPECT_EQ(slave.face_count(), 1);
  EXPECT_EQ(ids_of(deck, nodes_of(slave)), (std::vector<int32_t>{1, 2, 3, 4}));
}

TEST(AbaqusTie, NodesThatMakeNoCompleteFaceAreRefused) {
  EXPECT_NE(
      refusal(kModel + "*SURFACE, NAME=UP\nEALL, S2\n*SURFACE, NAME=DOWN, TYPE=NODE\n1, 2, 3\n"
                       "*TIE, NAME=T\nDOWN, UP\n")
          .find("found 3 fields"),
      std::string::npos);
  EXPECT_NE(
      refusal(kModel + "*SURFACE, NAME=UP\nEALL, S2\n*SURFACE, NAME=DOWN, TYPE=NODE\n1\n2\n3\n"
                       "*TIE, NAME=T\nDOWN, UP\n")
          .find("node 1 belongs to no outer face"),
      std::string::npos);
  EXPECT_NE(refusal(kModel + "*TIE, MULTISTAGE, NAME=T\nA, B\n").find("MULTISTAGE"),
            std::string::npos);
}

TEST(AbaqusEquation, TheFirstTermIsTheDependent) {
  const Deck deck =
      read(kModel + "*EQUATION\n2\n7,3,2.,6,1,-1.\n5\n1,1,1.,2,1,-1.,3,1,-1.,4,1,-1.,\n9,2,.5\n");
  ASSERT_EQ(deck.equations.size(), 2u);
  const auto& first = deck.equations[0].terms;
  ASSERT_EQ(first.size(), 2u);
  EXPECT_EQ(first[0].node_index, node(deck, 7));
  EXPECT_EQ(first[0].direction, 2);
  EXPECT_EQ(first[0].coefficient, 2.0);
  const auto& second = deck.equations[1].terms;
  ASSERT_EQ(second.size(), 5u);
  EXPECT_EQ(second[0].node_index, node(deck, 1));
  EXPECT_EQ(second[4].node_index, point(deck, 9));
  EXPECT_EQ(deck.equations[1].where, "deck.inp:27");
}

TEST(AbaqusEquation, HalfEquationsAreRefused) {
  EXPECT_NE(refusal(kModel + "*EQUATION\n2\n1,1,1.\n").find("found 1 terms, expected 2"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*EQUATION\n2\n1,1\n").find("found 2 fields"), std::string::npos);
  EXPECT_NE(refusal(kModel + "*EQUATION\n1\n1,1,0.\n").find("first coefficient is 0"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*EQUATION\n2\n1,4,1.,2,1,1.\n").find("no rotations"),
            std::string::npos);
  EXPECT_NE(refusal(kModel + "*EQUATION\n2\nTOP,1,1.,NALL,1,1.\n").find("found sets of 4 and"),
            std::string::npos);
}

// Displacements that satisfy the deck's equations must satisfy ours.
TEST(AbaqusEquation, TransformedNodesKeepTheMeaningOfTheirEquations) {
  const Deck deck = read(kModel +
                         "*TRANSFORM, NSET=TOP, TYPE=R\n3,4,0,-4,3,0\n"
                         "*EQUATION\n2\n5,1,1.,1,1,-1.\n2\n5,2,1.,1,2,-1.\n2\n5,3,1.,6,1,-2.\n");
  ASSERT_EQ(deck.equations.size(), 3u);
  const Eigen::Vector3d x(0.6, 0.8, 0), y(-0.8, 0.6, 0), z(0, 0, 1);
  const Eigen::Vector3d u1(0.3, -0.7, 0.2), u6(1.1, 0.4, -0.9);
  // u5 in its axes: (u1x, u1y, 2 * u6 along x').
  const Eigen::Vector3d u5 = u1[0] * x + u1[1] * y + 2 * u6.dot(x) * z;
  std::array<bool, 3> dependent{};
  for (const Equation& equation : deck.equations) {
    EXPECT_EQ(equation.terms[0].node_index, node(deck, 5));
    dependent[equation.terms[0].direction] = true;
    double sum = 0.0;
    for (const auto& term : equation.terms) {
      const Eigen::Vector3d& u = term.node_index == node(deck, 5)   ? u5
                                 : term.node_index == node(deck, 1) ? u1
                                                                    : u6;
      sum += term.coefficient * u[term.direction];
      const bool first = &term == &equation.terms[0];
      EXPECT_TRUE(first || term.node_index != node(deck, 5));  // each solved for its own direction
    }
    EXPECT_NEAR(sum, 0.0, 1e-15);  // a few roundings of numbers near 1
  }
  EXPECT_TRUE(dependent[0] && dependent[1] && dependent[2]);
}

TEST(AbaqusMpc, PinTieAndBeamAreReadOthersRefused) {
  const Deck deck = read(kModel + "*MPC\nPIN, 5, 1\nTIE, 6, 2\nBEAM, 7, 9\n");
  EXPECT_EQ(deck.equations.size(), 6u);
  ASSERT_EQ(deck.rigid.size(), 1u);
  EXPECT_EQ(deck.rigid[0].reference, point(deck, 9));
  EXPECT_EQ(deck.rigid[0].dependents, std::vector<NodeIndex>{node(deck, 7)});
  EXPECT_NE(refusal(kModel + "*MPC\nDIST, 5, 1, 2, 3\n").find("*MPC of type DIST"),
            std::string::npos);
}

TEST(AbaqusMass, PointsCarryMassAndInertia) {
  const Deck deck =
      read(kModel +
           "*ELEMENT, TYPE=MASS, ELSET=M\n50, 9\n51, 5\n*MASS, ELSET=M\n.25\n"
           "*ELEMENT, TYPE=ROTARYI, ELSET=R\n52, 9\n*ROTARY INERTIA, ELSET=R\n1,2,3\n");
  ASSERT_EQ(deck.masses.size(), 3u);
  EXPECT_EQ(deck.masses[0].node_index, point(deck, 9));
  EXPECT_EQ(deck.masses[0].mass, 0.25);
  EXPECT_EQ(deck.masses[1].node_index, node(deck, 5));
  EXPECT_EQ(deck.masses[2].inertia.diagonal(), Eigen::Vector3d(1, 2, 3));
}

TEST(AbaqusMass, WhatHasNoValueOrNoRotationsIsNamed) {
  EXPECT_NE(refusal(kModel + "*ELEMENT, TYPE=MASS\n50, 9\n").find("element 50 of type MASS"),
            std::string::npos);
  EXPECT_NE(
      refusal(kModel + "*ELEMENT, TYPE=ROTARYI, ELSET=R\n52, 5\n*ROTARY INERTIA, ELSET=R\n1,2,3\n")
          .find("has no rotations"),
      std::string::npos);
  EXPECT_NE(refusal(kModel + "*MASS, ELSET=EALL\n1.\n").find("expected elements MASS in EALL"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::mesh::deck
