// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes, elements, sets, surfaces, sections, instances.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>

#include "mesh/deck/abaqus/cells.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::ids_of;
using testing::kCube;
using testing::kCubeNodes;
using testing::kModel;
using testing::kSteel;
using testing::node;
using testing::read;
using testing::refusal;

struct Solid {
  const char* name;
  CellType type;
};
constexpr std::array<Solid, 10> kSolids = {{{"C3D4", CellType::kTet4},
                                            {"C3D5", CellType::kPyramid5},
                                            {"C3D6", CellType::kWedge6},
                                            {"C3D8", CellType::kHex8},
                                            {"C3D8I", CellType::kHex8},
                                            {"C3D8R", CellType::kHex8},
                                            {"C3D10", CellType::kTet10},
                                            {"C3D15", CellType::kWedge15},
                                            {"C3D20", CellType::kHex20},
                                            {"C3D20R", CellType::kHex20}}};

// Corners of the reference cells of cell.hpp, independently.
std::vector<Eigen::Vector3d> reference_corners(int count) {
  switch (count) {
    case 4:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case 5:
      return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
    case 6:
      return {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    default:
      return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  }
}

// Edges in the order of Abaqus' mid-side nodes, from its manual's drawings.
std::vector<std::array<size_t, 2>> abaqus_edges(int corners) {
  if (corners == 4) return {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};
  if (corners == 6) {
    return {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}};
  }
  return {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
          {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
}

std::string one_element(const Solid& solid) {
  const CellTraits& cell = traits(solid.type);
  std::vector<Eigen::Vector3d> x = reference_corners(cell.corners);
  if (cell.order == 2) {
    const std::vector<Eigen::Vector3d> corners = x;
    for (const auto& [a, b] : abaqus_edges(cell.corners))
      x.push_back((corners[a] + corners[b]) / 2);
  }
  std::string text = "*NODE\n", element = std::string("*ELEMENT, TYPE=") + solid.name + "\n77";
  for (size_t i = 0; i < x.size(); ++i) {
    text += std::to_string(100 + i) + "," + std::to_string(x[i][0]) + "," +
            std::to_string(x[i][1]) + "," + std::to_string(x[i][2]) + "\n";
    element += (i % 8 == 7 ? ",\n" : ",") + std::to_string(100 + i);
  }
  return text + element + "\n";
}

TEST(AbaqusMesh, MidSideNodesLieInTheMiddleOfTheirEdges) {
  for (const Solid& solid : kSolids) {
    const Deck deck = read(one_element(solid));
    ASSERT_EQ(deck.mesh.cells.size(), 1u);
    const CellBlock& block = deck.mesh.cells[0];
    const CellTraits& cell = traits(solid.type);
    ASSERT_EQ(block.type, solid.type) << solid.name;
    EXPECT_EQ(block.ids, std::vector<int32_t>{77});
    for (int i = 0; i < cell.corners; ++i) {
      EXPECT_EQ(deck.mesh.node_ids[block.nodes(0, i)], 100 + i) << solid.name;
    }
    if (cell.order == 1) continue;
    for (size_t e = 0; e < cell.edges.size(); ++e) {
      const Eigen::RowVector3d middle = (deck.mesh.nodes.row(block.nodes(0, cell.edges[e][0])) +
                                         deck.mesh.nodes.row(block.nodes(0, cell.edges[e][1]))) /
                                        2;
      const auto at = deck.mesh.nodes.row(block.nodes(0, cell.corners + static_cast<int>(e)));
      EXPECT_EQ((at - middle).norm(), 0.0) << solid.name << " edge " << e;  // halves are exact
    }
  }
}

// Faces as the manual lists them: S1, S2, ... by one-based corners.
TEST(AbaqusMesh, FaceNumbersAreThoseOfTheManualAndLookOutwards) {
  const std::map<int, std::vector<std::vector<int>>> manual = {
      {4, {{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}}},
      {5, {{1, 2, 3, 4}, {1, 5, 2}, {2, 5, 3}, {3, 5, 4}, {4, 5, 1}}},
      {6, {{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}}},
      {8, {{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}}}};
  for (const Solid& solid : kSolids) {
    const int corners = traits(solid.type).corners;
    Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
    for (const auto& x : reference_corners(corners)) centre += x.transpose() / corners;
    for (size_t s = 0; s < manual.at(corners).size(); ++s) {
      const Deck deck =
          read(one_element(solid) + "*SURFACE, NAME=F\n77, S" + std::to_string(s + 1) + "\n");
      const Surface& surface = deck.mesh.surface("F");
      ASSERT_EQ(surface.face_count(), 1);
      const FaceBlock& face = surface.faces[0];
      std::vector<int32_t> rows(face.nodes.data(), face.nodes.data() + traits(face.type).corners);
      const Eigen::RowVector3d a = deck.mesh.nodes.row(rows[0]);
      const Eigen::RowVector3d normal =
          Eigen::RowVector3d(deck.mesh.nodes.row(rows[1]) - a)
              .cross(Eigen::RowVector3d(deck.mesh.nodes.row(rows[2]) - a));
      EXPECT_GT(normal.dot(a - centre), 0.0) << solid.name << " S" << s + 1;
      std::vector<int32_t> ids = ids_of(deck, rows), wanted;
      for (const int corner : manual.at(corners)[s]) wanted.push_back(99 + corner);
      std::sort(ids.begin(), ids.end());
      std::sort(wanted.begin(), wanted.end());
      EXPECT_EQ(ids, wanted) << solid.name << " S" << s + 1;
      const int face_index = abaqus::face_of_number(solid.type, static_cast<int>(s) + 1);
      EXPECT_EQ(abaqus::number_of_face(solid.type, face_index), static_cast<int>(s) + 1);
    }
    EXPECT_NE(refusal(one_element(solid) + "*SURFACE, NAME=F\n77, S7\n").find("face S7"),
              std::string::npos);
  }
}

TEST(AbaqusMesh, FormulationsFollowTheTypeNames) {
  const auto formulation = [](const Solid& solid) {
    const Deck deck = read(one_element(solid));
    const auto& known = deck.regions.at(0).formulation;
    return known.contains(solid.type) ? known.at(solid.type) : Formulation::kDefault;
  };
  EXPECT_EQ(formulation(kSolids[3]), Formulation::kFull);
  EXPECT_EQ(formulation(kSolids[4]), Formulation::kIncompatible);
  EXPECT_EQ(formulation(kSolids[5]), Formulation::kReduced);
  EXPECT_EQ(formulation(kSolids[8]), Formulation::kFull);
  EXPECT_EQ(formulation(kSolids[9]), Formulation::kReduced);
  EXPECT_EQ(formulation(kSolids[6]), Formulation::kDefault);
}

TEST(AbaqusMesh, NodesWithoutElementsAreLeftOut) {
  const Deck deck = read(kModel);
  EXPECT_EQ(deck.mesh.nodes.rows(), 8);
  EXPECT_TRUE(deck.points.empty());
  EXPECT_EQ(deck.mesh.node_set("NALL").size(), 8u);
  EXPECT_FALSE(deck.sets.contains("NALL"));
}

TEST(AbaqusMesh, SetsAreMadeOfNumbersRangesAndOtherSets) {
  const Deck deck = read(kModel +
                         "*NSET, NSET=RANGE, GENERATE\n1, 7, 2\n2, 2000000000, 3\n"
                         "*NSET, NSET=range\n3, 3, 8\n"
                         "*NSET, NSET=ALLOF\nBot, top\n*NSET, NSET=OFCELLS, ELSET=EALL\n");
  EXPECT_EQ(ids_of(deck, deck.mesh.node_set("BOT")), (std::vector<int32_t>{1, 2, 3, 4}));
  EXPECT_EQ(ids_of(deck, deck.mesh.node_set("RANGE")), (std::vector<int32_t>{1, 2, 3, 5, 7, 8}));
  EXPECT_EQ(deck.mesh.node_set("ALLOF").size(), 8u);
  EXPECT_EQ(deck.mesh.node_set("OFCELLS").size(), 8u);
}

TEST(AbaqusMesh, SetsThatCannotBeAreRefused) {
  EXPECT_EQ(refusal(kModel + "*NSET, NSET=A\n1, 2,\n3, 99\n"), "deck.inp:26: found no node 99");
  EXPECT_EQ(refusal(kModel + "*NSET, NSET=A\nB\n*NSET, NSET=B\nA\n"),
            "deck.inp:27: node set A holds itself");
  EXPECT_EQ(refusal(kModel + "*NSET, NSET=A\nC\n"), "deck.inp:25: found no node set 'C'");
  EXPECT_NE(refusal(kModel + "*NSET, NSET=A, GENERATE\n5, 1\n").find("5 to 1"), std::string::npos);
  std::string deep = kModel + "*NSET, NSET=S0\n1\n";
  for (int i = 1; i < 100; ++i) {
    deep += "*NSET, NSET=S" + std::to_string(i) + "\nS" + std::to_string(i - 1) + "\n";
  }
  EXPECT_EQ(read(deep).mesh.node_sets.size(), 103u);  // resolved from below
  EXPECT_NE(refusal(deep + "*BOUNDARY\nS99, 1\n").find("more than 64 nested sets"),
            std::string::npos);
}

TEST(AbaqusMesh, NumbersWithTwoMeaningsAreRefused) {
  EXPECT_NE(refusal(kModel + "*NODE\n3, 7, 7, 7\n")
                .find("deck.inp:25: node 3: found another one with this number at deck.inp:4"),
            std::string::npos);
  EXPECT_EQ(read(kModel + "*NODE, NSET=AGAIN\n3, 1, 1, 0\n").mesh.node_set("AGAIN").size(), 1u);
  EXPECT_EQ(refusal(kModel + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 5\n"),
            "deck.inp:25: element 1: found another one with this number at deck.inp:13");
  EXPECT_EQ(refusal(kModel + "*ELEMENT, TYPE=C3D4\n2, 1, 2, 3, 55\n"),
            "deck.inp:25: found no node 55");
}

TEST(AbaqusMesh, HighNumbersTakeNoMemoryOfTheirOwn) {
  const Deck deck = read(
      "*NODE\n1,0,0,0\n2000000000,1,0,0\n2147483647,0,1,0\n7,0,0,1\n"
      "*ELEMENT, TYPE=C3D4\n2147483647, 1, 2000000000, 2147483647, 7\n"
      "*NSET, NSET=A, GENERATE\n1, 2147483647\n");
  EXPECT_EQ(deck.mesh.node_set("A").size(), 4u);
  EXPECT_EQ(deck.mesh.cells[0].ids[0], 2147483647);
}

const std::string kTwoCells =
    "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n5,1,1,1\n"
    "*ELEMENT, TYPE=C3D4, ELSET=A\n1,1,2,3,4\n*ELEMENT, TYPE=C3D4, ELSET=B\n2,2,3,4,5\n"
    "*MATERIAL, NAME=M\n*ELASTIC\n1,0\n*MATERIAL, NAME=N\n*ELASTIC\n2,0\n";

TEST(AbaqusMesh, EachSectionIsARegion) {
  const Deck deck = read(kTwoCells +
                         "*SOLID SECTION, ELSET=b, MATERIAL=N\n,\n"
                         "*SOLID SECTION, ELSET=A, MATERIAL=m\n");
  EXPECT_EQ(deck.mesh.regions, (std::vector<std::string>{"B", "A"}));
  EXPECT_EQ(deck.regions[0].material, "N");
  EXPECT_EQ(deck.regions[1].material, "M");
  ASSERT_EQ(deck.mesh.cells.size(), 2u);
  EXPECT_EQ(deck.mesh.cells[0].region, 1);
  EXPECT_EQ(deck.mesh.cells[0].ids[0], 1);
}

TEST(AbaqusMesh, EveryCellHasExactlyOneSection) {
  EXPECT_EQ(refusal(kTwoCells + "*SOLID SECTION, ELSET=A, MATERIAL=M\n"),
            "deck.inp:10: element 2 has no *SOLID SECTION");
  EXPECT_NE(refusal(kTwoCells + "*ELSET, ELSET=C\nA, B\n*SOLID SECTION, ELSET=C, MATERIAL=M\n"
                                "*SOLID SECTION, ELSET=A, MATERIAL=M\n")
                .find("element 1 has a section already: deck.inp:19"),
            std::string::npos);
  EXPECT_NE(refusal(kTwoCells + "*SOLID SECTION, ELSET=A, MATERIAL=X\n").find("no material 'X'"),
            std::string::npos);
}

TEST(AbaqusMesh, WithoutSectionsTheElementSetsAreRegions) {
  const Deck deck = read(kTwoCells);
  EXPECT_EQ(deck.mesh.regions, (std::vector<std::string>{"A", "B"}));
  EXPECT_EQ(deck.regions[0].material, "");
}

TEST(AbaqusMesh, MixedIntegrationInOneSectionIsRefused) {
  const std::string text = kCube + "*ELEMENT, TYPE=C3D8R, ELSET=EALL\n2,1,2,3,4,5,6,7,8\n" + kSteel;
  EXPECT_NE(refusal(text).find("deck.inp:15: element 2 is a C3D8R"), std::string::npos);
}

TEST(AbaqusMesh, ASurfaceOfElementsIsWhatTheyShowOutside) {
  const Deck deck = read(kTwoCells + "*SURFACE, NAME=OUT\nA,\n*SURFACE, NAME=ALL\nA\nB\n2, S1\n");
  EXPECT_EQ(deck.mesh.surface("OUT").face_count(), 3);
  EXPECT_EQ(deck.mesh.surface("ALL").face_count(),
            7);  // six outside, and the one given explicitly
  EXPECT_NE(refusal(kTwoCells + "*SURFACE, NAME=F\nA, SPOS\n").find("found face 'SPOS'"),
            std::string::npos);
}

const std::string kPart =
    "*PART, NAME=Block\n" + kCube +
    "*NSET, NSET=BOT\n1, 2, 3, 4\n*ORIENTATION, NAME=O\n1,0,0,0,1,0\n"
    "*SOLID SECTION, ELSET=EALL, MATERIAL=S, ORIENTATION=o\n*SURFACE, NAME=LID\nEALL, S2\n"
    "*END PART\n*ASSEMBLY, NAME=ASS\n*INSTANCE, NAME=one, PART=block\n*END INSTANCE\n";
const std::string kPartEnd = "*END ASSEMBLY\n*MATERIAL, NAME=S\n*ELASTIC\n1,0\n";

TEST(AbaqusParts, OneInstanceKeepsNumbersAndNames) {
  const Deck deck = read(kPart + "*NSET, NSET=TOP, INSTANCE=ONE\n5, 6\n" + kPartEnd +
                         "*BOUNDARY\nTOP, 1\none.3, 2\none.BOT, 3\n");
  EXPECT_EQ(deck.mesh.node_ids, (std::vector<int32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"EALL"});
  EXPECT_EQ(ids_of(deck, deck.mesh.node_set("TOP")), (std::vector<int32_t>{5, 6}));
  EXPECT_TRUE(deck.mesh.node_sets.contains("BOT"));
  EXPECT_TRUE(deck.mesh.surfaces.contains("LID"));
  EXPECT_EQ(deck.supports.size(), 3u);  // node 3 is fixed in y and z: x y z in three masks
}

TEST(AbaqusParts, InstancesAreMovedThenTurnedAndNumberedApart) {
  const Deck deck = read(kPart +
                         "*INSTANCE, NAME=two, PART=Block\n10, 0, 0\n10,0,0, 10,0,1, 90.\n"
                         "*END INSTANCE\n" +
                         kPartEnd);
  ASSERT_EQ(deck.mesh.nodes.rows(), 16);
  EXPECT_EQ(deck.mesh.node_ids[8], 101);  // its highest number is 10: a hundred on top
  EXPECT_EQ(deck.mesh.regions, (std::vector<std::string>{"one.EALL", "two.EALL"}));
  EXPECT_TRUE(deck.mesh.node_sets.contains("two.BOT"));
  EXPECT_TRUE(deck.mesh.surfaces.contains("two.LID"));
  // Node 2 of the part, (1 0 0): moved to (11 0 0), then rotated about (10 0 z) to (10 1 0).
  const Eigen::RowVector3d x = deck.mesh.nodes.row(node(deck, 102));
  EXPECT_LT((x - Eigen::RowVector3d(10, 1, 0)).norm(), 1e-14);  // cos(pi / 2) rounds
  const Eigen::Vector3d axis = deck.systems.at("two.O").axes.col(0);
  EXPECT_LT((axis - Eigen::Vector3d(0, 1, 0)).norm(), 1e-15);
  EXPECT_EQ(deck.regions[1].system, "two.O");
}

TEST(AbaqusParts, ReferencePointsOfTheAssemblyGetNumbersOfTheirOwn) {
  const Deck deck = read(
      kPart + "*NODE\n1, 5, 5, 5\n*NSET, NSET=RP\n1,\n*SURFACE, NAME=S, TYPE=NODE\n" +
      "one.BOT\n*COUPLING, CONSTRAINT NAME=C, REF NODE=RP, SURFACE=S\n*KINEMATIC\n" + kPartEnd);
  ASSERT_EQ(deck.points.size(), 1u);
  EXPECT_EQ(deck.points[0].id, 11);
  EXPECT_EQ(deck.points[0].at, Eigen::Vector3d(5, 5, 5));
  EXPECT_EQ(deck.sets.at("RP"), std::vector<NodeIndex>{8});
  EXPECT_EQ(deck.rigid.at(0).dependents, (std::vector<NodeIndex>{0, 1, 2, 3}));
}

TEST(AbaqusParts, MisplacedPartsAreRefused) {
  EXPECT_NE(refusal("*PART, NAME=P\n" + kCube).find("deck.inp:1: found *PART without *END PART"),
            std::string::npos);
  EXPECT_NE(refusal("*PART, NAME=P\n" + kCube + "*END PART\n").find("expected instances"),
            std::string::npos);
  EXPECT_NE(refusal("*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=X\n*END INSTANCE\n")
                .find("found no part 'X'"),
            std::string::npos);
  EXPECT_NE(refusal("*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=X\n*NODE\n1\n*END INSTANCE\n")
                .find("deck.inp:2: found no part 'X'"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::mesh::deck
