// SPDX-License-Identifier: GPL-3.0-or-later
// Truncated decks, and several refusals at once.
#include <gmock/gmock.h>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int lines_in(const std::string& text) {
  return 1 + static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

/// A C3D20 of two lines, an equation of two lines, two steps.
const std::string kLong =
    "*NODE, NSET=NALL\n"
    "1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
    "8, 0, 1, 1\n9, .5, 0, 0\n10, 1, .5, 0\n11, .5, 1, 0\n12, 0, .5, 0\n13, .5, 0, 1\n"
    "14, 1, .5, 1\n15, .5, 1, 1\n16, 0, .5, 1\n17, 0, 0, .5\n18, 1, 0, .5\n19, 1, 1, .5\n"
    "20, 0, 1, .5\n"
    "*ELEMENT, TYPE=C3D20R, ELSET=EALL\n"
    "1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,\n11, 12, 13, 14, 15, 16, 17, 18, 19, 20\n"
    "*NSET, NSET=BOT, GENERATE\n1, 4\n"
    "*MATERIAL,\nNAME=Steel\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n"
    "2.1E5, 2.1E5, 2.1E5, .3, .3, .3, 8.E4, 8.E4,\n8.E4\n*DENSITY\n7.8E-9\n"
    "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
    "*EQUATION\n2\n5, 1, 1.,\n6, 1, -1.\n"
    "*BOUNDARY\nBOT, 1, 3\n"
    "*STEP\n*STATIC\n*CLOAD\n7, 3, 1.\n*END STEP\n"
    "*STEP\n*FREQUENCY\n5\n*END STEP\n";

TEST(AbaqusEnd, NoTruncationAtALineEndPassesSilently) {
  // After a *END STEP the deck is complete, with one step fewer.
  const Deck whole = read(kLong);
  EXPECT_TRUE(whole.notes.empty());
  int cuts = 0, complete_steps = 0;
  for (size_t end = kLong.find('\n'); end + 1 < kLong.size(); end = kLong.find('\n', end + 1)) {
    const std::string cut = kLong.substr(0, end + 1);
    ++cuts;
    if (cut.ends_with("*END STEP\n")) {
      EXPECT_TRUE(read(cut).notes.empty());
      ++complete_steps;
      continue;
    }
    const int line = lines_in(cut) - 1;
    try {
      const Deck deck = read(cut);
      ASSERT_EQ(deck.notes.size(), 1u) << cut;
      EXPECT_THAT(deck.notes[0], HasSubstr("deck.inp:" + std::to_string(line) + ": the deck ends"));
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("deck.inp")) << cut;
    }
  }
  EXPECT_EQ(cuts, 48);
  EXPECT_EQ(complete_steps, 1);
}

TEST(AbaqusEnd, AnOpenBlockAtTheEndIsRefusedByItsLine) {
  EXPECT_THAT(refusal(kModel + "*STEP\n*STATIC\n*CLOAD\n7, 3, 1.\n"),
              HasSubstr("deck.inp:24: found *STEP without *END STEP, the deck ends before it"));
  EXPECT_THAT(refusal(kModel + "*BOUNDARY\n"),
              HasSubstr("deck.inp:24: the deck ends with *BOUNDARY, expected its data lines"));
  EXPECT_THAT(refusal(kModel + "*SURFACE,\n"), HasSubstr("deck.inp:24: the deck ends after the "
                                                         "comma of *SURFACE"));
  EXPECT_THAT(refusal("*PART, NAME=A\n" + kCube +
                      "*END PART\n*ASSEMBLY, NAME=B\n"
                      "*INSTANCE, NAME=C, PART=A\n*END INSTANCE\n"),
              HasSubstr("found *ASSEMBLY without *END ASSEMBLY"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=S8\n5, 1, 2, 3, 4, 5,\n", {"S8"}),
              HasSubstr("deck.inp:25: the deck ends after a comma"));
}

TEST(AbaqusRefusals, ComeTogetherEachWithItsLine) {
  const std::string said = refusal(kCube + kSteel +
                                   "*CONTACT PAIR\nA, B\n*BOUNDARY\nBOT, 1, 9\nNOWHERE, 1, 3\n"
                                   "*STEP, NLGEOM\n*STATIC\n*DLOAD\nEALL, P9, 1.\n*CLOAD\n1, 3, x\n"
                                   "*END STEP\n");
  EXPECT_EQ(lines_in(said), 7) << said;
  EXPECT_THAT(said, HasSubstr("6 refusals:"));
  for (const char* one :
       {"deck.inp:24: contact opens and slides", "deck.inp:27: found '9' in field 3",
        "deck.inp:28: found no node set 'NOWHERE'", "deck.inp:29: *STEP with NLGEOM",
        "deck.inp:32: load P9 is not supported", "deck.inp:34: found 'x' in field 3"}) {
    EXPECT_THAT(said, HasSubstr(std::string("\n  ") + one)) << said;
  }
}

TEST(AbaqusRefusals, ConsequencesOfARefusalAreNotReported) {
  // The material and the surface are dropped; references to them, and to elements of an unsupported
  // type, are not refused again.
  const std::string said =
      refusal(kCube +
              "*ELEMENT, TYPE=CONN2D2, ELSET=BEAMS\n50, 1, 2\n"
              "*MATERIAL, NAME=Steel\n*ELASTIC, TYPE=ODD\n1, 2\n"
              "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n*ELSET, ELSET=BOTH\n1, 50\n"
              "*SURFACE, NAME=S\n1, S9\n*SURFACE, NAME=T\n1, S2\n*TIE, NAME=X\nS, T\n"
              "*STEP\n*STATIC\n*DLOAD\nBOTH, GRAV, 1., 0, 0, 1\n*END STEP\n");
  EXPECT_EQ(lines_in(said), 4) << said;
  EXPECT_THAT(said, HasSubstr("deck.inp:14: element type CONN2D2 is not supported"));
  EXPECT_THAT(said, HasSubstr("deck.inp:17: *ELASTIC: found TYPE=ODD"));
  EXPECT_THAT(said, HasSubstr("deck.inp:23: found face S9"));
}

TEST(AbaqusRefusals, RepetitionsAreCountedAndTenRefusalsAreTheLimit) {
  std::string twice = kModel, many = kModel;
  for (int i = 0; i < 3; ++i) twice += "*INERTIA RELIEF\nA, B\n";
  EXPECT_EQ(refusal(twice),
            "deck.inp:24: keyword *INERTIA RELIEF is not supported; ignore = [\"*INERTIA RELIEF\"] "
            "skips it with its data lines and its balance of loads: [[support]] of six DoFs of the "
            "recipe replace it (and 2 more, next at deck.inp:26)");
  for (int i = 0; i < 40; ++i) many += "*UNKNOWN " + std::to_string(i) + "\n";
  const std::string said = refusal(many);
  EXPECT_EQ(lines_in(said), 11);
  EXPECT_THAT(said, HasSubstr("the first 10 refusals:"));
  EXPECT_THAT(said, HasSubstr("*UNKNOWN 9 "));
  EXPECT_THAT(said, Not(HasSubstr("*UNKNOWN 10 ")));
}

TEST(AbaqusRefusals, TablesWithGapsAreNotFollowedByWhatNamesTheirLines) {
  const std::string said = refusal(
      "*NODE\n1, 0, 0, 0\n2, 1, x, 0\n3, 1, 1, 0\n*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n"
      "*ODD\n");
  EXPECT_EQ(lines_in(said), 3) << said;
  EXPECT_THAT(said, HasSubstr("deck.inp:3: found 'x', expected a coordinate"));
  EXPECT_THAT(said, HasSubstr("deck.inp:7: keyword *ODD"));
}

TEST(AbaqusSteps, AfterLinearStepsOthersAreSkippedWithANote) {
  const Deck deck =
      read(kModel +
           "*BOUNDARY\nBOT, 1, 3\n*STEP\n*FREQUENCY\n5\n*END STEP\n"
           "*STEP\n*MODAL DYNAMIC\n1., 2.\n*MODAL DAMPING\n1, 2, .02\n*CLOAD\n7, 3, 1.\n"
           "*END STEP\n*STEP\n*STATIC\n*CLOAD\n7, 3, 1.\n*END STEP\n");
  ASSERT_EQ(deck.steps.size(), 1u);
  EXPECT_EQ(deck.steps[0].modes, 5);
  ASSERT_EQ(deck.notes.size(), 2u);
  EXPECT_THAT(deck.notes[0], HasSubstr("deck.inp:31: the step with *MODAL DYNAMIC is left out"));
  EXPECT_THAT(deck.notes[1], HasSubstr("deck.inp:38: *STEP is left out"));
  EXPECT_THAT(refusal(kModel + "*STEP\n*DYNAMIC\n1., 2.\n*END STEP\n"),
              HasSubstr("deck.inp:25: keyword *DYNAMIC is not supported"));
}

TEST(AbaqusRefusals, AContinuumShellNamesTheSolidThatReplacesIt) {
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=SC8R\n50, 1, 2, 3, 4, 5, 6, 7, 8\n"),
              HasSubstr("element type SC8R is not supported: a continuum shell; the same nodes as "
                        "TYPE=C3D8I"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=SC6R\n50, 1, 2, 3, 5, 6, 7\n"),
              HasSubstr("the same nodes as TYPE=C3D6"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
