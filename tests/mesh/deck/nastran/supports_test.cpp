// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::deck::Deck;
using mesh::deck::kAllDofs;
using mesh::deck::kTranslations;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kPoint = "GRID,9,,3.,4.,5.\nRBE2,7,9,123456,1\n";

TEST(NastranSupports, Spc1ListsAndRanges) {
  const Deck deck = read_deck(kTet + "SPC1,5,123,1,2,4\n");
  ASSERT_THAT(deck.supports, SizeIs(1));
  EXPECT_EQ(deck.supports[0].name, "spc_5");
  EXPECT_EQ(deck.supports[0].where, "t.bdf:8");
  EXPECT_EQ(deck.supports[0].dofs, kTranslations);
  EXPECT_THAT(deck.supports[0].node_indices, ElementsAre(0, 1, 3));
  // Numbers that a THRU spans need not exist; listed ones must.
  EXPECT_THAT(read_deck(kTet + "SPC1,5,2,2,THRU,2000000000\n").supports[0].node_indices,
              ElementsAre(1, 2, 3));
  EXPECT_THAT(read_deck(kTet + "SPC1,5,2,1,THRU,4,BY,3\n").supports[0].node_indices,
              ElementsAre(0, 3));
  EXPECT_THAT(refusal(kTet + "SPC1,5,2,1,30\n"), HasSubstr("t.bdf:8: found no GRID 30"));
  EXPECT_THAT(refusal(kTet + "SPC1,5,2,4,THRU,1\n"), HasSubstr("found 4 THRU 1"));
  EXPECT_THAT(refusal(kTet + "SPC1,5,2,THRU,4\n"), HasSubstr("found 'THRU', expected an integer"));
  EXPECT_THAT(refusal(kTet + "SPC1,5,,1\n"), HasSubstr("C: found nothing"));
}

TEST(NastranSupports, SpcHoldsAtAValue) {
  const Deck deck = read_deck(kTet + "SPC,5,1,12,,2,3,.25\n");
  ASSERT_THAT(deck.supports, SizeIs(2));
  EXPECT_EQ(deck.supports[0].value, 0.0);
  EXPECT_EQ(deck.supports[0].dofs, 0b011);
  EXPECT_EQ(deck.supports[1].value, 0.25);
  EXPECT_EQ(deck.supports[1].dofs, 0b100);
  EXPECT_THAT(deck.supports[1].node_indices, ElementsAre(1));
  EXPECT_THAT(refusal(kTet + "SPC,5,1,1,.5\nSPC,5,1,1,.25\n"), HasSubstr("found 0.25 and 0.5"));
}

TEST(NastranSupports, WhatSeveralCardsHoldIsMerged) {
  const Deck deck = read_deck(kTet + "SPC1,5,1,1,2\nSPC1,5,23,1,2\nSPC1,5,12,1\n");
  ASSERT_THAT(deck.supports, SizeIs(1));
  EXPECT_EQ(deck.supports[0].dofs, kTranslations);
  EXPECT_THAT(deck.supports[0].node_indices, ElementsAre(0, 1));
}

TEST(NastranSupports, SolidsHaveNoRotationsPointsHave) {
  const Deck deck = read_deck(kTet + kPoint + "SPC1,5,123456,2,9\n");
  ASSERT_THAT(deck.supports, SizeIs(2));
  EXPECT_EQ(deck.supports[0].dofs, kTranslations);
  EXPECT_THAT(deck.supports[0].node_indices, ElementsAre(1));
  EXPECT_EQ(deck.supports[1].dofs, kAllDofs);
  EXPECT_THAT(deck.supports[1].node_indices, ElementsAre(4));
  EXPECT_THAT(read_deck(kTet + "SPC1,5,456,1,THRU,4\n").supports, IsEmpty());
}

TEST(NastranSupports, DirectionsAreThoseOfEachGridsSystem) {
  std::string deck = kTet + "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  deck.replace(deck.find("GRID,2,,1.,0.,0."), 16, "GRID,2,,1.,0.,0.,5");
  const Deck found = read_deck(deck + "SPC1,5,13,1,2,3\n");
  ASSERT_THAT(found.supports, SizeIs(2));
  EXPECT_EQ(found.supports[0].system, "");
  EXPECT_THAT(found.supports[0].node_indices, ElementsAre(0, 2));
  EXPECT_EQ(found.supports[1].system, "cord_5");
  EXPECT_THAT(found.supports[1].node_indices, ElementsAre(1));
  EXPECT_EQ(found.supports[1].name, "spc_5_2");
  EXPECT_TRUE(found.systems.contains("cord_5"));
}

TEST(NastranSupports, PermanentConstraintsHoldWhateverTheCaseControlChooses) {
  std::string deck = kTet;
  deck.replace(deck.find("GRID,2,,1.,0.,0."), 16, "GRID,2,,1.,0.,0.,,23456");
  const Deck found = read_deck("CEND\nECHO=NONE\nBEGIN BULK\n" + deck + "SPC1,5,1,1\n");
  ASSERT_THAT(found.supports, SizeIs(1));
  EXPECT_EQ(found.supports[0].name, "ps");
  EXPECT_EQ(found.supports[0].dofs, 0b110);
}

TEST(NastranSupports, AsetAndBsetAreRetained) {
  const Deck deck =
      read_deck(kTet + kPoint + "ASET1,123456,9\nASET,1,3,2,3\nBSET1,3,3,THRU,4\nBSET,1,12\n");
  EXPECT_THAT(deck.supports, IsEmpty());
  ASSERT_THAT(deck.retained, SizeIs(3));  // by directions: 3, 123, all
  EXPECT_THAT(deck.retained[0].node_indices, ElementsAre(1, 2, 3));
  EXPECT_EQ(deck.retained[1].dofs, kTranslations);
  EXPECT_THAT(deck.retained[1].node_indices, ElementsAre(0));
  EXPECT_EQ(deck.retained[2].dofs, kAllDofs);
  EXPECT_THAT(deck.retained[2].node_indices, ElementsAre(4));
}

TEST(NastranSupports, RetainedGridsThatNothingUsesAreSaid) {
  const Deck deck = read_deck(kTet + "GRID,20\nGRID,21\nCSET1,123,1,20,21\nENDDATA\n");
  ASSERT_THAT(deck.retained, SizeIs(1));
  EXPECT_THAT(deck.retained[0].node_indices, ElementsAre(0));
  EXPECT_THAT(deck.notes, ElementsAre(HasSubstr("t.bdf:10: 2 retained grids")));
}

// A length and an angle have units of their own.
TEST(NastranSupports, AValueOfDisplacementsAndRotationsIsTwo) {
  const Deck deck = read_deck(kTet + kPoint + "SPC,5,9,15,.25\n");
  ASSERT_THAT(deck.supports, SizeIs(2));
  EXPECT_EQ(deck.supports[0].dofs, 0b000001);
  EXPECT_EQ(deck.supports[1].dofs, 0b010000);
  EXPECT_EQ(deck.supports[1].value, 0.25);
}

TEST(NastranSupports, ExceptLeavesNumbersOutOfARange) {
  const auto held = [](const std::string& list) {
    const auto supports = read_deck(kTet + "SPC1,5,1," + list + "\n").supports;
    return supports.empty() ? std::vector<int32_t>() : supports[0].node_indices;
  };
  EXPECT_THAT(held("1,THRU,4,EXCEPT,2"), ElementsAre(0, 2, 3));
  EXPECT_THAT(held("1,THRU,4,EXCEPT,1,2"), ElementsAre(2, 3));
  EXPECT_THAT(held("1,THRU,4,EXCEPT,2,THRU,+\n+,4"), ElementsAre(0));
  EXPECT_THAT(held("1,THRU,3,EXCEPT,3,4"), ElementsAre(0, 1, 3));  // 4 is beyond the range
  EXPECT_THAT(refusal(kTet + "SPC1,5,1,1,THRU,4,EXCEPT,3,2\n"), HasSubstr("expected ascending"));
}

TEST(NastranSets, Set1HoldsNodesAndPoints) {
  const Deck deck =
      read_deck(kTet + kPoint + "SET1,5,4,1,THRU,2\nSET1,6,9,3\nSET1,7,1,THRU,4,BY,2\n");
  EXPECT_THAT(deck.mesh.node_sets.at("set_5"), ElementsAre(0, 1, 3));
  EXPECT_FALSE(deck.sets.contains("set_5"));
  EXPECT_THAT(deck.mesh.node_sets.at("set_7"), ElementsAre(0, 2));
  EXPECT_THAT(deck.mesh.node_sets.at("set_6"), ElementsAre(2));
  EXPECT_THAT(deck.sets.at("set_6"), ElementsAre(2, 4));
}

TEST(NastranSets, WrongOnesAreRefused) {
  EXPECT_THAT(refusal(kTet + "SET1,5,40\n"), HasSubstr("t.bdf:8: found no GRID 40"));
  EXPECT_THAT(refusal(kTet + "SET1,5,SKIN\n"), HasSubstr("found 'SKIN'"));
  EXPECT_THAT(refusal(kTet + "SET1,5,1\nSET1,5,2\n"), HasSubstr("found a second set 5"));
}

}  // namespace
}  // namespace clatter::test
