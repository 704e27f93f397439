// SPDX-License-Identifier: GPL-3.0-or-later
// Hostile decks: each is read or refused with one clear line. CTest's limit of time is low: none
// may cost more than its text.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/mesh/deck/nastran/support.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(NastranHostile, HugeRangesCostNothing) {
  EXPECT_EQ(read_deck(kTet + "SPC1,1,3,1,THRU,2000000000\n").supports.size(), 1u);
  std::string many = kTet + "GRID,2147483647,,0.,0.,0.\n";
  for (int i = 0; i < 20000; ++i) many += "SPC1,1,3,1,THRU,2147483647\n";
  EXPECT_EQ(read_deck(many).supports.size(), 1u);
}

TEST(NastranHostile, ListsThatMultiplyAreRefused) {
  std::string deck = kTet;
  for (int i = 10; i < 20000; ++i) deck += fmt::format("GRID,{}\n", i);
  deck += "RBE2,1,10,123,11,THRU,19999\n";
  for (int i = 1; i < 20000; ++i) deck += fmt::format("SET1,{},1,THRU,20000\n", i);
  EXPECT_THAT(refusal(deck), HasSubstr("repeat the same grids too often"));
}

TEST(NastranHostile, NumbersThatOverflowAreRefused) {
  EXPECT_THAT(refusal("GRID,1,,1.+400,0.,0.\n"), HasSubstr("found '1.+400', expected a number"));
  EXPECT_THAT(refusal("GRID,99999999999,,1.,0.,0.\n"), HasSubstr("found '99999999999'"));
  const std::string far = "CORD2R,5,0,1.+308,1.+308,1.+308,1.,0.,0.,+\n+,0.,1.,0.\n";
  EXPECT_NE(refusal(kTet + far + "GRID,9,5,1.+308,1.+308,1.+308\n"), "");
  EXPECT_THAT(refusal(kTet + "FORCE,1,1,,1.+308,1.+308,0.,0.\n"), HasSubstr("too large"));
  EXPECT_THAT(refusal(kTet + "GRAV,1,,1.+308,1.+308,0.,0.\n"), HasSubstr("too large"));
  EXPECT_THAT(
      refusal(kTet +
              "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\nGRID,9,,1.,1.,0.\nCONM2,1,9,5,1.,,,,,+\n"
              "+,1.+308,1.+308,1.+308,1.+308,1.+308,1.+308\n"),
      HasSubstr("too large"));
}

TEST(NastranHostile, LongLinesAreRefusedAndLongCommentsPassed) {
  const std::string ten_megabytes(10'000'000, 'x');
  EXPECT_THAT(refusal(kTet + ten_megabytes + "\n"),
              StartsWith("t.bdf:8: found a line of more than 65536"));
  EXPECT_EQ(refusal(kTet + "$" + ten_megabytes + "\n"), "");
  const auto file = test::scratch_path("long_line.bdf");
  for (const bool comment : {true, false}) {
    std::ofstream(file) << kTet << (comment ? "$" : "") << ten_megabytes << "\nENDDATA\n";
    if (comment) {
      EXPECT_EQ(mesh::deck::read_nastran(file).mesh.cell_count(), 1);
    } else {
      test::expect_parts(test::refusal_of([&] { mesh::deck::read_nastran(file); }),
                         {":8: found a line of more than 65536"});
    }
  }
  std::filesystem::remove(file);
}

TEST(NastranHostile, LongChainsOfSystemsNeedNoStack) {
  constexpr int kSystems = 100000;
  std::string chain = kTet, ring = kTet;
  for (int i = 1; i <= kSystems; ++i) {  // each one higher than the one before
    const char* shift = "0.,0.,1.,0.,0.,2.,+\n+,1.,0.,1.\n";
    chain += fmt::format("CORD2R,{},{},{}", i, i - 1, shift);
    ring += fmt::format("CORD2R,{},{},{}", i, i % kSystems + 1, shift);
  }
  const auto deck = read_deck(chain + fmt::format("GRID,9,{},0.,0.,0.\nCONM2,1,9,,1.\n", kSystems));
  EXPECT_EQ(deck.points.at(0).at[2], kSystems);
  EXPECT_EQ(refusal(ring), "t.bdf:8: coordinate system 1 refers to itself through others");
}

TEST(NastranHostile, ManyPropertiesSubcasesAndPendingCardsTakeLinearTime) {
  std::string cells = kTet.substr(kTet.find("GRID,1"), kTet.find("CTETRA") - kTet.find("GRID,1"));
  std::string cases = "CEND\nLOAD=1\n", waiting = kTet;
  for (int i = 1; i < 20000; ++i) {
    cells += fmt::format("CTETRA,{},{},1,2,3,4\n", i, i);
    cases += fmt::format("SUBCASE {}\n", i);
    waiting += fmt::format("SET1,{},1,,,,,,,+A{}\n", i, i);
  }
  EXPECT_EQ(read_deck(cells).mesh.regions.size(), 19999u);
  EXPECT_EQ(read_deck(cases + "BEGIN BULK\n" + kTet + "FORCE,1,1,,1.,1.\n").steps.size(), 19999u);
  EXPECT_EQ(read_deck(waiting).mesh.node_sets.size(), 19999u);
  std::string forces = cases + "BEGIN BULK\n" + kTet;
  for (int i = 0; i < 20000; ++i) forces += "FORCE,1,1,,1.,1.\n";
  EXPECT_THAT(refusal(forces), HasSubstr("grids too often"));
}

TEST(NastranHostile, UnprintableBytesAreShownAsQuestionMarks) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  const std::string message = refusal(bytes);
  EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](char c) {
    return c == '\n' || (c >= ' ' && c <= '~');  // one line for each refusal
  })) << message;
  EXPECT_THAT(refusal(std::string("\0\0\0", 3)), StartsWith("t.bdf:1: found '?"));
}

TEST(NastranHostile, EmptyDecksAreEmpty) {
  for (const char* text : {"", "\n", "$", "ENDDATA", "\xef\xbb\xbf", "BEGIN BULK", "\r\n\t\n"}) {
    EXPECT_EQ(read_deck(text).mesh.cell_count(), 0) << text;
  }
}

TEST(NastranHostile, CardsCutAnywhereAreReadOrRefused) {
  const std::string deck =
      "SOL 101\nCEND\nLOAD=1\nSPC=2\nBEGIN BULK\n" + kTet +
      "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\nGRID,9,5,1.,90.,0.,5,3\nRBE2,7,9,13,1,THRU,3\n"
      "RBE3,8,,9,123,1.,123,1,2,+\n+,UM,9,123\nMPC,1,1,1,2.,2,1,1.\nCONM2,5,9,5,1.,1.,1.,1.,,+\n"
      "+,1.,1.,1.\nFORCE,1,1,5,1.,1.\nSPC,2,1,1,1.\nPLOAD4,1,1,5.,,,,1,3\nTEMP,1,1,5.\nENDDATA\n";
  int read = 0;
  for (size_t length = 0; length <= deck.size(); ++length) {
    read += refusal(deck.substr(0, length)).empty() ? 1 : 0;
  }
  EXPECT_GT(read, 0);
  EXPECT_LT(read, static_cast<int>(deck.size()));
}

}  // namespace
}  // namespace clatter::test
