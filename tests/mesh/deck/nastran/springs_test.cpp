// SPDX-License-Identifier: GPL-3.0-or-later
// CELAS1, CELAS2 and PELAS.
#include <gmock/gmock.h>

#include <cmath>

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
  EXPECT_NEAR(deck.springs[0].terms[0].coefficient, 0.6, 1e-14);
  EXPECT_NEAR(deck.springs[0].terms[1].coefficient, 0.8, 1e-14);
}

TEST(NastranSpring, WithoutMeaningIsRefusedByLine) {
  EXPECT_THAT(refusal(kTet + "CELAS1,12,3,2,3\n"), HasSubstr("t.bdf:8: CELAS1: found no PELAS 3"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,-1.,2,3\n"), HasSubstr("t.bdf:8: CELAS2"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.,2,3,,,.05\n"), HasSubstr("damping of springs (GE)"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.,2,4\n"), HasSubstr("rotation of node 2 of solids"));
  EXPECT_THAT(refusal(kTet + "CELAS2,12,1.\n"), HasSubstr("t.bdf:8: CELAS2"));
  EXPECT_THAT(refusal(kTet + "GRID,9,,3.,4.,5.\nCELAS2,12,1.,9,4,2,1\n"),
              HasSubstr("rotation against a displacement"));
}

}  // namespace
}  // namespace clatter::test
