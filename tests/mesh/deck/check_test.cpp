// SPDX-License-Identifier: GPL-3.0-or-later
// All that a deck holds, as a table; the page of cards.
#include "mesh/deck/check.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "mesh/deck/cards_page.hpp"
#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/paths.hpp"
#include "tests/scratch.hpp"

namespace clatter::test {
namespace {

using mesh::deck::check_deck;
using mesh::deck::CheckedDeck;
using mesh::deck::CheckedRow;
using ::testing::HasSubstr;
using ::testing::Not;

CheckedDeck check(const std::string& name, const std::string& text,
                  const std::vector<std::string>& ignore = {}) {
  const auto path = scratch_path(name);
  std::ofstream(path) << text;
  CheckedDeck checked = check_deck(path, ignore);
  std::filesystem::remove(path);
  return checked;
}

CheckedRow row(const CheckedDeck& checked, const std::string& name) {
  for (const CheckedRow& one : checked.rows)
    if (one.name == name) return one;
  ADD_FAILURE() << "no row " << name;
  return {};
}

const std::string kCase = "SOL 101\nCEND\nTITLE = a\nSUBCASE 1\nSPC = 1\nLOAD = 2\nBEGIN BULK\n";
const std::string kLoads = "SPC1,1,123,1,2,3\nFORCE,2,4,0,1.,0.,0.,1.\n";

TEST(Check, AReadDeckIsListedByNameWithCountLineAndMeaning) {
  const CheckedDeck checked = check(
      "c.bdf", kCase + kTet + kLoads + "PLOTEL,1,1,2\nPLOTEL,2,2,3\nPARAM,POST,-1\nENDDATA\n");
  EXPECT_EQ(checked.refused, 0);
  EXPECT_THAT(checked.summary, HasSubstr("nodes: 4, cells: 1, regions: 1, steps: 1"));
  EXPECT_EQ(row(checked, "GRID").count, 4);
  EXPECT_EQ(row(checked, "GRID").fate, "read");
  EXPECT_THAT(row(checked, "GRID").where, HasSubstr("c.bdf:10"));
  EXPECT_EQ(row(checked, "PLOTEL").count, 2);
  EXPECT_EQ(row(checked, "PLOTEL").fate, "passed over");
  EXPECT_EQ(row(checked, "PLOTEL").remark, "of output and plots");
  EXPECT_EQ(row(checked, "POST").fate, "passed over");
  EXPECT_EQ(row(checked, "SOL").kind, "executive");
  EXPECT_EQ(row(checked, "TITLE").fate, "passed over");
  EXPECT_EQ(row(checked, "SUBCASE").fate, "read");
}

TEST(Check, ARefusedCardHasItsLineAndWhatToWriteInstead) {
  const std::string text =
      kCase + kTet + kLoads + "CBEND,7,1,1,2\nCBEND,8,1,2,3\nCQUAD4,9,1,1,2,3,4\n";
  const CheckedDeck checked = check("c.bdf", text + "SPC1,1,129,1\nENDDATA\n", {"CQUAD4"});
  EXPECT_EQ(checked.refused, 2);
  EXPECT_EQ(checked.summary, "");
  EXPECT_EQ(row(checked, "CBEND").count, 2);
  EXPECT_EQ(row(checked, "CBEND").fate, "refused");
  EXPECT_THAT(row(checked, "CBEND").where, HasSubstr("c.bdf:17"));
  EXPECT_THAT(row(checked, "CBEND").remark, HasSubstr("no curved bars; ignore = [\"CBEND\"]"));
  EXPECT_EQ(row(checked, "CQUAD4").fate, "ignored");
  const CheckedRow& last = checked.rows.back();  // the field of one of several SPC1
  EXPECT_EQ(last.fate, "refused");
  EXPECT_THAT(last.where, HasSubstr("c.bdf:20"));
  EXPECT_THAT(last.where, Not(HasSubstr("/")));  // in the folder of the deck
  EXPECT_THAT(last.remark, HasSubstr("SPC1"));
  EXPECT_EQ(row(checked, "SPC1").count, 2);
}

TEST(Check, AllRefusalsAreListedNotTheFirstTen) {
  std::string text = kTet;
  for (int k = 0; k < 25; ++k) text += "ABC" + std::string(1, static_cast<char>('A' + k)) + ",1\n";
  EXPECT_EQ(check("c.bdf", text).refused, 25);
  EXPECT_THAT(refusal(text), HasSubstr("the first 10 refusals"));
}

TEST(Check, WhatTheReaderSaysOfTheDeckIsARow) {
  const CheckedDeck checked = check("c.bdf", kTet + "GRID,77,,9.,9.,9.\n");
  const CheckedRow unused = row(checked, "GRID (of no solid and no coupling)");
  EXPECT_EQ(unused.count, 1);
  EXPECT_EQ(unused.fate, "left out");
  const CheckedRow& note = checked.rows.end()[-2];  // then the lumped mass
  EXPECT_EQ(note.fate, "noted");
  EXPECT_THAT(note.where, HasSubstr("c.bdf:8"));
  EXPECT_THAT(note.remark, HasSubstr("without ENDDATA"));
}

TEST(Check, LeftHandedCellsAreRenumbered) {
  std::string text = kTet;
  text.replace(text.find("CTETRA,1,1,1,2,3"), 16, "CTETRA,1,1,1,3,2");
  const CheckedDeck checked = check("c.bdf", text + "ENDDATA\n");
  const auto found = std::find_if(checked.rows.begin(), checked.rows.end(),
                                  [](const auto& one) { return one.fate == "renumbered"; });
  ASSERT_NE(found, checked.rows.end());
  EXPECT_EQ(found->remark, "1 of 1 cells are left-handed: their nodes are renumbered");
}

TEST(Check, RenumberedCellsAreCounted) {
  const std::string two =
      "PSOLID,1,1\nMAT1,1,210.,,.3\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\n"
      "GRID,4,,0.,0.,1.\nGRID,5,,1.,1.,1.\nCTETRA,1,1,1,3,2,4\nCTETRA,2,1,3,2,4,5\nENDDATA\n";
  const CheckedDeck checked = check("c.bdf", two);
  const auto found = std::find_if(checked.rows.begin(), checked.rows.end(),
                                  [](const auto& one) { return one.fate == "renumbered"; });
  ASSERT_NE(found, checked.rows.end());
  EXPECT_EQ(found->count, 2);
}

TEST(Check, AFoldedCellIsRefusedAsInReading) {
  const std::string text =
      "PSOLID,1,1\nMAT1,1,210.,,.3\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\n"
      "GRID,3,,0.,1.,0.\nGRID,4,,1.,1.,0.\nCTETRA,1,1,1,2,3,4\nENDDATA\n";
  const CheckedDeck checked = check("c.bdf", text);
  EXPECT_EQ(checked.refused, 1);
  EXPECT_THAT(checked.rows.back().remark, HasSubstr("det J"));
}

TEST(Check, KeywordsAndElementTypesOfAnAbaqusDeckAreListed) {
  const std::string cube =
      "*HEADING\na\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
      "*ELEMENT,TYPE=C3D8,ELSET=E\n1,1,2,3,4,5,6,7,8\n*ELEMENT,TYPE=CONN2D2\n2,1,2\n3,5,6\n"
      "*MATERIAL,NAME=M\n*ELASTIC\n1.,.3\n*SOLID SECTION,ELSET=E,MATERIAL=M\n"
      "*GASKET SECTION,ELSET=S\n1.\n*STEP\n*STATIC\n*BOUNDARY\n1,1,3\n*END STEP\n"
      "*STEP\n*DYNAMIC\n*CLOAD\n1,1,1.\n*END STEP\n";
  const CheckedDeck refused = check("c.inp", cube);
  EXPECT_EQ(refused.refused, 2);
  EXPECT_EQ(row(refused, "C3D8").fate, "read");
  EXPECT_EQ(row(refused, "CONN2D2").count, 2);
  EXPECT_THAT(row(refused, "CONN2D2").remark, HasSubstr("ignore = [\"CONN2D2\"]"));
  EXPECT_THAT(row(refused, "*GASKET SECTION").remark, HasSubstr("its stiffness: [[spring]]"));
  EXPECT_EQ(row(refused, "*HEADING").fate, "passed over");

  const CheckedDeck read = check("c.inp", cube, {"CONN2D2", "*GASKET SECTION"});
  EXPECT_EQ(read.refused, 0) << read.rows.back().remark;
  EXPECT_EQ(row(read, "CONN2D2").fate, "ignored");
  EXPECT_EQ(row(read, "*STEP").count, 2);
  EXPECT_EQ(row(read, "*DYNAMIC").fate, "passed over");  // the step is left out, which a note says
  EXPECT_EQ(read.rows.back().fate, "noted");
}

TEST(CardsPage, TheDocumentIsWhatTheReadersTablesSay) {
  std::ifstream file(CLATTER_SOURCE_DIR "/docs/cards.md");
  std::string written(std::istreambuf_iterator<char>(file), {}), now;
  for (const std::string& line : mesh::deck::cards_page()) now += line + "\n";
  EXPECT_EQ(written, now) << "run: build/release/bin/clatter-mesh cards > docs/cards.md";
}

}  // namespace
}  // namespace clatter::test
