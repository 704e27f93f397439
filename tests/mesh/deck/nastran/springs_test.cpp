// SPDX-License-Identifier: GPL-3.0-or-later
// CELAS1, CELAS2 and PELAS.
#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::deck::Deck;
using testing::HasSubstr;

TEST(NastranSpring, OfTwoGridsOrToTheGround) {
  const Deck deck = read_deck(kTet +
                              "GRID,9,,3.,4.,5.\n"
                              "CELAS2,11,7.5,9,1,2,1\n"
                              "CELAS1,12,3,2,3\n"
                              "PELAS,3,8.5,,,4,9.5\n");
  ASSERT_EQ(deck.springs.size(), 2u);
  EXPECT_EQ(deck.springs[0].stiffness, 7.5);
  ASSERT_EQ(deck.springs[0].terms.size(), 2u);
  EXPECT_EQ(deck.springs[0].terms[0].node_index, 4);  // the point after four nodes
  EXPECT_EQ(deck.springs[0].terms[0].coefficient, 1.0);
  EXPECT_EQ(deck.springs[0].terms[1].node_index, 1);
  EXPECT_EQ(deck.springs[0].terms[1].coefficient, -1.0);
  EXPECT_EQ(deck.springs[1].stiffness, 8.5);
  ASSERT_EQ(deck.springs[1].terms.size(), 1u);
  EXPECT_EQ(deck.springs[1].terms[0].direction, 2);
}

TEST(NastranSpring, ActsInTheDisplacementSystemOfItsGrid) {
  const Deck deck = read_deck(kTet +
                              "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n"
                              "GRID,8,,3.,4.,0.,5\n"
                              "CELAS2,11,7.5,8,1\n");
  ASSERT_EQ(deck.springs.size(), 1u);
  ASSERT_EQ(deck.springs[0].terms.size(), 2u);  // radially outward at (3, 4, 0)
  EXPECT_EQ(deck.springs[0].terms[0].direction, 1);
  EXPECT_NEAR(deck.springs[0].terms[0].coefficient, 0.8, 1e-14);
  EXPECT_NEAR(deck.springs[0].terms[1].coefficient, 0.6, 1e-14);
}

TEST(NastranSpring, WithoutMeaningIsRefusedByLine) {
  EXPECT_THAT(refusal(kTet + "CELAS1,12,3,2,3\n"), HasSubstr("t.bdf:8: found no PELAS 3"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,-1.,2,3\n"), HasSubstr("t.bdf:8: CELAS2"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.,2,3,,,-.05\n"), HasSubstr("a loss factor of 0 or more"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.,2,4\n"), HasSubstr("rotation of node 2 of solids"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.\n"), HasSubstr("t.bdf:8: CELAS2"));
  EXPECT_THAT(refusal(kTet + "GRID,9,,3.,4.,5.\nCELAS2,12,1.,9,4,2,1\n"),
              HasSubstr("rotation against a displacement"));
}

std::vector<double> losses_of(const Deck& deck) {
  std::vector<double> losses;
  for (const mesh::deck::Spring& spring : deck.springs) losses.push_back(spring.loss_factor);
  return losses;
}

TEST(NastranSpring, HasTheLossFactorOfItsCardOrProperty) {
  const std::string springs =
      "CELAS2,11,7.5,2,1,,,.05\nCELAS1,12,3,2,3\nCELAS1,13,4,3,3\nPELAS,3,8.5,.1,,4,9.5\n";
  EXPECT_THAT(losses_of(read_deck(kTet + springs)), testing::ElementsAre(.05, .1, 0.0));
}

TEST(NastranSpring, HasTheLossFactorOfAllStiffnessBesideItsOwn) {
  const Deck deck = read_deck(kTet + "PARAM,G,.02\nCELAS2,11,7.5,2,1,,,.05\nENDDATA\n");
  EXPECT_THAT(losses_of(deck), testing::ElementsAre(testing::DoubleEq(.07)));
  EXPECT_EQ(deck.materials.at("mat_1").loss_factor, .02);
  EXPECT_THAT(deck.notes, testing::Contains(HasSubstr("PARAM, G: 0.02 is added to the loss")));
  EXPECT_THAT(refusal(kTet + "PARAM,G,-.02\n"),
              HasSubstr("PARAM G: found '-.02', expected a loss"));
}

// Two points 2 apart along z: the springs are in the middle.
const std::string kTwo = "GRID,9,,0.,0.,3.\nGRID,10,,0.,0.,5.\n";

TEST(NastranBush, HasSpringsAlongItsAxesWithLevers) {
  const Deck deck = read_deck(kTet + kTwo + "CBUSH,7,8,9,10,1.,0.,0.\nPBUSH,8,K,10.,20.,,40.\n");
  ASSERT_EQ(deck.springs.size(), 3u);
  const auto terms = [&](size_t i) {
    std::map<std::pair<int, int>, double> c;
    for (const auto& term : deck.springs[i].terms)
      c[{term.node_index, term.direction}] += term.coefficient;
    return c;
  };
  // Along the axis z: no lever.
  EXPECT_EQ(deck.springs[0].stiffness, 10.0);
  EXPECT_EQ(terms(0), (std::map<std::pair<int, int>, double>{{{4, 2}, -1.0}, {{5, 2}, 1.0}}));
  // Along the orientation x: u_x + 1 ry at the lower end, u_x - 1 ry at the upper one.
  EXPECT_EQ(deck.springs[1].stiffness, 20.0);
  EXPECT_EQ(terms(1), (std::map<std::pair<int, int>, double>{
                          {{4, 0}, -1.0}, {{4, 4}, -1.0}, {{5, 0}, 1.0}, {{5, 4}, -1.0}}));
  EXPECT_EQ(deck.springs[2].stiffness, 40.0);
  EXPECT_EQ(terms(2), (std::map<std::pair<int, int>, double>{{{4, 5}, -1.0}, {{5, 5}, 1.0}}));
}

TEST(NastranBush, OfOneGridOrCoincidentOnesHasASystem) {
  const Deck deck = read_deck(kTet + kTwo + "CBUSH,7,8,9,,,,,0\nPBUSH,8,K,10.,,,,,,+\n+,,B,3.\n");
  ASSERT_EQ(deck.springs.size(), 1u);
  ASSERT_EQ(deck.springs[0].terms.size(), 1u);
  EXPECT_EQ(deck.springs[0].terms[0].coefficient, 1.0);
  EXPECT_EQ(deck.springs[0].terms[0].direction, 0);
  EXPECT_THAT(refusal(kTet + kTwo + "CBUSH,7,8,9\nPBUSH,8,K,10.\n"), HasSubstr("found no CID"));
  EXPECT_THAT(refusal(kTet + kTwo + "CBUSH,7,8,9,10\nPBUSH,8,K,10.,10.\n"),
              HasSubstr("found no orientation beside its axis"));
  EXPECT_EQ(refusal(kTet + kTwo + "CBUSH,7,8,9,10\nPBUSH,8,K,10.,,,10.\n"), "");
  EXPECT_THAT(refusal(kTet + kTwo + "CBUSH,7,8,9,10\n"), HasSubstr("CBUSH 7: found no PBUSH 8"));
}

TEST(NastranBush, HasLossFactorsByAxisWhereOneCardNamesSeveral) {
  const std::string bushes = kTet + kTwo + "CBUSH,7,8,9,10,,,,0\nPBUSH,8,K,10.,20.,,,40.,,+\n";
  EXPECT_THAT(losses_of(read_deck(bushes + "+,,GE,.1\n")), testing::ElementsAre(.1, .1, .1));
  EXPECT_THAT(losses_of(read_deck(bushes + "+,,GE,.1,,,,.3\n")), testing::ElementsAre(.1, 0., .3));
  EXPECT_THAT(losses_of(read_deck(bushes + "+,,GE,.1\nPBUSH,9,K,1.,,,,,,+\n+,,GE,,.2\n")),
              testing::ElementsAre(.1, 0., 0.));
  EXPECT_THAT(read_deck(bushes + "+,,B,3.\n").passed, HasSubstr("damping: PBUSH B"));
}

TEST(NastranBush, OfRowsThatAreNotReadIsRefused) {
  const std::string bush = kTet + kTwo + "CBUSH,7,8,9,10,,,,0\n";
  EXPECT_THAT(refusal(bush + "PBUSH,8,KMAG,10.\n"), HasSubstr("expected K = KMAG cos(ANGLE)"));
  EXPECT_THAT(refusal(bush + "PBUSH,8,KK,10.\n"), HasSubstr("found 'KK', expected K, B, GE"));
  EXPECT_THAT(refusal(bush + "PBUSH,8,K,RIGID\n"), HasSubstr("or an RBE2 for the CBUSH"));
  EXPECT_THAT(refusal(bush + "PBUSH,8,K,1.,,,,,,+\n+,,M,1.\n"), HasSubstr("expected a CONM2"));
}

TEST(NastranBush, LeavesOutRotationsOfSolidsAndSaysSo) {
  const Deck deck =
      read_deck(kTet + kTwo + "CBUSH,7,8,9,1,,,,0\nPBUSH,8,K,10.,10.,10.,40.,40.,40.\nENDDATA\n");
  EXPECT_EQ(deck.springs.size(), 3u);
  EXPECT_THAT(deck.notes, testing::Contains(HasSubstr("CBUSH 7: K4 to K6 are left out")));
}

TEST(NastranScalars, PointsHaveOneDof) {
  const Deck deck = read_deck(kTet +
                              "SPOINT,101,102\nCELAS4,1,7.5,101,102\nCELAS2,2,8.5,101,,4,3\n"
                              "CMASS4,3,2.,102\nCMASS2,4,3.,101,0,4,1\nSPC1,5,0,101\n");
  ASSERT_EQ(deck.points.size(), 2u);
  ASSERT_EQ(deck.springs.size(), 2u);
  EXPECT_EQ(deck.springs[0].terms[0].direction, 0);
  EXPECT_EQ(deck.springs[1].terms[1].direction, 2);
  ASSERT_EQ(deck.matrices.size(), 2u);
  EXPECT_EQ(deck.matrices[0].values, Eigen::MatrixXd::Constant(1, 1, 2.0));
  Eigen::Matrix2d two;
  two << 3, -3, -3, 3;
  EXPECT_EQ(deck.matrices[1].values, Eigen::MatrixXd(two));
  // The other five DoFs of both, and x of the first.
  ASSERT_EQ(deck.supports.size(), 2u);
  EXPECT_EQ(deck.supports[0].dofs, 0b111110);
  EXPECT_EQ(deck.supports[1].dofs, 0b000001);
  EXPECT_THAT(refusal(kTet + "CELAS2,2,8.5,1\n"), HasSubstr("C: found nothing for grid 1"));
}

TEST(NastranMatrices, DmigIsWhatCaseControlChooses) {
  const std::string bulk =
      kTet + kTwo + "DMIG,KB,0,6,1,0\nDMIG,KB,9,1,,9,1,5.,,+\n+,1,2,-4.\nDMIG,KB,1,2,,1,2,6.\n";
  EXPECT_TRUE(read_deck("CEND\nBEGIN BULK\n" + bulk).matrices.empty());
  const Deck deck = read_deck("CEND\nK2GG = 2.*KB\nBEGIN BULK\n" + bulk);
  ASSERT_EQ(deck.matrices.size(), 1u);
  const auto& matrix = deck.matrices[0];
  EXPECT_FALSE(matrix.is_mass);
  Eigen::Matrix2d expected;
  expected << 10, -8, -8, 12;
  EXPECT_EQ(matrix.values, Eigen::MatrixXd(expected));
  EXPECT_EQ(matrix.terms[0].node_index, 4);
  EXPECT_EQ(matrix.terms[1].direction, 1);
  EXPECT_THAT(refusal("CEND\nM2GG = MB\nBEGIN BULK\n" + bulk), HasSubstr("found no DMIG"));
  EXPECT_THAT(refusal("CEND\nK2GG = KB\nBEGIN BULK\n" + kTet + "DMIG,KB,0,6,3,0\n"),
              HasSubstr("found complex numbers"));
  // A header alone is a matrix of zeros.
  EXPECT_TRUE(
      read_deck("CEND\nK2GG = KB\nBEGIN BULK\n" + kTet + "DMIG,KB,0,6,1,0\n").matrices.empty());
}

TEST(NastranMatrices, Conm1IsAMassOrAMatrix) {
  const Deck deck = read_deck(kTet + kTwo +
                              "CONM1,1,9,0,10.,0.,10.,0.,0.,+\n+,10.\n"
                              "CONM1,2,10,0,1.,0.,2.,0.,0.,+\n+,3.\n");
  ASSERT_EQ(deck.masses.size(), 1u);
  EXPECT_EQ(deck.masses[0].mass, 10.0);
  ASSERT_EQ(deck.matrices.size(), 1u);
  EXPECT_TRUE(deck.matrices[0].is_mass);
  EXPECT_EQ(deck.matrices[0].values.diagonal().head<3>(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(refusal(kTet + "CONM1,1,1,0,1.,0.,1.,0.,0.,+\n+,1.,,,,5.\n"),
              HasSubstr("found an inertia or offset on node 1 of solids"));
}

// Two points 2 apart along z. A gap that is closed at first is a spring along its axis and one in
// each direction across it, without levers: a solid node of this gap has no rotation.
TEST(NastranGap, HasTheStiffnessOfTheStateInWhichItBegins) {
  const Deck closed = read_deck(kTet + kTwo + "CGAP,7,8,9,10\nPGAP,8,0.,5.,1000.,,,.25\nENDDATA\n");
  ASSERT_EQ(closed.springs.size(), 3u);
  EXPECT_EQ(closed.springs[0].stiffness, 1000.0);
  ASSERT_EQ(closed.springs[0].terms.size(), 2u);
  EXPECT_EQ(closed.springs[0].terms[0].direction, 2);  // along z
  for (const size_t across : {size_t{1}, size_t{2}}) {
    EXPECT_EQ(closed.springs[across].stiffness, 250.0);  // MU1 KA
    for (const auto& term : closed.springs[across].terms) EXPECT_LT(term.direction, 2);
  }
  EXPECT_THAT(closed.notes, testing::Contains(HasSubstr(
                                "t.bdf:10: CGAP stay as they begin, as in a linear solution: 1 "
                                "closed (KA, KT), 0 open (KB)")));
  const Deck open = read_deck(kTet + kTwo + "CGAP,7,8,9,1,,,,0\nPGAP,8,.1,,1000.,3.,400.\n");
  ASSERT_EQ(open.springs.size(), 1u);  // KT acts where the gap is closed
  EXPECT_EQ(open.springs[0].stiffness, 3.0);
  const Deck by_default = read_deck(kTet + kTwo + "CGAP,8,,9,10\nPGAP,8,.1,,1000.\n");
  EXPECT_DOUBLE_EQ(by_default.springs.at(0).stiffness, 1e-11);  // KB is 1e-14 KA
}

TEST(NastranGap, WithoutMeaningIsRefusedByLine) {
  EXPECT_THAT(refusal(kTet + kTwo + "CGAP,7,8,9,10\n"),
              HasSubstr("t.bdf:10: CGAP 7: found no PGAP 8"));
  EXPECT_THAT(refusal(kTet + kTwo + "CGAP,7,8,9,10\nPGAP,8,0.,,AUTO\n"),
              HasSubstr("PGAP: KA: found 'AUTO', expected a number"));
  EXPECT_THAT(refusal(kTet + kTwo + "CGAP,7,8,9,10\nPGAP,8\n"),
              HasSubstr("PGAP: KA: found nothing, expected a stiffness above 0"));
  EXPECT_THAT(refusal(kTet + kTwo + "CGAP,7,8,9\nPGAP,8,,,1.\n"),
              HasSubstr("CGAP: GB: found nothing"));
  EXPECT_THAT(refusal(kTet + kTwo + "GRID,11,,0.,0.,3.\nCGAP,7,8,9,11\nPGAP,8,,,1.\n"),
              HasSubstr("CGAP 7: found no CID"));
}

}  // namespace
}  // namespace clatter::test
