// SPDX-License-Identifier: GPL-3.0-or-later
// CBAR, CBEAM, CROD, CONROD, CTUBE and their properties.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "mesh/deck/beam_ends.hpp"
#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using Eigen::Vector3d;
using mesh::deck::Beam;
using mesh::deck::Deck;
using testing::HasSubstr;

// Two points 2 apart along z beside a tetrahedron.
const std::string kTwo = kTet + "GRID,9,,0.,0.,3.\nGRID,10,,0.,0.,5.\nMAT1,7,2.1+11,,.3,7850.\n";

Beam only_beam(const std::string& cards) {
  const Deck deck = read_deck(kTwo + cards + "ENDDATA\n");
  EXPECT_EQ(deck.beams.size(), 1u);
  return deck.beams.at(0);
}

TEST(NastranBar, HasItsSectionMaterialAndOrientation) {
  const Beam bar = only_beam(
      "PBAR,3,7,2.,3.,4.,5.,6.\n,,,,,,,,,+\n+,.8,.9\n"
      "CBAR,1,3,9,10,1.,0.,0.,,+\n+,5,56,.1,.2,.3,.4,.5,.6\n");
  EXPECT_EQ(bar.name, "cbar_1");
  EXPECT_EQ(bar.E, 2.1e11);
  EXPECT_NEAR(bar.G, 2.1e11 / 2.6, 1e-3);
  EXPECT_EQ(bar.rho, 7850.0);
  ASSERT_EQ(bar.sections.size(), 1u);
  EXPECT_EQ(bar.sections[0].area, 2.0);
  EXPECT_EQ(bar.sections[0].I1, 3.0);
  EXPECT_EQ(bar.sections[0].I2, 4.0);
  EXPECT_EQ(bar.sections[0].J, 5.0);
  EXPECT_EQ(bar.sections[0].line_mass, 6.0);
  EXPECT_EQ(bar.sections[0].I12, 0.0);
  EXPECT_THAT(bar.shear_factors, testing::ElementsAre(0.8, 0.9));
  EXPECT_EQ(bar.y.value(), Vector3d::UnitX());
  EXPECT_THAT(bar.released_a, testing::ElementsAre(4));
  EXPECT_THAT(bar.released_b, testing::ElementsAre(4, 5));
  EXPECT_EQ(bar.offset_a.value(), Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(bar.offset_b.value(), Vector3d(0.4, 0.5, 0.6));
}

// The orientation and offsets lie in the displacement system of the grids, here turned by 90
// degrees about z.
TEST(NastranBar, DirectionsAreThoseOfItsGrids) {
  const std::string turned =
      "CORD2R,5,0,0.,0.,0.,0.,0.,1.,+\n+,0.,1.,0.\nPBAR,3,7,2.,3.,4.\n"
      "GRID,11,,0.,0.,3.,5\nGRID,12,,0.,0.,5.,5\n";
  const auto y_of = [&](const std::string& card) { return only_beam(turned + card).y.value(); };
  EXPECT_LT((y_of("CBAR,1,3,11,12,1.,0.,0.\n") - Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((y_of("CBAR,1,3,11,12,1.,0.,0.,BGG\n") - Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((y_of("GRID,20,,-4.,0.,3.\nCBAR,1,3,11,12,20\n") + Vector3d::UnitX()).norm(), 1e-15);
  EXPECT_LT((y_of("BAROR,,3,,,0.,1.,0.\nCBAR,1,,11,12\n") + Vector3d::UnitX()).norm(), 1e-15);
  const Beam moved = only_beam(turned + "CBEAM,1,3,11,12,1.,0.,0.,,+\n+,,,.1,.2,.3\n");
  EXPECT_LT((moved.offset_a.value() - Vector3d(-0.2, 0.1, 0.3)).norm(), 1e-15);
  EXPECT_FALSE(moved.offset_b);
}

TEST(NastranBar, RodsCarryForceAndTorqueAlone) {
  const Beam rod = only_beam("PROD,3,7,2.,5.,,6.\nCROD,1,3,9,10\n");
  EXPECT_EQ(rod.sections[0].area, 2.0);
  EXPECT_EQ(rod.sections[0].J, 5.0);
  EXPECT_EQ(rod.sections[0].I1, 0.0);
  EXPECT_EQ(rod.sections[0].line_mass, 6.0);
  EXPECT_FALSE(rod.y);
  const Beam own = only_beam("CONROD,1,9,10,7,2.,5.,,6.\n");
  EXPECT_EQ(own.sections[0].area, 2.0);
  EXPECT_EQ(own.sections[0].line_mass, 6.0);
  const Beam tube = only_beam("PTUBE,3,7,4.,1.\nCTUBE,1,3,9,10\n");
  EXPECT_NEAR(tube.sections[0].area, 3.0 * std::numbers::pi, 1e-14);
  EXPECT_NEAR(tube.sections[0].J, 7.5 * std::numbers::pi, 1e-13);
}

TEST(NastranBar, ShapesHaveTheMomentsOfTheirDimensions) {
  const auto section = [](const std::string& property) {
    return only_beam(property + "CBAR,1,3,9,10,1.,0.,0.\n").sections.at(0);
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(section("PBARL,3,7,,ROD,,,,,+\n+,2.\n").I1, 4.0 * pi, 1e-13);
  EXPECT_NEAR(section("PBARL,3,7,,TUBE,,,,,+\n+,2.,1.\n").J, 7.5 * pi, 1e-13);
  EXPECT_NEAR(section("PBARL,3,7,,TUBE2,,,,,+\n+,2.,1.\n").J, 7.5 * pi, 1e-13);
  const auto bar = section("PBARL,3,7,,BAR,,,,,+\n+,2.,6.,1.5\n");  // 6 high along y
  EXPECT_NEAR(bar.I1, 36.0, 1e-13);
  EXPECT_NEAR(bar.I2, 4.0, 1e-13);
  EXPECT_EQ(bar.line_mass, 1.5);
  EXPECT_NEAR(bar.J, 48.0 * 0.263, 0.02);  // Timoshenko and Goodier: 0.263 a b^3 at a : b = 3
  const auto box = section("PBARL,3,7,,BOX,,,,,+\n+,4.,6.,1.,.5\n");
  EXPECT_NEAR(box.area, 24.0 - 3.0 * 4.0, 1e-13);
  EXPECT_NEAR(box.I1, (4.0 * 216.0 - 3.0 * 64.0) / 12.0, 1e-13);
  EXPECT_NEAR(box.J, 4.0 * 17.5 * 17.5 / (2.0 * 3.5 / 1.0 + 2.0 * 5.0 / 0.5), 1e-12);  // Bredt
  // As a deck has it, with the values that its program computed from the shape.
  const auto i = section("PBARL,3,7,,I,,,,,+\n+,2.,1.,1.,.1,.1,.1\n");
  EXPECT_NEAR(i.area, 0.38, 1e-12);
  EXPECT_NEAR(i.I1, 0.22927, 5e-6);
  EXPECT_NEAR(i.I2, 0.016817, 5e-7);
}

TEST(NastranBar, BeamsMayTaper) {
  const Beam beam = only_beam(
      "PBEAM,3,7,2.,3.,4.,,5.,,+\n+,,,,,,,,,+\n+,YES,1.,1.,2.,,,,,+\n+,,,,,,,,,+\n+,0.,0.\n"
      "CBEAM,1,3,9,10,1.,0.,0.\n");
  ASSERT_EQ(beam.sections.size(), 2u);
  EXPECT_EQ(beam.sections[1].at, 1.0);
  EXPECT_EQ(beam.sections[1].area, 1.0);
  EXPECT_EQ(beam.sections[1].I1, 2.0);
  EXPECT_EQ(beam.sections[1].I2, 4.0);  // as at A
  EXPECT_TRUE(beam.shear_factors.empty());
  const Beam shape =
      only_beam("PBEAML,3,7,,BAR,,,,,+\n+,2.,6.,,YES,1.,1.,6.\nCBEAM,1,3,9,10,1.,0.,0.\n");
  ASSERT_EQ(shape.sections.size(), 2u);
  EXPECT_NEAR(shape.sections[1].area, 6.0, 1e-14);
}

// MSC Nastran QRG, PBEAM, remark 7: between the ends blank fields are those of a straight line.
TEST(NastranBar, BlankFieldsOfAStationLieBetweenTheEnds) {
  const std::string bar = "CBEAM,1,3,9,10,1.,0.,0.\n";
  const Beam beam = only_beam(
      "PBEAM,3,7,8.,3.,4.,,5.,.6,+\n+,,,,,,,,,+\n+,NO,.25,,7.,,,,,+\n+,NO,1.,4.,1.,,,1.,,+\n"
      "+,0.,0.\n" +
      bar);
  ASSERT_EQ(beam.sections.size(), 3u);
  EXPECT_EQ(beam.sections[1].at, 0.25);
  EXPECT_NEAR(beam.sections[1].area, 7.0, 1e-14);
  EXPECT_EQ(beam.sections[1].I1, 7.0);
  EXPECT_EQ(beam.sections[1].I2, 4.0);
  EXPECT_NEAR(beam.sections[1].J, 4.0, 1e-14);
  EXPECT_NEAR(beam.sections[1].line_mass, 0.6, 1e-14);
  EXPECT_NEAR(beam.sections[2].line_mass, 0.6, 1e-14);
  const Beam shape =
      only_beam("PBEAML,3,7,,BAR,,,,,+\n+,2.,6.,.5,YES,.5,,,,+\n+,YES,1.,1.,2.\n" + bar);
  ASSERT_EQ(shape.sections.size(), 3u);
  EXPECT_NEAR(shape.sections[1].area, 1.5 * 4.0, 1e-14);
  EXPECT_NEAR(shape.sections[1].line_mass, 0.5, 1e-14);
  EXPECT_NEAR(shape.sections[2].line_mass, 0.5, 1e-14);  // NSM(B) is NSM(A) where it is blank
}

// QRG, PBAR, remark 5; CBAR: PID is EID where it is blank.
TEST(NastranBar, ShearFactorsHaveNoEffectBesideI12AndABlankPropertyIsTheOwnNumber) {
  const Beam askew =
      only_beam("PBAR,3,7,2.,3.,4.,5.,,,+\n+,,,,,,,,,+\n+,.8,.8,.5\nCBAR,3,,9,10,1.,0.,0.\n");
  EXPECT_EQ(askew.sections.at(0).I12, 0.5);
  EXPECT_TRUE(askew.shear_factors.empty());
}

TEST(NastranBar, EndsOnNodesOfSolidsAreHingesAndSaid) {
  Deck deck = read_deck(kTwo +
                        "PBAR,3,7,2.,3.,4.,5.\nCBAR,1,3,1,2,0.,0.,1.\nCBAR,2,3,3,9,1.,0.,0.\n"
                        "CBAR,4,3,9,10,1.,0.,0.\nENDDATA\n");
  const size_t notes = deck.notes.size();
  settle_beam_ends(deck);
  EXPECT_EQ(deck.beams.at(0).sections[0].J, 0.0);  // no end of it holds a torque
  EXPECT_EQ(deck.beams.at(1).sections[0].J, 5.0);
  ASSERT_EQ(deck.notes.size(), notes + 1);
  EXPECT_THAT(deck.notes.back(), HasSubstr("t.bdf:12: 2 of 3 bars end on nodes of solids"));
  mesh::deck::Step& warm = deck.steps.emplace_back();
  warm.where = "t.bdf:3";
  warm.temperature = "field";
  settle_beam_ends(deck);
  EXPECT_THAT(deck.notes.back(),
              HasSubstr("t.bdf:3: its temperatures expand solids and shells: the 3 bars "));
}

TEST(NastranBar, WithoutMeaningIsRefusedByLine) {
  const auto refused = [](const std::string& cards) { return refusal(kTwo + cards); };
  EXPECT_THAT(refused("CBAR,1,3,9,10,1.,0.,0.\n"),
              HasSubstr("t.bdf:11: cbar_1: found no property"));
  EXPECT_THAT(refused("PBAR,3,8,2.\nCBAR,1,3,9,10,1.,0.,0.\n"), HasSubstr("PBAR: found no MAT1 8"));
  EXPECT_THAT(refused("PBAR,3,7,2.,1.,1.\nCBAR,1,3,9,10\n"), HasSubstr("found no orientation"));
  EXPECT_THAT(refused("PBAR,3,7,2.,1.,1.\nCBAR,1,3,9,10,1.,0.,0.,GOO\n"), HasSubstr("OFFT"));
  EXPECT_THAT(refused("PBARL,3,7,,HAT,,,,,+\n+,1.,1.,1.,1.\nCBAR,1,3,9,10,1.,0.,0.\n"),
              HasSubstr("found TYPE HAT, expected one of ROD, TUBE"));
  EXPECT_THAT(refused("PBAR,3,7,-2.\n"), HasSubstr("A"));
  EXPECT_THAT(refused("PBAR,3,7,2.\nPROD,3,7,2.\n"), HasSubstr("second property 3 of bars"));
  EXPECT_THAT(refused("PBEAM,3,7,2.,1.,1.,,,,+\n+,,,,,,,,,+\n+,1.,1.,,,,,,,+\n+,,,,,.5\n"
                      "CBEAM,1,3,9,10,1.,0.,0.\n"),
              HasSubstr("found NSI, M or N"));
}

}  // namespace
}  // namespace clatter::test
