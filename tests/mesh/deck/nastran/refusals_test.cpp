// SPDX-License-Identifier: GPL-3.0-or-later
// Truncated bulk data, several refusals at once, RFORCE.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using mesh::deck::Deck;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(NastranEnd, ADeckWithoutEnddataSaysWhereItEnds) {
  const Deck cut = read_deck(kTet);
  ASSERT_EQ(cut.notes.size(), 1u);
  EXPECT_THAT(cut.notes[0],
              HasSubstr("t.bdf:7: the deck ends here, after card CTETRA, without ENDDATA"));
  EXPECT_TRUE(read_deck(kTet + "ENDDATA\n").notes.empty());
}

TEST(NastranEnd, NoTruncationAtALineEndPassesSilently) {
  const std::string whole = "SOL 101\nCEND\nSUBCASE 1\nSPC=1\nLOAD=2\nBEGIN BULK\n" + kTet +
                            "SPC1,1,123,1,2,3\nFORCE,2,4,0,1.,0.,0.,1.\nENDDATA\n";
  EXPECT_TRUE(read_deck(whole).notes.empty());
  for (size_t end = whole.find('\n'); end + 1 < whole.size(); end = whole.find('\n', end + 1)) {
    const std::string cut = whole.substr(0, end + 1);
    try {
      EXPECT_EQ(read_deck(cut).notes.size(), 1u) << cut;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("t.bdf")) << cut;
    }
  }
}

TEST(NastranEnd, ACardWhoseContinuationIsCutOffIsNamed) {
  // Six of ten nodes would make another valid cell.
  const std::string head = kTet.substr(0, kTet.find("CTETRA")) +
                           "GRID,5,,.5,0.,0.\nGRID,6,,.5,.5,0.\nGRID,7,,0.,.5,0.\n"
                           "GRID,8,,0.,0.,.5\nGRID,9,,.5,0.,.5\nGRID,10,,0.,.5,.5\n"
                           "CTETRA,1,1,1,2,3,4,5,6,+C1\n";
  EXPECT_TRUE(read_deck(head + "+C1,7,8,9,10\nENDDATA\n").notes.empty());
  const Deck cut = read_deck(head);
  ASSERT_EQ(cut.notes.size(), 1u);
  EXPECT_THAT(cut.notes[0], HasSubstr("card CTETRA whose continuation 'C1' is missing"));
}

TEST(NastranRefusals, ComeTogetherEachWithItsLine) {
  const std::string said = refusal(kTet +
                                   "CQUAD4,7,1,1,2,3,4\nCBEND,8,1,1,2\nCQUAD4,9,1,1,2,3,4\n"
                                   "MPC,1,99,1,1.,1,1,-1.\nCONM2,5,98,0,1.\nENDDATA\n");
  EXPECT_THAT(said, HasSubstr("4 refusals:"));
  EXPECT_THAT(said, HasSubstr("t.bdf:8: found 2 CQUAD4 whose corners all belong to solids"));
  EXPECT_THAT(said, HasSubstr("t.bdf:9: card CBEND is not supported"));
  EXPECT_THAT(said, HasSubstr("t.bdf:11: "));
  EXPECT_THAT(said, HasSubstr("t.bdf:12: "));
}

TEST(NastranRefusals, CardsThatNameARefusedOneAreNotRefusedAfterIt) {
  std::string deck = kTet;
  deck.replace(deck.find("GRID,2,,1.,0.,0."), 16, "GRID,2,,1.,zero,0.");
  const std::string said = refusal(deck + "SHELL,1\nENDDATA\n");
  EXPECT_THAT(said, HasSubstr("t.bdf:4: GRID"));
  EXPECT_THAT(said, HasSubstr("t.bdf:8: card SHELL is not supported"));
  EXPECT_THAT(said, Not(HasSubstr("no GRID 2")));
}

TEST(NastranLoads, RforceIsOmegaSquaredAboutAnAxisThroughItsGrid) {
  const Deck deck = read_deck(kTet + "RFORCE,3,2,0,10.,0.,0.,2.\nENDDATA\n");
  ASSERT_EQ(deck.steps.size(), 1u);
  ASSERT_EQ(deck.steps[0].rotations.size(), 1u);
  const auto& one = deck.steps[0].rotations[0];
  const double omega = 2.0 * std::numbers::pi * 20.0;
  EXPECT_DOUBLE_EQ(one.omega_squared, omega * omega);
  EXPECT_EQ(one.axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(one.point, Eigen::Vector3d(1, 0, 0));
  EXPECT_THAT(refusal(kTet + "RFORCE,3,2,0,10.,0.,0.,2.,2\n,5.\nENDDATA\n"),
              HasSubstr("RACC: angular acceleration is not supported"));
}

}  // namespace
}  // namespace clatter::test
