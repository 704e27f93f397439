// SPDX-License-Identifier: GPL-3.0-or-later
// S3 to S8R with a *SHELL SECTION beside solids.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "mesh/deck/recipe/recipe.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

// Two squares along x, of nodes 1 to 6.
const std::string kSheetNodes =
    "*NODE, NSET=ALL\n1, 0, 0, 0\n2, 1, 0, 0\n3, 2, 0, 0\n4, 0, 1, 0\n5, 1, 1, 0\n6, 2, 1, 0\n"
    "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n*DENSITY\n7.8E-9\n";
const std::string kShellSection = "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL\n.2, 5\n";
const std::string kTwoShells =
    kSheetNodes + "*ELEMENT, TYPE=S4, ELSET=WALL\n11, 1, 2, 5, 4\n12, 2, 3, 6, 5\n";
const std::string kSheetDeck = kTwoShells + kShellSection;

std::string notes_of(const Deck& deck) {
  std::string all;
  for (const std::string& note : deck.notes) all += note + "\n";
  return all;
}

TEST(AbaqusShells, AreCellsOfTheRegionOfTheirSection) {
  const Deck deck = read(kSheetDeck);
  EXPECT_THAT(deck.mesh.regions, ElementsAre("WALL"));
  EXPECT_EQ(deck.regions.at(0).material, "Steel");
  EXPECT_EQ(deck.mesh.nodes.rows(), 6);
  const ShellBlock& block = deck.mesh.shells.at(0);
  EXPECT_EQ(block.type, FaceType::kQuad4);
  EXPECT_THAT(block.ids, ElementsAre(11, 12));
  EXPECT_EQ(block.nodes.row(1), (Eigen::RowVector<int32_t, 4>(1, 2, 5, 4)));
  EXPECT_EQ(deck.shells.at(0).section.thickness, 0.2);
  EXPECT_EQ(deck.shells.at(0).section.shear, 5.0 / 6.0);
}

TEST(AbaqusShells, OffsetAndDensityAreThoseOfTheSection) {
  const auto with = [](const std::string& parameter) {
    return kTwoShells + "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL, " + parameter + "\n.2\n";
  };
  EXPECT_EQ(read(with("OFFSET=SPOS")).mesh.shells.at(0).offset, Eigen::Vector2d(-0.1, -0.1));
  EXPECT_EQ(read(with("OFFSET=-.25")).mesh.shells.at(0).offset, Eigen::Vector2d(0.05, 0.05));
  EXPECT_EQ(read(with("DENSITY=3.")).shells.at(0).section.area_mass, 3.0);
  EXPECT_THAT(refusal(with("OFFSET=FIELD")), HasSubstr("found OFFSET=FIELD, expected a number"));
  EXPECT_THAT(refusal(with("ORIENTATION=A")), HasSubstr("found no orientation 'A'"));
}

const std::string kFibres =
    "*MATERIAL, NAME=Fibres\n*ELASTIC, TYPE=LAMINA\n140., 10., .3, 5., 4., 3.\n";

TEST(AbaqusShells, LayersHaveAnglesFromTheOrientationOfTheSection) {
  const std::string turned =
      "*ORIENTATION, NAME=AXES\n0., 1., 0., -1., 0., 0.\n3, 0.\n"
      "*ORIENTATION, NAME=PLY\n1., 0., 0., 0., 1., 0.\n3, 30.\n";
  const auto section = [](const std::string& parameters, const std::string& lines) {
    return "*SHELL SECTION, ELSET=WALL, COMPOSITE" + parameters + "\n" + lines;
  };
  Deck deck = read(kTwoShells + kFibres + turned +
                   section(", ORIENTATION=AXES, OFFSET=SNEG",
                           ".1, 3, FIBRES, 45., outer\n.2, , Steel\n.1, 3, Fibres, PLY\n"));
  const recipe::Shell& shell = deck.shells.at(0);
  ASSERT_EQ(shell.layers.size(), 3u);
  EXPECT_EQ(shell.layers[0].material, "Fibres");
  EXPECT_DOUBLE_EQ(shell.layers[0].angle, std::numbers::pi / 4.0);
  EXPECT_EQ(shell.layers[1].angle, 0.0);
  EXPECT_NEAR(shell.layers[2].angle, -std::numbers::pi / 3.0, 1e-15);
  EXPECT_EQ(shell.section.thickness, 0.0);
  const ShellBlock& block = deck.mesh.shells.at(0);
  EXPECT_EQ(block.thickness.size(), 0);
  EXPECT_TRUE(block.axis.row(1).isApprox(Eigen::RowVector3d(0.0, 1.0, 0.0), 1e-15));
  EXPECT_NEAR(block.offset(0), 0.2, 1e-15);
  EXPECT_THAT(deck.materials.at("Fibres").constants,
              ElementsAre(140.0, 10.0, 10.0, 0.3, 0.0, 0.0, 5.0, 4.0, 3.0));
  const recipe::File file = recipe_of(deck).file;
  EXPECT_EQ(file.shells.at(0).layers.at(1).material, "Steel");
  EXPECT_EQ(file.materials.size(), 2u);
  const Deck mirrored =
      read(kTwoShells + kFibres + section(", SYMMETRIC", ".1, 3, FIBRES, 45.\n.2, 3, FIBRES\n"));
  EXPECT_EQ(mirrored.shells.at(0).layers.size(), 4u);
  EXPECT_EQ(mirrored.shells.at(0).layers[3].thickness, 0.1);
  EXPECT_EQ(mirrored.mesh.shells.at(0).axis.row(0), Eigen::RowVector3d(1.0, 0.0, 0.0));
  EXPECT_THAT(refusal(kTwoShells + section("", ".1, 3, NONE\n")),
              HasSubstr("found no material 'NONE'"));
  EXPECT_THAT(refusal(kTwoShells + section("", "")), HasSubstr("expected one a layer"));
  EXPECT_THAT(refusal(kTwoShells + section("", "0., 3, STEEL\n")),
              HasSubstr("found a thickness of 0, expected more than 0"));
}

TEST(AbaqusShells, TheAxisOfAnOrientationIsNearTheNormal) {
  // The axis about which the second line turns is that of the normal, by default the first one: the
  // next one is projected.
  const auto axis = [](const std::string& orientation) {
    return read(kTwoShells + kFibres + "*ORIENTATION, NAME=AXES\n" + orientation +
                "*SHELL SECTION, ELSET=WALL, MATERIAL=FIBRES, ORIENTATION=AXES\n.2\n")
        .mesh.shells.at(0)
        .axis.row(0)
        .eval();
  };
  EXPECT_EQ(axis("0., 0., 1., 1., 0., 0.\n"), Eigen::RowVector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(axis("1., 0., 0., 0., 1., 0.\n3\n"), Eigen::RowVector3d(1.0, 0.0, 0.0));
  EXPECT_TRUE(axis("1., 0., 0., 0., 1., 0.\n3, 90.\n").isApprox(Eigen::RowVector3d(0.0, 1.0, 0.0)));
  EXPECT_THAT(refusal(kTwoShells + kFibres +
                      "*ORIENTATION, NAME=AXES\n1., 0., 0., 0., 1., 0.\n"
                      "*SHELL SECTION, ELSET=WALL, MATERIAL=FIBRES, ORIENTATION=AXES\n.2\n"),
              HasSubstr("orientation AXES: found no second line"));
  EXPECT_THAT(refusal(kTwoShells + kFibres +
                      "*ORIENTATION, NAME=AXES\n1., 0., 0., 0., 0., 1.\n1, 0.\n"
                      "*SHELL SECTION, ELSET=WALL, MATERIAL=FIBRES, ORIENTATION=AXES\n.2\n"),
              HasSubstr("orientation AXES: its direction that is projected is along the normal"));
}

TEST(AbaqusShells, ThicknessMayBeThatOfNodes) {
  const std::string nodal =
      kTwoShells + "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL, NODAL THICKNESS\n.2\n";
  const Deck deck = read(nodal + "*NODAL THICKNESS\nALL, .1\n3, .3\n");
  EXPECT_EQ(deck.mesh.shells.at(0).thickness.row(1), Eigen::RowVector4d(0.1, 0.3, 0.1, 0.1));
  EXPECT_THAT(refusal(nodal + "*NODAL THICKNESS\n1, .1\n"),
              HasSubstr("element 11: found no *NODAL THICKNESS of node 2"));
}

TEST(AbaqusShells, QuadraticOnesKeepTheirNodesAndReducedOnesAreSaid) {
  const Deck deck = read(kSheetNodes +
                         "*NODE\n21, .5, 0, 0\n22, 1, .5, 0\n23, .5, 1, 0\n24, 0, .5, 0\n"
                         "*ELEMENT, TYPE=S8R, ELSET=WALL\n11, 1, 2, 5, 4, 21, 22, 23, 24\n"
                         "*ELEMENT, TYPE=S4R, ELSET=WALL\n12, 2, 3, 6, 22\n" +
                         kShellSection);
  EXPECT_EQ(deck.mesh.shells.at(0).nodes.rows(), 1);
  EXPECT_EQ(deck.mesh.shells.at(0).nodes.cols() + deck.mesh.shells.at(1).nodes.cols(), 12);
  EXPECT_EQ(deck.mesh.node_ids.back(), 24);
  EXPECT_THAT(notes_of(deck), HasSubstr("S4R, S8R are read with full integration"));
}

TEST(AbaqusShells, TheNodeBetweenEqualCornersIsNoNodeOfTheMesh) {
  const Deck deck = read(kSheetNodes +
                         "*NODE\n21, .5, 0, 0\n22, 1, .5, 0\n23, .5, .5, 0\n24, 0, 0, 0\n"
                         "*ELEMENT, TYPE=S8R, ELSET=WALL\n11, 1, 2, 5, 1, 21, 22, 23, 24\n" +
                         kShellSection);
  EXPECT_EQ(deck.mesh.shells.at(0).type, FaceType::kTri6);
  EXPECT_EQ(std::ranges::count(deck.mesh.node_ids, 24), 0);
  EXPECT_EQ(deck.mesh.nodes.rows(), 6);
}

TEST(AbaqusShells, TheirNodesTurn) {
  Deck deck = read(kSheetDeck +
                   "*NSET, NSET=FIX\n1, 4\n*BOUNDARY\nFIX, 1, 6\n*STEP\n*STATIC\n"
                   "*CLOAD\n3, 6, 2.\n*END STEP\n");
  EXPECT_TRUE(deck.points.empty());
  EXPECT_EQ(deck.supports.at(0).dofs, kAllDofs);
  EXPECT_EQ(deck.steps.at(0).forces.at(0).direction, 5);
  const recipe::File file = recipe_of(deck).file;
  EXPECT_THAT(file.supports.at(0).directions, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(file.supports.at(0).selection.node_set, "FIX");
  EXPECT_EQ(file.loads.at(0).set, "on_node_3");
}

TEST(AbaqusShells, PressuresLeaveOnTheSideOfTheNormal) {
  const Deck deck = read(kSheetDeck +
                         "*SURFACE, NAME=TOP\nWALL, SPOS\n*SURFACE, NAME=LOW\nWALL, SNEG\n"
                         "*SURFACE, NAME=TWO\nWALL, S2\n*SURFACE, NAME=ONE\nWALL, S1\n"
                         "*STEP\n*STATIC\n*DLOAD\nWALL, P, 2.\nWALL, GRAV, 9., 0., 0., -1.\n"
                         "*DSLOAD\nTOP, P, 3.\n*END STEP\n");
  const auto first = [&](const std::string& name) {
    const auto nodes = deck.mesh.surface(name).faces.at(0).nodes.row(0);
    return std::vector<int32_t>(nodes.begin(), nodes.end());
  };
  EXPECT_THAT(first("TOP"), ElementsAre(0, 1, 4, 3));
  EXPECT_THAT(first("LOW"), ElementsAre(0, 3, 4, 1));
  EXPECT_EQ(first("TWO"), first("TOP"));
  EXPECT_EQ(first("ONE"), first("LOW"));
  ASSERT_EQ(deck.steps.at(0).pressures.size(), 2u);
  const Step::Pressure& along = deck.steps.at(0).pressures.at(0);
  EXPECT_EQ(along.value, 2.0);
  EXPECT_THAT(first(along.surface), ElementsAre(0, 3, 4, 1));
  EXPECT_EQ(deck.steps.at(0).acceleration, Eigen::Vector3d(0, 0, -9));
  EXPECT_THAT(refusal(kModel + "*STEP\n*STATIC\n*DLOAD\nEALL, P, 2.\n*END STEP\n"),
              HasSubstr("found a pressure P on EALL, which has elements that are no shells"));
  EXPECT_THAT(refusal(kSheetDeck + "*SURFACE, NAME=TOP\nWALL, S7\n"),
              HasSubstr("found face 'S7' of shells, expected SPOS, SNEG or E1 to E4"));
}

TEST(AbaqusShells, AWallBetweenTwoSolidsIsNoSkin) {
  const std::string deck =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "8, 0, 1, 1\n11, 2, 0, 0\n12, 3, 0, 0\n13, 3, 1, 0\n14, 2, 1, 0\n15, 2, 0, 1\n16, 3, 0, 1\n"
      "17, 3, 1, 1\n18, 2, 1, 1\n*ELEMENT, TYPE=C3D8, ELSET=CUBES\n1, 1, 2, 3, 4, 5, 6, 7, 8\n"
      "2, 11, 12, 13, 14, 15, 16, 17, 18\n*ELEMENT, TYPE=S4, ELSET=WALL\n21, 2, 11, 14, 3\n"
      "22, 5, 6, 7, 8\n*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n*DENSITY\n7.8E-9\n"
      "*SOLID SECTION, ELSET=CUBES, MATERIAL=STEEL\n" +
      kShellSection;
  EXPECT_THAT(refusal(deck), HasSubstr("found edge 2-11 of shell S4 21 on nodes of solids"));
  const Deck held = read(deck + "*BOUNDARY\n2, 4, 6\n3, 4, 6\n11, 4, 6\n14, 4, 6\n");
  EXPECT_THAT(held.mesh.shells.at(0).ids, ElementsAre(21));
}

TEST(AbaqusShells, OnesOnNodesOfSolidsAreHinges) {
  EXPECT_THAT(refusal(kModel +
                      "*NODE\n21, 0, 0, 2\n22, 1, 0, 2\n"
                      "*ELEMENT, TYPE=S4, ELSET=WALL\n50, 5, 6, 22, 21\n" +
                      kShellSection),
              HasSubstr("found edge 5-6 of shell S4 50 on nodes of solids, which do not turn: a "
                        "hinge"));
}

TEST(AbaqusShells, EdgesThatStandOnSolidsAreTied) {
  const std::string parts =
      kSheetDeck +
      "*NODE\n21, 0, -1, -2\n22, 2, -1, -2\n23, 2, 1, -2\n24, 0, 1, -2\n25, 0, -1, 0\n26, 2, -1, 0"
      "\n27, 2, 1, 0\n28, 0, 1, 0\n*ELEMENT, TYPE=C3D8, ELSET=BLOCK\n1, 21, 22, 23, 24, 25, 26, "
      "27, "
      "28\n*SOLID SECTION, ELSET=BLOCK, MATERIAL=STEEL\n*SURFACE, NAME=TOP\nBLOCK, S2\n"
      "*SURFACE, NAME=FOOT\nWALL, E1\n";
  Deck deck = read(parts +
                   "*SHELL TO SOLID COUPLING, CONSTRAINT NAME=weld, INFLUENCE DISTANCE=.3, "
                   "POSITION TOLERANCE=.1\nFOOT, TOP\n");
  ASSERT_EQ(deck.ties.size(), 1U);
  const Tie& tie = deck.ties[0];
  EXPECT_EQ(tie.name, "weld");
  EXPECT_EQ(tie.edge, "weld_edge");
  EXPECT_EQ(tie.master, "TOP");
  EXPECT_EQ(tie.distance, 0.1);
  std::vector<int32_t> numbers;
  for (const int32_t node : deck.mesh.node_set("weld_edge"))
    numbers.push_back(deck.mesh.node_ids[static_cast<size_t>(node)]);
  EXPECT_THAT(numbers, ::testing::UnorderedElementsAre(1, 2, 3));
  EXPECT_THAT(recipe_of(deck).text(), HasSubstr("edge = \"weld_edge\""));
  EXPECT_THAT(refusal(parts + "*SHELL TO SOLID COUPLING\nTOP, FOOT\n"), HasSubstr("surface"));
  EXPECT_THAT(refusal(parts + "*SHELL TO SOLID COUPLING\nTOP, TOP\n"),
              HasSubstr("found no surface 'TOP' of edges of shells, expected one"));
  EXPECT_THAT(refusal(parts + "*SURFACE, NAME=BAD\nWALL, E5\n"),
              HasSubstr("found edge E5 of shell S4 11, expected E1 to E4"));
  EXPECT_THAT(refusal(parts + "*SURFACE, NAME=BAD\nWALL, E1\nWALL, SPOS\n"),
              HasSubstr("surface BAD: found faces and edges of shells"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
