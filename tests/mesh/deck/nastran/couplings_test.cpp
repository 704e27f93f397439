// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mesh::deck::Deck;
using mesh::deck::Equation;
using mesh::deck::kAllDofs;
using mesh::deck::kTranslations;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Rounding of sines and of a few products of numbers of size 1.
constexpr double kCouplingsRounding = 1e-14;

// Grid 9 next to the tetrahedron; cylindrical system 5 about basic z; grid 8 moves in it.
const std::string kPoints =
    "GRID,9,,3.,4.,5.\n"
    "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n"
    "GRID,8,,3.,4.,0.,5\n";

// The value of an equation for a rigid motion x -> u + theta x x of all its nodes.
double residual(const Deck& deck, const Equation& equation, const Vector3d& u,
                const Vector3d& theta) {
  double sum = 0.0;
  for (const auto& term : equation.terms) {
    const auto nodes = static_cast<mesh::deck::NodeIndex>(deck.mesh.nodes.rows());
    const Vector3d at = term.node_index < nodes
                            ? Vector3d(deck.mesh.nodes.row(term.node_index).transpose())
                            : deck.points[term.node_index - nodes].at;
    const Vector3d move = u + theta.cross(at);
    sum +=
        term.coefficient * (term.direction < 3 ? move[term.direction] : theta[term.direction - 3]);
  }
  return sum;
}

TEST(NastranCouplings, Rbe2TiesItsDependentsToAPoint) {
  const Deck deck = read_deck(kTet + kPoints + "RBE2,7,9,123,1,THRU,3\n");
  ASSERT_THAT(deck.points, SizeIs(1));
  EXPECT_EQ(deck.points[0].id, 9);
  EXPECT_EQ(deck.points[0].at, Vector3d(3, 4, 5));
  ASSERT_THAT(deck.rigid, SizeIs(1));
  EXPECT_EQ(deck.rigid[0].name, "rbe2_7");
  EXPECT_EQ(deck.rigid[0].where, "t.bdf:12");
  EXPECT_EQ(deck.rigid[0].reference, 4);  // the first point, after four nodes
  EXPECT_EQ(deck.rigid[0].dofs, kTranslations);
  EXPECT_THAT(deck.rigid[0].dependents, ElementsAre(0, 1, 2));
}

TEST(NastranCouplings, Rbe2OverManyLinesAndWithAlpha) {
  EXPECT_THAT(read_deck(kTet + kPoints + "RBE2,7,9,123456,1,2,3,4,8,+\n+,0.\n").rigid[0].dependents,
              ElementsAre(0, 1, 2, 3, 5));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE2,7,9,123456,1,2,1.-5\n"),
              HasSubstr("thermal expansion"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE2,7,9,123\n"), HasSubstr("expected a dependent grid"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE2,7,9,127,1\n"),
              HasSubstr("found '127', expected digits 1 to 6"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE2,7,9,123,9,1\n"),
              HasSubstr("its reference 9 is a dependent"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE2,7,90,123,1\n"),
              HasSubstr("t.bdf:12: found no GRID 90"));
}

TEST(NastranCouplings, AllTranslationsOfADependentAreTheSameInEveryFrame) {
  const Deck deck = read_deck(kTet + kPoints + "RBE2,7,9,123456,8\n");
  EXPECT_THAT(deck.equations, IsEmpty());
  EXPECT_THAT(deck.rigid, SizeIs(1));
}

TEST(NastranCouplings, Rbe2InSomeDirectionsOfACylinderGivesEquations) {
  const Deck deck = read_deck(kTet + kPoints + "RBE2,7,9,13,8\n");  // r and z at (3, 4, 0)
  EXPECT_THAT(deck.rigid, IsEmpty());
  ASSERT_THAT(deck.equations, SizeIs(2));
  for (const Equation& equation : deck.equations) {
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(residual(deck, equation, Vector3d::Unit(k), Vector3d::Zero()), 0,
                  kCouplingsRounding);
      EXPECT_NEAR(residual(deck, equation, Vector3d::Zero(), Vector3d::Unit(k)), 0,
                  kCouplingsRounding);
    }
    EXPECT_EQ(equation.terms[0].node_index, deck.equations[0].terms[0].node_index);
    EXPECT_EQ(equation.terms[0].coefficient, 1.0);
  }
  // The pivots differ: neither row makes the other's dependent a part of it.
  EXPECT_EQ(deck.equations[0].terms[0].direction, 1);  // r = (0.6, 0.8, 0): y is the larger part
  EXPECT_EQ(deck.equations[1].terms[0].direction, 2);
  // Sliding around the cylinder is free: it appears with coefficient zero.
  const Vector3d slide(-0.8, 0.6, 0);
  for (const Equation& equation : deck.equations) {
    double sum = 0.0;
    for (const auto& term : equation.terms) {
      if (term.node_index == equation.terms[0].node_index)
        sum += term.coefficient * slide[term.direction];
    }
    EXPECT_NEAR(sum, 0, kCouplingsRounding);
  }
}

TEST(NastranCouplings, Rbe3KeepsItsWeightGroups) {
  const Deck deck =
      read_deck(kTet + kPoints + "RBE3,7,,9,123456,1.,123,1,2,+\n+,2.5,12,3,THRU,4\n");
  ASSERT_THAT(deck.distributing, SizeIs(1));
  const auto& rbe3 = deck.distributing[0];
  EXPECT_EQ(rbe3.name, "rbe3_7");
  EXPECT_EQ(rbe3.reference, 4);
  EXPECT_EQ(rbe3.dofs, kAllDofs);
  ASSERT_THAT(rbe3.terms, SizeIs(2));
  EXPECT_EQ(rbe3.terms[0].weight, 1.0);
  EXPECT_EQ(rbe3.terms[0].dofs, kTranslations);
  EXPECT_THAT(rbe3.terms[0].node_indices, ElementsAre(0, 1));
  EXPECT_EQ(rbe3.terms[1].weight, 2.5);
  EXPECT_EQ(rbe3.terms[1].dofs, 0b011);
  EXPECT_THAT(rbe3.terms[1].node_indices, ElementsAre(2, 3));
}

TEST(NastranCouplings, Rbe3UmNamesAsManyDofsAsTheReferenceHas) {
  const std::string rbe3 = "RBE3,7,,9,123,1.,123,1,2,+\n+,3,4,,,,,,,+\n+,UM,";
  EXPECT_THAT(read_deck(kTet + kPoints + rbe3 + "1,12,2,3\n").distributing[0].terms, SizeIs(1));
  EXPECT_THAT(refusal(kTet + kPoints + rbe3 + "1,12\n"),
              HasSubstr("UM: found 2 components, expected 3"));
}

TEST(NastranCouplings, Rbe3ThatCannotBeRightIsRefused) {
  EXPECT_THAT(refusal(kTet + kPoints + "RBE3,7,,9,123,1.,12,8\n"),
              HasSubstr("some directions of a displacement system"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE3,7,,9,123,-1.,123,1\n"),
              HasSubstr("a positive weight"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE3,7,,9,123\n"), HasSubstr("WT1: found nothing"));
  EXPECT_THAT(refusal(kTet + kPoints + "RBE3,7,5,9,123,1.,123,1\n"), HasSubstr("a blank field"));
}

TEST(NastranCouplings, Rbe3LeavesOutRotationsOfSolidsAndSaysSo) {
  const Deck deck = read_deck(kTet + kPoints +
                              "GRID,12,,1.,1.,1.\nRBE3,7,,9,123,1.,123456,1,2,+\n+,12\nENDDATA\n");
  const auto& terms = deck.distributing.at(0).terms;
  ASSERT_THAT(terms, SizeIs(2));
  EXPECT_EQ(terms[0].dofs, kAllDofs);  // of the point
  EXPECT_EQ(terms[1].dofs, kTranslations);
  EXPECT_THAT(terms[1].node_indices, ElementsAre(0, 1));
  EXPECT_THAT(deck.notes, testing::Contains(HasSubstr("components 456 of 2 nodes of solids")));
}

TEST(NastranCouplings, BarsWithSixIndependentDofsAtOneEndAreRigid) {
  // RBAR with blank dependents: all others; from either end; RBAR1, RJOINT, RBE1 of one grid.
  const auto rigid = [](const std::string& card) {
    const Deck deck = read_deck(kTet + kPoints + "GRID,11,,3.,4.,7.\n" + card + "\n");
    EXPECT_TRUE(deck.equations.empty()) << card;
    return deck.rigid.at(0);
  };
  const auto forward = rigid("RBAR,7,9,11,123456");
  EXPECT_EQ(forward.name, "rbar_7");
  EXPECT_EQ(forward.dofs, kAllDofs);
  EXPECT_EQ(forward.reference, rigid("RBE2,7,9,123456,11").reference);
  EXPECT_EQ(forward.dependents, rigid("RBE2,7,9,123456,11").dependents);
  EXPECT_EQ(rigid("RBAR,7,11,9,,123456,123").dofs, kTranslations);
  EXPECT_EQ(rigid("RBAR1,7,9,11,1235").dofs, 0b010111);
  EXPECT_EQ(rigid("RJOINT,7,9,11").dofs, kAllDofs);
  EXPECT_EQ(rigid("RBE1,7,9,123456,,,,,,+\n+,UM,11,123").dofs, kTranslations);
}

// u_A = (x, y, z) and rotations at A alone hold a bar as well as displacements of A, two of B and a
// rotation about it do: grid 11 is 2 above grid 9.
TEST(NastranCouplings, BarsWithIndependentDofsAtBothEndsAreEquations) {
  const Deck deck = read_deck(kTet + kPoints + "GRID,11,,3.,4.,7.\nRBAR,7,9,11,1236,12,45,3456\n");
  EXPECT_TRUE(deck.rigid.empty());
  // rx of A: u_By - u_Ay = -2 rx.
  const auto rx = std::find_if(deck.equations.begin(), deck.equations.end(), [](const auto& one) {
    return one.terms[0].direction == 3 && one.terms[0].node_index == 4;
  });
  ASSERT_NE(rx, deck.equations.end());
  std::map<std::pair<int, int>, double> c;  // by node and direction
  for (const auto& term : rx->terms) c[{term.node_index, term.direction}] += term.coefficient;
  EXPECT_NEAR((c[{4, 3}]), 1.0, 1e-14);
  EXPECT_NEAR((c[{5, 1}]), 0.5, 1e-14);
  EXPECT_NEAR((c[{4, 1}]), -0.5, 1e-14);
  EXPECT_THAT(refusal(kTet + kPoints + "GRID,11,,3.,4.,7.\nRBAR,7,9,11,123,123\n"),
              HasSubstr("rbar_7: found 6 independent components, of which 5 hold it"));
}

TEST(NastranCouplings, BarsOfThreeIndependentDisplacementsTurnNothing) {
  const Deck deck = read_deck(kTet + "RBAR,7,1,4,123\nENDDATA\n");
  ASSERT_THAT(deck.equations, SizeIs(3));  // u_4 = u_1
  for (const Equation& one : deck.equations) {
    ASSERT_THAT(one.terms, SizeIs(2));
    EXPECT_EQ(one.terms[0].node_index, 3);
    EXPECT_EQ(one.terms[1].node_index, 0);
    EXPECT_NEAR(one.terms[0].coefficient + one.terms[1].coefficient, 0.0, 1e-14);
  }
  EXPECT_THAT(deck.notes,
              testing::Contains(HasSubstr("3 independent components: the other motions")));
}

TEST(NastranCouplings, RrodKeepsItsLength) {
  const Deck deck = read_deck(kTet + "RROD,7,2,3,1\n");  // from (1, 0, 0) to (0, 1, 0)
  ASSERT_THAT(deck.equations, SizeIs(1));
  double sum = 0.0;  // a motion across the rod
  for (const auto& term : deck.equations[0].terms)
    if (term.node_index == 1) sum += term.coefficient * (term.direction < 2 ? 1.0 : 0.0);
  EXPECT_NEAR(sum, 0.0, 1e-14);
  EXPECT_THAT(refusal(kTet + "RROD,7,2,3,3\n"), HasSubstr("a dependent component across the rod"));
}

TEST(NastranCouplings, Conm2BesideANodeOfSolidsHangsOnItsNeighbours) {
  const Deck deck = read_deck(kTet + "CONM2,7,1,,5.,1.,2.,3.\nENDDATA\n");
  ASSERT_THAT(deck.distributing, SizeIs(1));
  EXPECT_THAT(deck.distributing[0].terms.at(0).node_indices, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(deck.points.at(0).at, Vector3d(1, 2, 3));
  EXPECT_EQ(deck.points.at(0).id, 5);  // above all grids
  EXPECT_EQ(deck.masses.at(0).node_index, 4);
  EXPECT_EQ(deck.masses.at(0).offset, Vector3d(0, 0, 0));
  EXPECT_THAT(deck.notes, testing::Contains(HasSubstr("offset mass hangs on the 4 nodes")));
}

TEST(NastranCouplings, Conm2InertiaTurnsWithItsSystem) {
  const std::string inertia = "+\n+,1.,.1,2.,.2,.3,3.\n";
  const Deck basic = read_deck(kTet + kPoints + "CONM2,7,9,,5.,1.,2.,3.,," + inertia);
  ASSERT_THAT(basic.masses, SizeIs(1));
  EXPECT_EQ(basic.masses[0].mass, 5.0);
  EXPECT_EQ(basic.masses[0].offset, Vector3d(1, 2, 3));
  Matrix3d tensor;  // I21, I31, I32 are products of inertia: the tensor has their negatives
  tensor << 1, -.1, -.2, -.1, 2, -.3, -.2, -.3, 3;
  EXPECT_EQ(basic.masses[0].inertia, tensor);

  // At (3, 4, 5) the directions r, theta of system 5 are (0.6, 0.8, 0), (-0.8, 0.6, 0).
  const Deck local = read_deck(kTet + kPoints + "CONM2,7,9,5,5.,1.,2.,3.,," + inertia);
  Matrix3d axes;
  axes << .6, -.8, 0, .8, .6, 0, 0, 0, 1;
  EXPECT_LT((local.masses[0].offset - axes * Vector3d(1, 2, 3)).norm(), kCouplingsRounding);
  EXPECT_LT((local.masses[0].inertia - axes * tensor * axes.transpose()).norm(),
            kCouplingsRounding);

  // CID -1: the centre in basic coordinates.
  const Deck centre = read_deck(kTet + kPoints + "CONM2,7,9,-1,5.,3.,4.,6.\n");
  EXPECT_EQ(centre.masses[0].offset, Vector3d(0, 0, 1));
  EXPECT_THAT(refusal(kTet + "CONM2,7,1,6,5.\n"),
              HasSubstr("t.bdf:8: found no coordinate system 6"));
}

TEST(NastranCouplings, MpcTermsTurnIntoTheBasicFrame) {
  const Deck deck = read_deck(kTet + kPoints + "MPC,7,1,1,2.,8,1,-1.,,+\n+,,9,4,.5\n");
  ASSERT_THAT(deck.equations, SizeIs(1));
  const auto& terms = deck.equations[0].terms;
  ASSERT_THAT(terms, SizeIs(4));  // -1 times r = (0.6, 0.8, 0) at grid 8
  EXPECT_EQ(terms[0].node_index, 0);
  EXPECT_EQ(terms[0].direction, 0);
  EXPECT_EQ(terms[0].coefficient, 2.0);
  EXPECT_EQ(terms[1].direction, 1);
  EXPECT_NEAR(terms[1].coefficient, -0.8, kCouplingsRounding);
  EXPECT_EQ(terms[2].direction, 0);
  EXPECT_NEAR(terms[2].coefficient, -0.6, kCouplingsRounding);
  EXPECT_EQ(terms[3].direction, 3);
  EXPECT_EQ(terms[3].coefficient, 0.5);
}

TEST(NastranCouplings, MpcSetsAreChosenLikeSpcSets) {
  const std::string mpcs = "MPC,1,1,1,2.,2,1,-1.\nMPC,2,1,2,2.,2,2,-1.\n";
  EXPECT_THAT(read_deck(kTet + mpcs + "MPCADD,3,1,2\n").equations, SizeIs(2));
  EXPECT_THAT(read_deck("CEND\nMPC = 2\nBEGIN BULK\n" + kTet + mpcs).equations, SizeIs(1));
  EXPECT_THAT(read_deck("CEND\nSPC = 4\nBEGIN BULK\n" + kTet + mpcs + "SPC1,4,1,1\n").equations,
              IsEmpty());
  EXPECT_THAT(refusal(kTet + mpcs), HasSubstr("found 2 MPC sets (1, 2)"));
  EXPECT_THAT(refusal("CEND\nMPC=1\nSUBCASE 1\nSUBCASE 2\nMPC=2\nBEGIN BULK\n" + kTet + mpcs),
              HasSubstr("subcase 2: found MPC = 2, expected 1"));
  // A rotation of a node of solids turns freely but for the equation.
  EXPECT_EQ(read_deck(kTet + "MPC,1,2,1,2.,1,4,-1.\n").equations.at(0).terms.at(1).direction, 3);
  EXPECT_THAT(refusal(kTet + "MPC,1,1,12,2.,2,1,-1.\n"), HasSubstr("expected one digit"));
  EXPECT_THAT(refusal(kTet + "MPC,1,1,1,0.,2,1,-1.\n"), HasSubstr("first term"));
}

}  // namespace
}  // namespace clatter::test
