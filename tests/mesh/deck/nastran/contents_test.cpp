// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of decks that are passed over, kept as surfaces, left out or chosen: what is said of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh/deck/nastran/cards.hpp"
#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::deck::Deck;
using mesh::deck::MassForm;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

const std::string kEnd = "ENDDATA\n";

TEST(NastranPassed, ADynamicDeckIsReadWithoutAnyIgnoreAndSaysWhatIsPassedOver) {
  const Deck deck = read_deck(
      "SOL 111\nCEND\nSPC = 1\nMETHOD = 1\nFREQ = 40\nDLOAD = 10\nSDAMPING = 20\nBEGIN BULK\n" +
      kTet +
      "SPC1,1,123,1,2,3\nEIGRL,1,,,8\nFREQ1,40,5.,.5,70\nFREQ1,40,6.,.5,70\nRLOAD2,10,11,,,12\n"
      "TABLED1,12,,,,,,,,+\n+,5.,1.,40.,1.,ENDT\nDAREA,11,4,1,1.\nTABDMP1,20,CRIT,,,,,,,+\n"
      "+,5.,.01,ENDT\nPVISC,3,25.\nCVISC,1,3,1,2\nMDLPRM,HDF5,0\nDRESP1,1,W,WEIGHT\n" +
      kEnd);
  EXPECT_THAT(deck.notes, IsEmpty());
  for (const char* part : {"passed over, since neither stiffness nor mass depends on it: ",
                           "FREQ1 (2)", "RLOAD2", "TABDMP1", "dampers: PVISC, CVISC",
                           "of an optimisation: DRESP1", "case control: FREQ, DLOAD, SDAMPING"})
    EXPECT_THAT(deck.passed, HasSubstr(part));
}

TEST(NastranPassed, NonlinearSolutionsAndInertiaReliefAreSaid) {
  const auto notes = [](const std::string& sol, const std::string& more) {
    return read_deck("SOL " + sol + "\nCEND\nBEGIN BULK\n" + kTet + more + kEnd).notes;
  };
  EXPECT_THAT(notes("106", ""), ElementsAre(HasSubstr("SOL 106 is nonlinear")));
  EXPECT_THAT(notes("101", "PARAM,INREL,-1\n"), ElementsAre(HasSubstr("PARAM INREL")));
  EXPECT_THAT(notes("103", ""), IsEmpty());
}

TEST(NastranMass, IsLumpedUnlessCoupmassIsPositive) {
  EXPECT_EQ(read_deck(kTet).mass, MassForm::kLumped);
  EXPECT_EQ(read_deck(kTet + "PARAM,COUPMASS,-1\n").mass, MassForm::kLumped);
  EXPECT_EQ(read_deck(kTet + "PARAM,COUPMASS,1\n").mass, MassForm::kConsistent);
  EXPECT_EQ(read_deck("CEND\nPARAM,COUPMASS,1\nBEGIN BULK\n" + kTet).mass, MassForm::kConsistent);
  // A mesh without properties or materials is no analysis.
  EXPECT_EQ(read_deck("PSOLID,1,1\n" + kTet.substr(kTet.find("GRID,1"))).mass,
            MassForm::kConsistent);
  EXPECT_EQ(read_deck(kTet.substr(kTet.find("GRID,1"))).mass, MassForm::kConsistent);
}

TEST(NastranSections, TheOneWithSolidsIsRead) {
  const std::string residual = "GRID,900,,0.,0.,9.\nCONM2,1,900,,5.\n";
  const Deck deck =
      read_deck("SOL 103\nCEND\nBEGIN BULK\n" + residual + "BEGIN SUPER=1\n" + kTet + kEnd);
  EXPECT_EQ(deck.mesh.cell_count(), 1);
  EXPECT_THAT(deck.masses, IsEmpty());
  EXPECT_THAT(deck.notes,
              ElementsAre(HasSubstr("BEGIN BULK has no solids: its 2 cards (1 masses")));
}

TEST(NastranSections, SeveralWithSolidsAreRefusedAndOneCanBeChosen) {
  std::string other = kTet;
  other.replace(other.find("GRID,4,,0.,0.,1."), 16, "GRID,4,,0.,0.,2.");
  const std::string deck = "CEND\nBEGIN BULK\n" + kTet + "BEGIN SUPER=1\n" + other + kEnd;
  EXPECT_THAT(
      refusal(deck),
      HasSubstr("t.bdf:10: found solids here and in BEGIN BULK, expected one part; ignore = "
                "[\"BEGIN SUPER=1\"] reads the first, ignore = [\"BEGIN BULK\"]"));
  EXPECT_EQ(read_deck(deck, {"BEGIN SUPER=1"}).mesh.nodes(3, 2), 1.0);
  EXPECT_EQ(read_deck(deck, {"BEGIN BULK"}).mesh.nodes(3, 2), 2.0);
}

TEST(NastranSections, ASuperelementThatIsWrittenOutIsAPart) {
  const Deck deck = read_deck(
      "SOL 103\nCEND\nMETHOD = 1\nEXTSEOUT(ASMBULK,EXTID=10,DMIGPCH)\nBEGIN BULK\n" + kTet +
      "GRID,9,,3.,4.,5.\nRBE2,7,9,123456,1,2,3\nASET1,123456,9\nSPOINT,1001,THRU,1008\n"
      "QSET1,0,1001,THRU,1008\nSUPORT,9,123456\nOMIT1,3,4\nEIGRL,1,,,8\n" +
      kEnd);
  ASSERT_THAT(deck.retained, SizeIs(1));
  EXPECT_THAT(deck.retained[0].node_indices, ElementsAre(4));
  EXPECT_THAT(deck.points, SizeIs(1));
  EXPECT_THAT(deck.notes, IsEmpty());
  for (const char* part : {"QSET1", "SUPORT", "OMIT1", "EXTSEOUT"})
    EXPECT_THAT(deck.passed, HasSubstr(part));
  EXPECT_EQ(deck.ignored.at("SPOINT (of no spring, mass or equation)"), 8);
}

TEST(NastranSkins, OnFacesOfSolidsAreSurfaces) {
  const std::string skins = "CTRIA3,21,9,1,2,4\nCTRIA3,22,9,1,3,2\n";
  const Deck bare = read_deck(kTet + skins + kEnd);
  EXPECT_EQ(bare.mesh.surfaces.at("pid_9").face_count(), 2);
  EXPECT_THAT(bare.notes, ElementsAre("t.bdf:8: 2 CTRIA3: faces of solids, now the surface pid_9"));
  const Deck stiff = read_deck(kTet + skins + "PSHELL,9,1,.25\n" + kEnd);
  EXPECT_THAT(stiff.notes, Contains(HasSubstr("PSHELL 9 gives stiffness to faces of solids, 0.25 "
                                              "thick")));
  // Ignored ones are surfaces, too.
  EXPECT_EQ(read_deck(kTet + skins, {"CTRIA3"}).mesh.surfaces.at("pid_9").face_count(), 2);
}

TEST(NastranLoose, WhatHangsOnIgnoredCellsIsNamedTogetherAndDroppedTogether) {
  const std::string shell =
      "GRID,11,,5.,0.,0.\nGRID,12,,6.,0.,0.\nGRID,13,,6.,1.,0.\nGRID,14,,5.,1.,0.\n"
      "CQUAD4,31,8,11,12,13,14\nGRID,20,,5.,0.,1.\nRBE2,41,20,123456,11,12\nCONM2,42,20,,2.5\n"
      "CONM2,43,13,,1.5\nFORCE,3,14,,1.,0.,0.,1.\nFORCE,3,20,,1.,0.,0.,1.\nFORCE,3,4,,1.,0.,0.,1.\n"
      "CELAS2,44,5.,14,1,13,1\n";
  const std::string said = refusal(kTet + shell, {"CQUAD4"});
  EXPECT_THAT(
      said, HasSubstr("found what hangs on grids of ignored cells alone: 2 masses (4 in the deck's "
                      "unit), 1 rigid elements, 1 springs, 2 forces; ignore = [\"LOOSE GRIDS\"]"));
  const Deck deck = read_deck(kTet + shell, {"CQUAD4", "LOOSE GRIDS"});
  EXPECT_THAT(deck.masses, IsEmpty());
  EXPECT_THAT(deck.rigid, IsEmpty());
  EXPECT_THAT(deck.springs, IsEmpty());
  EXPECT_THAT(deck.steps.at(0).forces, SizeIs(1));
  EXPECT_THAT(deck.points, testing::Each(testing::Field(&mesh::deck::Point::left_out, true)));
}

TEST(NastranLoose, WhatHangsOnSolidsTooStays) {
  const std::string deck = kTet +
                           "GRID,11,,5.,0.,0.\nGRID,12,,6.,0.,0.\nGRID,13,,6.,1.,0.\n"
                           "CTRIA3,31,8,11,12,13\nGRID,20,,5.,0.,1.\nCONM2,42,20,,2.5\n"
                           "RBE3,41,,20,123456,1.,123,1,2,+\n+,3,11,12\n" +
                           kEnd;
  const Deck found = read_deck(deck, {"CTRIA3"});
  EXPECT_THAT(found.masses, SizeIs(1));
  EXPECT_THAT(found.distributing.at(0).terms.at(0).node_indices, ElementsAre(0, 1, 2));
  EXPECT_THAT(found.notes, Contains(HasSubstr("2 grids of ignored cells are left out of RBE3")));
  EXPECT_FALSE(found.points.at(0).left_out);
}

TEST(NastranGlue, ThatCaseControlChoosesIsATie) {
  // Two tetrahedra whose faces x = 0 lie on each other.
  const std::string deck =
      kTet +
      "GRID,5,,-1.,0.,0.\nGRID,6,,0.,0.,0.\nGRID,7,,0.,1.,0.\nGRID,8,,0.,0.,1.\n"
      "CTETRA,2,1,5,7,6,8\n"
      "BSURFS,10,,,,1,1,3,4\nBSURFS,11,,,,2,6,7,8\nBGSET,5,10,11,.01\n";
  EXPECT_THAT(read_deck("CEND\nECHO=NONE\nBEGIN BULK\n" + deck).ties, IsEmpty());
  const Deck found = read_deck("CEND\nBGSET = 5\nBEGIN BULK\n" + deck);
  ASSERT_THAT(found.ties, SizeIs(1));
  EXPECT_EQ(found.ties[0].slave, "bsurfs_10");
  EXPECT_EQ(found.ties[0].master, "bsurfs_11");
  EXPECT_EQ(found.ties[0].distance, 0.01);
  EXPECT_EQ(found.mesh.surfaces.at("bsurfs_10").face_count(), 1);
  EXPECT_THAT(refusal("CEND\nBGSET = 6\nBEGIN BULK\n" + deck),
              HasSubstr("BGSET = 6: found no such set"));
  EXPECT_THAT(
      refusal(kTet + "BCTSET,5,10,11,.1\n"),
      HasSubstr("contact that opens is not linear; ignore = [\"BCTSET\"] leaves both sides"));
}

TEST(NastranCards, RefusedOnesSayWhatReplacesThem) {
  // Advice to ignore never takes stiffness or mass away without saying so.
  for (const auto& card : mesh::deck::nastran::listed_cards()) {
    if (card.fate != mesh::deck::Fate::kRefused) continue;
    EXPECT_THAT(card.remark, HasSubstr("ignore = [\"" + card.name + "\"]"));
    EXPECT_THAT(card.remark,
                testing::AnyOf(HasSubstr("drops"), HasSubstr("leaves"), HasSubstr("displacement")))
        << card.name;
  }
  EXPECT_THAT(
      refusal(kTet + "CBEND,8,1,1,2\nCBEND,9,1,1,2\n"),
      HasSubstr("card CBEND (2 times) is not supported: no curved bars; ignore = [\"CBEND\"] drops "
                "their stiffness and mass"));
  EXPECT_THAT(refusal(kTet + "FOO,1\n"), HasSubstr("skips it, with all that it adds to the model"));
}

TEST(NastranOptiStruct, LinesBeforeTheCaseControlArePassedOver) {
  const Deck deck =
      read_deck("FORMAT HM\nSCREEN OUT\nDESGLB = 2\nSUBCASE 1\n  SPC = 1\nBEGIN BULK\n" + kTet +
                "SPC1,1,123,1,2,3\n" + kEnd);
  EXPECT_THAT(deck.supports, SizeIs(1));
}

TEST(NastranLines, ContinuationsWithABlankInTheirFirstColumnJoin) {
  std::string deck = kTet.substr(0, kTet.find("CTETRA"));
  const std::string head = "CTETRA         1       1       1       2       3       4";
  deck += head + std::string(72 - head.size(), ' ') + " +00000P\n+00000P\n" + kEnd;
  EXPECT_EQ(read_deck(deck).mesh.cell_count(), 1);
}

TEST(NastranFluids, AreLeftOutOrRefusedWithTheirCells) {
  const std::string fluid =
      "GRID,11,,5.,0.,0.,-1\nGRID,12,,6.,0.,0.,-1\nGRID,13,,5.,1.,0.,-1\nGRID,14,,5.,0.,1.,-1\n"
      "CTETRA,11,2,11,12,13,14\nPSOLID,2,7,,,,,PFLUID\nMAT10,7,1.,1.2\nACMODL\n";
  EXPECT_THAT(refusal(kTet + fluid),
              HasSubstr("t.bdf:13: PSOLID 2: 1 cells of a fluid (FCTN or MAT10), expected solids; "
                        "ignore = [\"PFLUID\"] leaves them out: a [[point_mass]]"));
  const Deck deck = read_deck(kTet + fluid + kEnd, {"PFLUID"});
  EXPECT_EQ(deck.mesh.cell_count(), 1);
  EXPECT_EQ(deck.ignored.at("PFLUID"), 1);
  std::string plain = fluid;  // MAT10 alone says that it is a fluid
  plain.replace(plain.find(",,,,,PFLUID"), 11, "");
  EXPECT_THAT(refusal(kTet + plain), HasSubstr("1 cells of a fluid"));
}

TEST(NastranCards, AFieldWithPartsOfTwoIsAMisalignedLine) {
  // Seven blanks after THREE, as in a deck whose fields begin in column 34.
  const std::string line = "PSOLID  1       1       0       0   THREE    GRID    FULL   SMECH\n";
  std::string deck = kTet;
  deck.replace(0, deck.find('\n') + 1, line);
  EXPECT_THAT(refusal(deck),
              HasSubstr("t.bdf:1: PSOLID: IN: found '0   THRE', parts of two fields: "
                        "align the fields of this line in columns of 8"));
}

TEST(NastranParameters, RayleighDampingIsOfferedToTheRecipe) {
  const Deck deck = read_deck(kTet + "PARAM,ALPHA1,3.\nPARAM,ALPHA2,1.-5\n");
  ASSERT_THAT(deck.damping, SizeIs(1));
  EXPECT_EQ(deck.damping[0].mass, 3.0);
  EXPECT_EQ(deck.damping[0].stiffness, 1e-5);
}

// An external superelement as decks write it: everything is read, passed over or refused by name.
TEST(NastranSections, OfAnExternalSuperelementAllIsUsedOrSaid) {
  const std::string residual =
      "SEBULK,1,EXTERNAL,,MANUAL\nSECONCT,1,0,,NO,,,,,+\n+,9,9\nGRID,9,,3.,4.,5.\nCONM2,5,9,,2.\n"
      "CELAS2,6,100.,9,1\n";
  const std::string part = "BEGIN SUPER=1\n" + kTet +
                           "GRID,9,,3.,4.,5.\nRBE2,7,9,123456,1,2,3\nASET1,123456,9\nCSET1,3,4\n"
                           "SPOINT,1001,THRU,1004\nQSET1,0,1001,THRU,1004\nSESET,1,1,THRU,4\n";
  const std::string head =
      "SOL 103\nCEND\nMETHOD = 1\nSUPER = ALL\nSEALL = ALL\nEXTSEOUT(STIFFNESS,MASS,"
      "DAMPING,ASMBULK,EXTID=1,DMIGPCH)\nRSMETHOD = 1\nBEGIN BULK\nEIGRL,1,,,4\n";
  const std::string deck = head + residual + part + kEnd;
  // What joins parts in Nastran is no part of this one: refused by name, each with its way out.
  const std::string said = refusal(deck);
  for (const char* card : {"SEBULK", "SECONCT", "SESET"})
    EXPECT_THAT(said, HasSubstr(std::string("card ") + card +
                                " is not supported: parts of other files are not assembled here; "
                                "ignore = [\"" +
                                card + "\"] leaves them out: a scene joins parts"));
  const Deck found = read_deck(deck, {"SEBULK", "SECONCT", "SESET"});
  ASSERT_THAT(found.retained, SizeIs(2));
  EXPECT_EQ(found.retained[0].dofs, 0b000100);
  EXPECT_THAT(found.retained[0].node_indices, ElementsAre(3));
  EXPECT_THAT(found.retained[1].node_indices, ElementsAre(4));
  EXPECT_THAT(found.rigid, SizeIs(1));
  EXPECT_THAT(found.masses, IsEmpty());  // of the residual structure, which is said
  EXPECT_THAT(found.notes, Contains(testing::AllOf(
                               HasSubstr("BEGIN BULK has no solids"),
                               HasSubstr("(1 masses, 1 springs, 0 couplings) are left out"))));
  // METHOD is that of BEGIN BULK, and so is what the supports of a load case would be.
  EXPECT_EQ(found.steps.at(0).modes, 4);
  EXPECT_THAT(found.passed, HasSubstr("QSET1"));
  for (const char* command : {"EXTSEOUT", "SUPER", "SEALL", "RSMETHOD"})
    EXPECT_THAT(found.passed, HasSubstr(command));
  EXPECT_EQ(found.ignored.at("SPOINT (of no spring, mass or equation)"), 4);
  EXPECT_EQ(found.ignored.at("SECONCT"), 1);
}

// Case control selects sets for all sections; those of sections that are left out select nothing.
TEST(NastranSections, SetsOfOtherSectionsAreSaidAndLeftOut) {
  const std::string deck =
      "SOL 101\nCEND\nSPC = 1\nLOAD = 2\nBEGIN BULK\nGRID,900,,0.,0.,9.\nSPC1,1,123456,900\n"
      "FORCE,2,900,,1.,0.,0.,1.\nBEGIN SUPER=1\n" +
      kTet + kEnd;
  const Deck found = read_deck(deck);
  EXPECT_THAT(found.supports, IsEmpty());
  EXPECT_THAT(found.steps.at(0).forces, IsEmpty());
  EXPECT_THAT(found.notes, Contains(HasSubstr("SPC = 1 is a set of BEGIN BULK: left out")));
  EXPECT_THAT(found.notes, Contains(HasSubstr("LOAD = 2 is a set of BEGIN BULK: left out")));
  std::string missing = deck;
  missing.replace(missing.find("SPC = 1"), 7, "SPC = 8");
  EXPECT_THAT(refusal(missing), HasSubstr("8"));  // no section has it
}

// Scalar points are numbered with the grids: new nodes of an export begin above both.
TEST(NastranSections, TheLargestNumberIsThatOfAScalarPointToo) {
  EXPECT_EQ(read_deck(kTet + "SPOINT,7001\nCELAS4,1,7.5,7001\n").mesh.deck.largest_node, 7001);
  EXPECT_EQ(read_deck(kTet + "SPOINT,5,THRU,812\nQSET1,0,5,THRU,812\n").mesh.deck.largest_node,
            812);
  EXPECT_EQ(read_deck(kTet).mesh.deck.largest_node, 4);
}

}  // namespace
}  // namespace clatter::test
