// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::CellType;
using mesh::deck::Deck;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

// The same cell and nodes in every format.
struct Form {
  const char* name;
  const char* text;
};

class NastranForms : public testing::TestWithParam<Form> {};

TEST_P(NastranForms, GiveTheSameTenNodeTetrahedron) {
  const std::string nodes =
      "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.\n"
      "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\n"
      "GRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n";
  const Deck deck = read_deck(nodes + GetParam().text);
  ASSERT_EQ(deck.mesh.cells.size(), 1u);
  EXPECT_EQ(deck.mesh.cells[0].type, CellType::kTet10);
  EXPECT_EQ(deck.mesh.cells[0].ids, std::vector<int32_t>{77});
  // Ours has the mid-side node of 2-3 before that of 1-3 (cell.hpp).
  const std::vector<int32_t> expected = {0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
  const auto& found = deck.mesh.cells[0].nodes;
  EXPECT_EQ(std::vector<int32_t>(found.data(), found.data() + found.size()), expected);
}

INSTANTIATE_TEST_SUITE_P(
    All, NastranForms,
    testing::Values(
        Form{"small_named",
             "CTETRA  77      1       1       2       3       4       5       6       +ABC\n"
             "+ABC    7       8       9       10\n"},
        Form{"small_named_without_plus_on_the_card",
             "CTETRA  77      1       1       2       3       4       5       6       ABC\n"
             "+ABC    7       8       9       10\n"},
        Form{"small_plus",
             "CTETRA  77      1       1       2       3       4       5       6       +\n"
             "+       7       8       9       10\n"},
        Form{"small_blank",
             "CTETRA  77      1       1       2       3       4       5       6\n"
             "        7       8       9       10\n"},
        Form{"lower_case",
             "ctetra  77      1       1       2       3       4       5       6       +a\n"
             "+A      7       8       9       10\n"},
        Form{"tabs", "CTETRA\t77\t1\t1\t2\t3\t4\t5\t6\n\t7\t8\t9\t10\n"},
        Form{"comments_between",
             "CTETRA  77      1       1       2       3       4       5       6       $ first\n"
             "$ nothing\n\n        7       8       9       10 $ last\n"},
        Form{
            "beyond_column_80",
            "CTETRA  77      1       1       2       3       4       5       6       +A      "
            "12345\n"
            "+A      7       8       9       10                                              99\n"},
        Form{"large",
             "CTETRA* 77              1               1               2               *\n"
             "*       3               4               5               6               *\n"
             "*       7               8               9               10\n"},
        Form{"large_named",
             "CTETRA* 77              1               1               2               *A1\n"
             "*A1     3               4               5               6               *A2\n"
             "*A2     7               8               9               10\n"},
        Form{"large_then_small",
             "CTETRA* 77              1               1               2               *\n"
             "*       3               4               5               6               +\n"
             "+       7       8       9       10\n"},
        Form{"small_then_large",
             "CTETRA  77      1       1       2       3       4       5       6       *\n"
             "*       7               8               9               10\n"},
        Form{"free_named", "CTETRA,77,1,1,2,3,4,5,6,+Q1\n+Q1,7,8,9,10\n"},
        Form{"free_plus", "CTETRA,77,1,1,2,3,4,5,6,+\n+,7,8,9,10\n"},
        Form{"free_blank", "CTETRA,77,1,1,2,3,4,5,6\n,7,8,9,10\n"},
        Form{"free_blanks_and_tabs", "CTETRA , 77, 1 ,1,\t2, 3,4, 5,6\n  ,7, 8 ,9,10\n"},
        Form{"free_large", "CTETRA*,77,1,1,2\n*,3,4,5,6\n*,7,8,9,10\n"},
        Form{"free_two_lines_in_one", "CTETRA,77,1,1,2,3,4,5,6,+,7,8,9,10\n"},
        Form{"free_then_fixed", "CTETRA,77,1,1,2,3,4,5,6,+\n+       7       8       9       10\n"},
        Form{"out_of_order",
             "CTETRA  77      1       1       2       3       4       5       6       +ABC\n"
             "PARAM,POST,-1\n"
             "+ABC    7       8       9       10\n"},
        Form{"before_its_card",
             "+ABC    7       8       9       10\n"
             "CTETRA  77      1       1       2       3       4       5       6       +ABC\n"},
        Form{"names_with_a_mark_of_their_own",
             "CTETRA  77      1       1       2       3       4       5       6        +000001\n"
             "++0000017       8       9       10\n"},
        Form{"windows_line_ends",
             "CTETRA  77      1       1       2       3       4       5       6       +\r\n"
             "+       7       8       9       10\r\n"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(NastranFormat, ChainsOfContinuationsInAnyOrderAreJoined) {
  const Deck deck = read_deck(kTet +
                              "+B,3,4\n"
                              "SET1,5,1,,,,,,,+A\n"
                              "+A,2,,,,,,,,+B\n");
  EXPECT_THAT(deck.mesh.node_sets.at("set_5"), ElementsAre(0, 1, 2, 3));
}

TEST(NastranFormat, ACommentInTheLastColumnsIsNoContinuation) {
  const Deck deck = read_deck(
      "GRID           1             0.0     0.0     0.0                        grid_sat\n" +
      kTet.substr(kTet.find("GRID,2")) +
      "CONM2          5       1       0     20.                                CONM2_sa\n");
  EXPECT_EQ(deck.masses.size(), 1u);
  EXPECT_EQ(deck.mesh.nodes.rows(), 4);
}

TEST(NastranFormat, AContinuationWithoutACardIsNamed) {
  EXPECT_THAT(refusal(kTet + "+XY,1,2\n"), StartsWith("t.bdf:8: found continuation 'XY'"));
  EXPECT_THAT(refusal("+,1,2\n"), StartsWith("t.bdf:1: found a continuation line"));
  EXPECT_THAT(refusal(kTet + "SET1,5,1,,,,,,,+A\nPARAM,A,1\n+A,2\n+A,3\n"),
              StartsWith("t.bdf:11: found a second continuation named 'A'"));
  EXPECT_THAT(refusal(kTet + "SET1,5,1,,,,,,,+A\nSET1,6,1,,,,,,,+A\nPARAM,A,1\n+A,2\n"),
              HasSubstr("two that require it: t.bdf:8 and t.bdf:9"));
}

TEST(NastranFormat, HalfALargeLineBeforeASmallOneIsRefused) {
  EXPECT_THAT(refusal("CTETRA* 77              1               1               2\n"
                      "+       3       4\n"),
              HasSubstr("t.bdf:2: found a small-field continuation after the first half"));
}

TEST(NastranFormat, DataBeyondTheEighthFreeFieldIsNotDropped) {
  EXPECT_THAT(refusal(kTet + "SET1,5,1,2,3,4,1,2,3,4\n"),
              HasSubstr("t.bdf:8: found '4' as field 10"));
  EXPECT_THAT(refusal(kTet + "GRID,9,,0.,0.,0.,,,,+\n+,5.\n"), HasSubstr("after the last field"));
}

TEST(NastranFormat, EnddataEndsTheDeck) {
  EXPECT_EQ(read_deck(kTet + "ENDDATA 6a7d6a3b\nnonsense\n").mesh.cell_count(), 1);
  EXPECT_EQ(read_deck(kTet + "enddata").mesh.cell_count(), 1);
}

TEST(NastranFormat, RepetitionsCopyFieldsAndStepThem) {
  const std::string tail = "CTETRA,1,1,1,2,3,4\n";
  const Deck deck =
      read_deck("GRID,1,,0.,0.,0.\n=,2,=,*(1.),==\n=,*1,=,*(-1.),1.,=\n=,4,=,=,0.,1.\n" + tail);
  EXPECT_EQ(deck.mesh.nodes.row(1), Eigen::RowVector3d(1, 0, 0));
  EXPECT_EQ(deck.mesh.nodes.row(2), Eigen::RowVector3d(0, 1, 0));
  EXPECT_EQ(deck.mesh.nodes.row(3), Eigen::RowVector3d(0, 0, 1));
  // =3: three more GRIDs with the same steps.
  const Deck many = read_deck(kTet +
                              "GRID    11              0.      0.      5.\n"
                              "=       *1      =       *1.     ==\n=3\nSET1,7,11,THRU,15\n"
                              "CONM2,1,15,,2.\n");
  EXPECT_EQ(many.points.at(0).at, Eigen::Vector3d(4, 0, 5));
  EXPECT_THAT(refusal("BEGIN BULK\n=,1\n"),
              HasSubstr("expected a card in small or free fields before it"));
  EXPECT_THAT(refusal(kTet + "=4\n"), HasSubstr("found '=4', expected ="));
}

TEST(NastranFormat, UnknownCardsAreNamedAndCanBeIgnored) {
  const std::string deck = kTet + "CQUAD4,5,2,1,2,3,4\nCQUAD4,6,2,1,2,3,4\n";
  EXPECT_EQ(
      refusal(deck),
      "t.bdf:8: found 2 CQUAD4 whose corners all belong to solids and that are no outer face: "
      "nodes "
      "of solids do not turn, so as shells they hang on hinges; ignore = [\"CQUAD4\"] leaves out "
      "their stiffness and mass, nodes of their own with an RBE2 or RBE3 to the solid clamp them");
  EXPECT_EQ(read_deck(deck, {"cquad4"}).ignored.at("CQUAD4"), 2);
  EXPECT_EQ(read_deck(kTet + "MAT8,1,2.,3.,,,,,,+\n+,1.\n", {"MAT8"}).ignored.at("MAT8"), 1);
}

TEST(NastranFormat, KnownCardsCanBeIgnoredToo) {
  const std::string deck = kTet + "CONM2,5,1,,2.\n";
  EXPECT_EQ(read_deck(deck).masses.size(), 1u);
  const Deck without = read_deck(deck, {"CONM2"});
  EXPECT_TRUE(without.masses.empty());
  EXPECT_EQ(without.ignored.at("CONM2"), 1);
}

TEST(NastranFormat, WrongFieldsAreNamedWithTheirLine) {
  EXPECT_EQ(refusal("GRID,1,,abc,0.,0.\n"),
            "t.bdf:1: GRID: coordinate: found 'ABC', expected a number");
  EXPECT_EQ(refusal("GRID,1.5\n"),
            "t.bdf:1: GRID: ID: found '1.5', expected an integer from 1 to 2147483647");
  EXPECT_THAT(refusal("CTETRA,1,1,1,2,3,4,5,6,+\n+,7,8,9,x\n"),
              StartsWith("t.bdf:2: CTETRA: G: found 'X'"));
}

// The section that follows is read, and what waited before it is forgotten.
TEST(NastranContinuations, ThatBelongToNoCardEndWithTheirSection) {
  for (const char* next : {"", "BEGIN SUPER=1\nGRID,10,,0.,0.,0.\n"})
    EXPECT_THAT(
        refusal(kTet + "GRID,9,,0.,0.,0.,,,,+A\n+B,1\n" + next),
        HasSubstr("t.bdf:9: found continuation 'B', expected a card that ends in this name"));
}

}  // namespace
}  // namespace clatter::test
