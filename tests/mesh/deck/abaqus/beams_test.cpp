// SPDX-License-Identifier: GPL-3.0-or-later
// B31, B32 and T3D2 with their sections.
#include <gmock/gmock.h>

#include <numbers>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

const std::string kNodes =
    "*NODE\n1, 0., 0., 0.\n2, 2., 0., 0.\n3, 4., 0., 0.\n"
    "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E11, .3\n*DENSITY\n7850.\n";

std::vector<Beam> beams(const std::string& cards) { return read(kNodes + cards).beams; }

TEST(AbaqusBars, HasItsSectionMaterialAndOrientation) {
  const auto found = beams(
      "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n8, 2, 3\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=RECT\n3., 2.\n0., 1., 0.\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "B31_7");
  EXPECT_EQ(found[0].E, 2.1e11);
  EXPECT_NEAR(found[0].G, 2.1e11 / 2.6, 1e-3);
  EXPECT_EQ(found[0].rho, 7850.0);
  EXPECT_EQ(found[0].y.value(), Vector3d::UnitY());
  EXPECT_EQ(found[0].sections.at(0).area, 6.0);
  EXPECT_NEAR(found[0].sections.at(0).I1, 2.0 * 27.0 / 12.0, 1e-14);  // 3 high along n1
  EXPECT_EQ(found[1].ends, (std::array<NodeIndex, 2>{1, 2}));
}

TEST(AbaqusBars, TheirElementSetsAreSetsOfTheirNodes) {
  const Deck deck = read(kNodes +
                         "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n8, 2, 3\n"
                         "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=CIRC\n3.\n");
  EXPECT_EQ(deck.sets.at("B"), (std::vector<NodeIndex>{0, 1, 2}));
  EXPECT_FALSE(deck.mesh.node_sets.contains("B"));
}

TEST(AbaqusBars, OfThreeNodesIsTwo) {
  const auto found = beams(
      "*ELEMENT, TYPE=B32, ELSET=B\n7, 1, 2, 3\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=PIPE\n2., 1.\n");
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[1].name, "B32_7b");
  EXPECT_NEAR(found[0].sections.at(0).area, 3.0 * std::numbers::pi, 1e-14);
  EXPECT_EQ(found[0].y.value(), -Vector3d::UnitZ());  // n1 without a line
}

TEST(AbaqusBars, OfABoxHasItsWalls) {
  const auto found = beams(
      "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=BOX\n6., 4., 1., .5, 1., .5\n");
  EXPECT_NEAR(found.at(0).sections.at(0).area, 24.0 - 4.0 * 3.0, 1e-14);
}

TEST(AbaqusBars, ACircleHasItsRadiusInAbaqusAndItsDiameterInCalculix) {
  const std::string head =
      "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=CIRC\n";
  const auto area = [](const Deck& deck) { return deck.beams.at(0).sections.at(0).area; };
  const Deck of_abaqus = read(kNodes + head + "2.\n0., 1., 0.\n");
  EXPECT_NEAR(area(of_abaqus), 4.0 * std::numbers::pi, 1e-14);
  EXPECT_THAT(of_abaqus.notes,
              ::testing::Contains(HasSubstr("deck.inp:12: CIRC: 2. is the radius")));
  const Deck twice = read(kNodes + head + "2., 2.\n0., 1., 0.\n");
  EXPECT_NEAR(area(twice), std::numbers::pi, 1e-14);
  EXPECT_THAT(twice.notes, ::testing::Not(::testing::Contains(HasSubstr("CIRC"))));
  const Deck of_calculix = read(kNodes + head +
                                "2.\n0., 1., 0.\n*STEP\n*STATIC\n*CLOAD\n2, 2, 1.\n"
                                "*NODE FILE, OUTPUT=2d\nU\n*END STEP\n");
  EXPECT_NEAR(area(of_calculix), std::numbers::pi, 1e-14);
  EXPECT_THAT(of_calculix.notes, ::testing::Contains(HasSubstr("CIRC: 2. is the diameter")));
  EXPECT_THAT(refusal(kNodes + head + "2., 3.\n"), HasSubstr("found an ellipse"));
}

TEST(AbaqusBars, OfAnIIsHighAlongLocal2) {
  const std::string head =
      "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n"
      "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=I\n";
  const auto found = beams(head + "5., 10., 6., 6., 1., 1., .5\n0., 1., 0.\n");
  const recipe::BeamSection& section = found.at(0).sections.at(0);
  EXPECT_NEAR(section.area, 16.0, 1e-14);
  EXPECT_NEAR(section.I2, (6.0 * 1000.0 - 5.5 * 512.0) / 12.0, 1e-12);
  EXPECT_NEAR(section.I1, (2.0 * 216.0 + 8.0 * 0.125) / 12.0, 1e-12);
  EXPECT_THAT(refusal(kNodes + head + "4., 10., 6., 6., 1., 1., .5\n"),
              HasSubstr("expected its centroid at 5"));
}

TEST(AbaqusBars, OfAGeneralSectionHasItsNumbersOrTheShapeOfCalculix) {
  const std::string head = "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n*BEAM GENERAL SECTION, ELSET=B";
  const auto own = beams(head + ", DENSITY=7850.\n6., 2., .1, 4.5, 3.\n0., 1., 0.\n2.E11, 8.E10\n");
  const recipe::BeamSection& section = own.at(0).sections.at(0);
  EXPECT_EQ(section.area, 6.0);
  EXPECT_EQ(section.I1, 4.5);  // int y^2, bending about local 2
  EXPECT_EQ(section.I2, 2.0);
  EXPECT_EQ(section.I12, 0.1);
  EXPECT_EQ(section.J, 3.0);
  EXPECT_EQ(own[0].E, 2e11);
  EXPECT_EQ(own[0].G, 8e10);
  EXPECT_EQ(own[0].rho, 7850.0);
  const auto pipe = beams(head + ", MATERIAL=STEEL, SECTION=PIPE\n2., 1.\n0., 1., 0.\n");
  EXPECT_NEAR(pipe.at(0).sections.at(0).area, 3.0 * std::numbers::pi, 1e-14);
  EXPECT_EQ(pipe[0].E, 2.1e11);
  EXPECT_THAT(refusal(kNodes + head + "\n6., 2., .1, 4.5, 3.\n"), HasSubstr("expected E, G"));
  EXPECT_THAT(refusal(kNodes + head + ", MATERIAL=STEEL, SECTION=GENERAL\n6., 2., .1, 4.5, .8\n"),
              HasSubstr("SECTION=GENERAL with a MATERIAL is not read"));
}

TEST(AbaqusBars, TrussesHaveAnAreaAlone) {
  const auto found = beams(
      "*ELEMENT, TYPE=T3D2, ELSET=T\n7, 1, 2\n*SOLID SECTION, ELSET=T, MATERIAL=Steel\n2.5\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].sections.at(0).area, 2.5);
  EXPECT_EQ(found[0].sections.at(0).I1, 0.0);
  EXPECT_FALSE(found[0].y);
}

TEST(AbaqusBars, WithoutMeaningIsRefusedByLine) {
  const std::string element = "*ELEMENT, TYPE=B31, ELSET=B\n7, 1, 2\n";
  const auto refused = [&](const std::string& section) {
    return refusal(kNodes + element + section);
  };
  const std::string head = "*BEAM SECTION, ELSET=B, MATERIAL=STEEL, SECTION=";
  EXPECT_THAT(refused(""), HasSubstr("deck.inp:11: 1 elements B31 are beams or trusses"));
  EXPECT_THAT(refused(head + "HEX\n1., 2.\n"),
              HasSubstr("expected CIRC, RECT, PIPE, BOX, I, or GENERAL"));
  EXPECT_THAT(refused("*BEAM SECTION, TAPER, ELSET=B, MATERIAL=STEEL, SECTION=CIRC\n1.\n"),
              HasSubstr("TAPER is not supported"));
  EXPECT_THAT(refused(head + "CIRC\n0.\n"), HasSubstr("a dimension of 0"));
  EXPECT_THAT(refused(head + "CIRC\n1.\n1., 0., 0.\n"), HasSubstr("n1 is along an element"));
  EXPECT_THAT(refused(head + "BOX\n6., 4., 1., .5, 1., .6\n"), HasSubstr("unequal opposite walls"));
  EXPECT_THAT(refused("*BEAM SECTION, ELSET=B, MATERIAL=Iron, SECTION=CIRC\n1.\n"),
              HasSubstr("found no *MATERIAL Iron"));
  // Found by the fuzzer: a material without *ELASTIC, or with one that is refused.
  EXPECT_THAT(refused("*MATERIAL, NAME=Iron\n*DENSITY\n7850.\n"
                      "*BEAM SECTION, ELSET=B, MATERIAL=Iron, SECTION=CIRC\n1.\n"),
              HasSubstr("*MATERIAL Iron of beams is not isotropic, expected *ELASTIC of E and nu"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
