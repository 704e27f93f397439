// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::deck::Deck;
using mesh::deck::kAllDofs;
using mesh::deck::Step;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

const std::string kSpcs = "SPC1,1,3,1\nSPC1,2,12,2,3\nSPCADD,9,1,2\n";

TEST(NastranControl, BulkDataAloneIsRead) {
  EXPECT_EQ(read_deck(kTet).mesh.cell_count(), 1);
  EXPECT_EQ(read_deck("BEGIN BULK\n" + kTet + "ENDDATA\n").mesh.cell_count(), 1);
  EXPECT_EQ(read_deck("$ comment\n\nCEND\nBEGIN BULK\n" + kTet).mesh.cell_count(), 1);
}

TEST(NastranControl, ExecutiveAndCaseControlAreReadInAnyCase) {
  const Deck deck = read_deck(
      "assign output2='a.op2',unit=12\n"
      "id a,b\nsol 103 $ modes\ntime 600\ncend\n"
      "title = BEGIN BULK, not yet,\n"
      "echo = none\nspc = 9\n"
      "set 80 = 1 thru 5,\n 7,8,\n 9\n"
      "disp(plot,real) = all\nstress(corner)=80\n"
      "subcase 3\n  label = third\n  method = 4\n"
      "begin bulk\n" +
      kTet + kSpcs + "EIGRL,4,,,25\n");
  ASSERT_THAT(deck.steps, SizeIs(1));
  EXPECT_EQ(deck.steps[0].name, "subcase_3");
  EXPECT_EQ(deck.steps[0].where, "t.bdf:14");
  EXPECT_EQ(deck.steps[0].kind, Step::Kind::kFrequency);
  EXPECT_EQ(deck.steps[0].modes, 25);
  EXPECT_THAT(deck.supports, SizeIs(2));  // two sets of directions
}

TEST(NastranControl, SubcasesInheritWhatIsAboveThemAndSetTheRest) {
  const Deck deck =
      read_deck("SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 5\nSUBCASE 2\nSPC = 2\nBEGIN BULK\n" +
                kTet + kSpcs + "FORCE,5,4,,2.,0.,0.,1.\n");
  ASSERT_THAT(deck.steps, SizeIs(2));
  EXPECT_TRUE(deck.supports.empty());  // they differ: each step has its own
  ASSERT_THAT(deck.steps[0].supports, SizeIs(1));
  EXPECT_EQ(deck.steps[0].supports[0].dofs, 0b100);
  EXPECT_EQ(deck.steps[1].supports[0].dofs, 0b011);
  EXPECT_THAT(deck.steps[0].forces, SizeIs(1));
  EXPECT_TRUE(deck.steps[1].forces.empty());
}

TEST(NastranControl, ACaseControlWithoutSpcHoldsNothing) {
  EXPECT_TRUE(read_deck("SOL 103\nCEND\nECHO=NONE\nBEGIN BULK\n" + kTet + kSpcs).supports.empty());
}

TEST(NastranControl, CaseControlMayBeginWithoutCend) {
  const Deck deck =
      read_deck("SOL 101\nSET 1 = 2\nSUBCASE 1\n SPC = 1\nBEGIN BULK\n" + kTet + kSpcs);
  EXPECT_EQ(deck.steps.size(), 1u);
  EXPECT_FALSE(deck.steps.at(0).supports.empty() && deck.supports.empty());
}

TEST(NastranControl, WithoutCaseControlSeveralSetsAreNamed) {
  EXPECT_EQ(read_deck(kTet + kSpcs).supports.size(), 2u);  // SPCADD 9 is the one on top
  EXPECT_THAT(refusal(kTet + "SPC1,1,3,1\nSPC1,2,12,2,3\n"),
              StartsWith("t.bdf: found 2 SPC sets (1, 2), expected SPC = n in a case control"));
  EXPECT_THAT(refusal("CEND\nSPC = 3\nBEGIN BULK\n" + kTet + kSpcs),
              HasSubstr("SPC = 3: found no such set"));
  const std::string sum = "CEND\nSPC = 7\nBEGIN BULK\n" + kTet + "SPCADD,7,1,2\n";
  EXPECT_THAT(refusal(sum), HasSubstr("SPCADD 7: found no SPC set 1"));
  EXPECT_THAT(read_deck(sum + "SPC1,1,3,1\nENDDATA\n").notes,
              testing::ElementsAre(HasSubstr("SPCADD 7: found no SPC set 2: it is left out")));
}

TEST(NastranControl, UnknownCommandsAreNamedAndCanBeIgnored) {
  const std::string deck = "SOL 101\nCEND\nADACT = 100\nBEGIN BULK\n" + kTet;
  EXPECT_EQ(
      refusal(deck),
      "t.bdf:3: case control command 'ADACT' is not supported; ignore = [\"ADACT\"] skips it");
  EXPECT_EQ(read_deck(deck, {"adact"}).ignored.at("ADACT"), 1);
  EXPECT_THAT(refusal("SOL 101\nCOMPILE X\nCEND\nBEGIN BULK\n" + kTet),
              HasSubstr("executive statement 'COMPILE' is not supported"));
  EXPECT_THAT(refusal("SOL 101\nCEND\n"), HasSubstr("expected BEGIN BULK"));
  EXPECT_THAT(refusal("SOL 101\nCEND\nSPC = ALL\nBEGIN BULK\n" + kTet),
              HasSubstr("SPC: found 'ALL', expected the number of a set"));
}

TEST(NastranControl, PlotCommandsPass) {
  EXPECT_EQ(
      read_deck("CEND\nSPC = 9\nOUTPUT(XYPLOT)\nXYPRINT DISP / 5(T3)\nBEGIN BULK\n" + kTet + kSpcs)
          .supports.size(),
      2u);
}

TEST(NastranControl, WtmassScalesDensitiesAndMasses) {
  const std::string rest = kTet + "CONM2,5,1,,4.,,,,,+\n+,2.\n";
  for (const std::string& deck :
       {rest + "PARAM,WTMASS,.5\n", "CEND\nPARAM,WTMASS,.5\nBEGIN BULK\n" + rest,
        rest + "PARAM   WTMASS  .5\n"}) {
    const Deck found = read_deck(deck);
    EXPECT_EQ(found.materials.at("mat_1").density, 3.9);
    EXPECT_EQ(found.masses[0].mass, 2.0);
    EXPECT_EQ(found.masses[0].inertia(0, 0), 1.0);
  }
  EXPECT_THAT(refusal(kTet + "PARAM,WTMASS,0.\n"), HasSubstr("expected a positive number"));
}

}  // namespace
}  // namespace clatter::test
