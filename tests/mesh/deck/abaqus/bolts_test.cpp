// SPDX-License-Identifier: GPL-3.0-or-later
// *PRE-TENSION SECTION: the cut through a bolt.
#include <fmt/format.h>

#include <algorithm>

#include "mesh/deck/recipe/recipe.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::read;
using testing::refusal;

/// Columns of two unit cubes along x, one on the other: element 10 c + 1 below, 10 c + 2 above,
/// nodes 100 z + 10 y + x + 1; node 999 belongs to no element.
std::string columns(int count) {
  std::string text = "*NODE, NSET=NALL\n";
  for (int z = 0; z <= 2; ++z)
    for (int y = 0; y <= 1; ++y)
      for (int x = 0; x <= count; ++x)
        text += fmt::format("{}, {}, {}, {}\n", 100 * z + 10 * y + x + 1, x, y, z);
  text += "999, 0, 0, 1\n*ELEMENT, TYPE=C3D8, ELSET=EALL\n";
  for (int c = 0; c < count; ++c)
    for (int z = 0; z <= 1; ++z) {
      const int n = 100 * z + c + 1;
      text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", 10 * c + z + 1, n, n + 1, n + 11,
                          n + 10, n + 100, n + 101, n + 111, n + 110);
    }
  return text +
         "*MATERIAL, NAME=STEEL\n*ELASTIC\n2.1E5, 0.3\n*EXPANSION\n1e-5\n"
         "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n";
}

const std::string kCut = "*SURFACE, NAME=CUT\n2, S1\n";  // from above
const std::string kBolt = "*PRE-TENSION SECTION, SURFACE=CUT, NODE=999\n";
const std::string kNext = "*NSET, NSET=LAST\n1\n";  // the bolt has no data line

TEST(AbaqusBolt, TheCutCopiesItsNodesForTheSideOfItsSurface) {
  const Deck deck = read(columns(1) + kCut + kBolt + kNext);
  ASSERT_EQ(deck.bolts.size(), 1u);
  const Bolt& bolt = deck.bolts[0];
  ASSERT_EQ(deck.mesh.nodes.rows(), 16);
  EXPECT_EQ(bolt.reference, 16);
  EXPECT_EQ(bolt.direction, Eigen::Vector3d(0, 0, -1));  // outward
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(deck.mesh.node_ids[12 + i], 1000 + i);
    EXPECT_EQ(deck.mesh.nodes.row(12 + i), deck.mesh.nodes.row(4 + i));
  }
  EXPECT_EQ(nodes_of(deck.mesh.surface("CUT")), (std::vector<int32_t>{12, 13, 14, 15}));
  EXPECT_EQ(bolt.slave, "CUT");
  EXPECT_EQ(nodes_of(deck.mesh.surface(bolt.master)), (std::vector<int32_t>{4, 5, 6, 7}));
  const auto& cells = deck.mesh.cells.at(0).nodes;  // below, above
  EXPECT_EQ(cells.row(0).maxCoeff(), 7);
  EXPECT_EQ(cells.row(1).maxCoeff(), 15);
  EXPECT_EQ(cells.row(1).minCoeff(), 8);
}

TEST(AbaqusBolt, NodesThatSeveralFacesShareAreCopiedOnce) {
  // Two columns side by side: all cells above get copies, of shared nodes one.
  const Deck deck = read(columns(2) + "*SURFACE, NAME=CUT\n2, S1\n12, S1\n" + kBolt + kNext);
  ASSERT_EQ(deck.mesh.nodes.rows(), 18 + 6);
  EXPECT_EQ(nodes_of(deck.mesh.surface("CUT")).front(), 18);
}

TEST(AbaqusBolt, TheRecipeTightensItAlongItsDirection) {
  Deck deck = read(columns(1) + kCut + kBolt +
                   "0., 0., 2.\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nNALL, 20.\n"
                   "*STEP\n*STATIC\n*CLOAD\n999, 1, 7.\n*TEMPERATURE\nNALL, 30.\n*END STEP\n");
  EXPECT_TRUE((deck.mesh.fields.at("temperature_1").array() == 30.0).all());  // of copies too
  const std::string text = recipe_of(deck).text();
  EXPECT_NE(text.find("name = \"bolt_999\"\nslave = \"CUT\"\nmaster = \"CUT_other_side\"\n"
                      "direction = [0, 0, 1]\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("set = \"bolt_999\"\nforce = [0, 0, 7]\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("[[point]]"), std::string::npos) << text;
}

TEST(AbaqusBolt, WhatIsNoCutIsRefused) {
  const auto says = [](const std::string& text, const std::string& expected) {
    const std::string message = refusal(text + kNext);
    EXPECT_NE(message.find(expected), std::string::npos) << message;
  };
  says(columns(1) + "*SURFACE, NAME=CUT\n2, S2\n" + kBolt,
       "found a face on the outside (element 2), expected a cut through the bolt");
  says(columns(2) + kCut + kBolt,
       "element 1 is on both sides: the surface does not cut the bolt in two");
  says(columns(1) + "*SURFACE, NAME=CUT\n2, S1\n1, S2\n" + kBolt,
       "found both sides of a face in its surface (element 2), expected one side");
  says(columns(1) + kCut + "*PRE-TENSION SECTION, SURFACE=CUT, NODE=1\n",
       "found reference node 1, which has another use, expected one of no element");
  says(columns(1) + kBolt, "found no surface 'CUT'");
  says(columns(1) + "*SURFACE, NAME=CUT, TYPE=NODE\nNALL\n" + kBolt,
       "found a surface 'CUT' of nodes, expected one of faces");
  says(columns(1) + kCut + kBolt + "0., 0., 0.\n", "expected a direction of the bolt");
  says(columns(1) + kCut + "*PRE-TENSION SECTION, ELEMENT=2, NODE=999\n", "ELEMENT");
  says(columns(1) + kCut + kBolt + "*BOUNDARY\n999, 1, 1, -.1\n",
       "found a support of the reference node of *PRE-TENSION SECTION");
  says(columns(1) + kCut + kBolt + "*STEP\n*STATIC\n*CLOAD\n999, 2, 7.\n*END STEP\n",
       "found another direction of the reference node of *PRE-TENSION SECTION");
  says(columns(1) + kCut + kBolt + kBolt, "found node 101 in two cuts, expected one");
}

}  // namespace
}  // namespace clatter::mesh::deck
