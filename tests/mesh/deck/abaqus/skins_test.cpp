// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of two dimensions or one beside the solids.
#include <gmock/gmock.h>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Two cubes, one upon the other, as Gmsh writes volumes, surfaces, curves and physical groups.
const std::string kGmsh =
    "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
    "8, 0, 1, 1\n9, 0, 0, 2\n10, 1, 0, 2\n11, 1, 1, 2\n12, 0, 1, 2\n"
    "*ELEMENT, type=T3D2, ELSET=Line1\n1, 1, 2\n2, 2, 3\n"
    "*ELEMENT, type=CPS4, ELSET=Surface1\n11, 1, 2, 3, 4\n"
    "*ELEMENT, type=CPS4, ELSET=Surface2\n12, 9, 10, 11, 12\n13, 5, 6, 7, 8\n"
    "*ELEMENT, type=C3D8, ELSET=Volume1\n21, 1, 2, 3, 4, 5, 6, 7, 8\n"
    "*ELEMENT, type=C3D8, ELSET=Volume2\n22, 5, 6, 7, 8, 9, 10, 11, 12\n";

TEST(AbaqusSkins, FacesOfSolidsAreSurfacesAndLinesNodeSets) {
  const Deck deck = read(kGmsh + "*ELSET, ELSET=clamp\n11\n");
  EXPECT_EQ(deck.mesh.surface("clamp").face_count(), 1);
  EXPECT_EQ(ids_of(deck, nodes_of(deck.mesh.surface("Surface1"))),
            (std::vector<int32_t>{1, 2, 3, 4}));
  EXPECT_EQ(deck.mesh.surface("Surface2").face_count(), 2);  // one of them between two regions
  EXPECT_EQ(ids_of(deck, deck.mesh.node_set("Line1")), (std::vector<int32_t>{1, 2, 3}));
  EXPECT_THAT(deck.mesh.regions, ElementsAre("Volume1", "Volume2"));
  ASSERT_EQ(deck.notes.size(), 2u);  // and that it has no *STEP
  EXPECT_THAT(deck.notes[1],
              HasSubstr("deck.inp:18: 3 CPS4: faces of solids, now the surfaces clamp, Surface1, "
                        "Surface2"));
}

TEST(AbaqusSkins, GroupsOfVolumesNameRegions) {
  const Deck one = read(kGmsh + "*ELSET, ELSET=block\n21, 22\n*ELSET, ELSET=lower\n21\n");
  EXPECT_THAT(one.mesh.regions, ElementsAre("lower", "Volume2"));
  const Deck all = read(kGmsh + "*ELSET, ELSET=block\n21, 22, 11\n");
  EXPECT_THAT(all.mesh.regions, ElementsAre("block"));
  EXPECT_EQ(all.mesh.surface("block").face_count(), 1);
}

TEST(AbaqusSkins, ThoseInsideARegionOrElsewhereAreLeftOutAndCounted) {
  const Deck deck = read(kGmsh +
                         "*ELSET, ELSET=block\n21, 22\n*NODE\n20, 5, 5, 5\n"
                         "*ELEMENT, TYPE=S3, ELSET=free\n30, 1, 2, 20\n");
  EXPECT_EQ(deck.mesh.surface("Surface2").face_count(), 1);
  EXPECT_FALSE(deck.mesh.surfaces.contains("free"));
  EXPECT_THAT(deck.notes.back(), HasSubstr("1 CPS4: inside a region, left out"));
  EXPECT_THAT(deck.notes.back(), HasSubstr("1 S3: not the face of a solid"));
}

TEST(AbaqusSkins, ShellsWithASectionAreRefusedWhereNoSolidHasTheirFace) {
  const std::string said = refusal(kModel +
                                   "*ELEMENT, TYPE=S4, ELSET=WALL\n50, 1, 2, 7, 8\n51, 1, 2, 7, 8\n"
                                   "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL\n2.\n");
  EXPECT_THAT(said,
              HasSubstr("deck.inp:25: found edge 1-2 of shell S4 50 on nodes of solids, which "
                        "do not turn: a hinge (2 shells have such nodes)"));
  EXPECT_THAT(refusal(kModel + "*ELEMENT, TYPE=S4R5, ELSET=WALL\n50, 1, 2, 9, 8\n"
                               "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL\n2.\n"),
              HasSubstr("1 elements S4R5 are shells or membranes beside the solids, which are not "
                        "read, expected S3 S3R S4 S4R S6 S8 S8R STRI65 with a *SHELL SECTION"));
}

TEST(AbaqusSkins, ASectionOnAFaceIsNamedWithItsMass) {
  const Deck deck = read(kModel +
                         "*ELEMENT, TYPE=S4, ELSET=WALL\n50, 1, 2, 3, 4\n"
                         "*SHELL SECTION, ELSET=WALL, MATERIAL=STEEL\n2.\n");
  EXPECT_EQ(deck.mesh.surface("WALL").face_count(), 1);
  EXPECT_THAT(deck.notes.back(), HasSubstr("deck.inp:26: *SHELL SECTION gives stiffness to faces "
                                           "of solids, 2 thick, 1.56e-08 of mass"));
}

TEST(AbaqusSkins, TheyMayBeInASurfaceARigidBodyAndANodeSet) {
  const Deck deck = read(kModel +
                         "*ELEMENT, TYPE=M3D4, ELSET=LID\n50, 5, 6, 7, 8\n"
                         "*SURFACE, NAME=UP\nLID, SPOS\n*NSET, NSET=UPPER, ELSET=LID\n"
                         "*RIGID BODY, ELSET=LID, REF NODE=9\n");
  EXPECT_EQ(ids_of(deck, nodes_of(deck.mesh.surface("UP"))), (std::vector<int32_t>{5, 6, 7, 8}));
  EXPECT_EQ(deck.mesh.node_set("UPPER").size(), 4u);
  EXPECT_EQ(deck.rigid.at(0).dependents.size(), 4u);
}

TEST(AbaqusSkins, BeamsAreRefusedWithTheWayOut) {
  EXPECT_THAT(
      refusal(kModel + "*ELEMENT, TYPE=B31, ELSET=B\n50, 8, 9\n"),
      HasSubstr("deck.inp:25: 1 elements B31 are beams or trusses without a *BEAM SECTION"));
}

TEST(AbaqusSolids, VariantsAreReadAsTheirNearestCounterpartWithALine) {
  struct Case {
    std::string type;
    CellType cell;
    Formulation formulation;
    std::string note;
  };
  for (const Case& one :
       {Case{"C3D8H", CellType::kHex8, Formulation::kFull, "is read as C3D8, without the pressure"},
        Case{"C3D8RH", CellType::kHex8, Formulation::kReduced, "is read as C3D8R, without"},
        Case{"C3D8S", CellType::kHex8, Formulation::kFull, "is read as C3D8, without improved"},
        Case{"C3D8IH", CellType::kHex8, Formulation::kIncompatible, "is read as C3D8I, without"},
        Case{"C3D8T", CellType::kHex8, Formulation::kFull, "is read as C3D8, without temp"}}) {
    std::string text = kModel;
    text.replace(text.find("TYPE=C3D8"), 9, "TYPE=" + one.type);
    const Deck deck = read(text);
    EXPECT_EQ(deck.mesh.cells.at(0).type, one.cell) << one.type;
    EXPECT_EQ(deck.regions.at(0).formulation.at(one.cell), one.formulation) << one.type;
    ASSERT_EQ(deck.notes.size(), 2u) << one.type;
    EXPECT_THAT(deck.notes[0] + deck.notes[1], HasSubstr("deck.inp:12: " + one.type)) << one.type;
    EXPECT_THAT(deck.notes[0] + deck.notes[1], HasSubstr(one.note)) << one.type;
  }
  EXPECT_THAT(refusal(kCubeNodes + "*ELEMENT, TYPE=C3D8P\n1, 1,2,3,4,5,6,7,8\n"),
              HasSubstr("element type C3D8P is not supported"));
}

// A hexahedron whose fourth and third node are one is a wedge: a triangle lies on its base, and a
// quadrilateral with the same corner twice is that triangle.
TEST(AbaqusSkins, OnACollapsedFaceOfAHexahedronAreSurfaces) {
  const std::string wedge =
      "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n"
      "*ELEMENT, TYPE=C3D8, ELSET=V\n1, 1, 2, 3, 3, 5, 6, 7, 7\n";
  const Deck deck = read(wedge +
                         "*ELEMENT, TYPE=S3, ELSET=FOOT\n11, 1, 2, 3\n"
                         "*ELEMENT, TYPE=S4, ELSET=TOP\n12, 5, 6, 7, 7\n"
                         "*ELEMENT, TYPE=S4, ELSET=SIDE\n13, 1, 2, 6, 5\n");
  EXPECT_EQ(ids_of(deck, nodes_of(deck.mesh.surface("FOOT"))), (std::vector<int32_t>{1, 2, 3}));
  EXPECT_EQ(ids_of(deck, nodes_of(deck.mesh.surface("TOP"))), (std::vector<int32_t>{5, 6, 7}));
  EXPECT_EQ(ids_of(deck, nodes_of(deck.mesh.surface("SIDE"))), (std::vector<int32_t>{1, 2, 5, 6}));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
