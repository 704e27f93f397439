// SPDX-License-Identifier: GPL-3.0-or-later
// Shells on the faces of solids.
#include <gmock/gmock.h>

#include "core/mesh/mesh.hpp"
#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using ::testing::HasSubstr;

// Unit cube of steel; grid 9 belongs to no cell.
const std::string kCube =
    "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\n"
    "GRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\nGRID,4,,0.,1.,0.\n"
    "GRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\nGRID,9,,0.,0.,2.\n"
    "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n";

TEST(NastranSkins, FacesOfSolidsAreTheSurfaceOfTheirProperty) {
  const auto deck = read_deck(kCube +
                              "CQUAD4,10,2,5,6,7,8\nCQUAD4,11,3,1,2,6,5\n"
                              "PSHELL,2,1,.5\nPCOMP,3,,,,,,,,+\n+,1,.1,0.,YES\nENDDATA\n");
  EXPECT_EQ(deck.mesh.surface("pid_2").face_count(), 1);
  EXPECT_EQ(mesh::nodes_of(deck.mesh.surface("pid_2")), (std::vector<int32_t>{4, 5, 6, 7}));
  EXPECT_EQ(deck.mesh.surface("pid_3").face_count(), 1);
  ASSERT_EQ(deck.notes.size(), 4u);  // the first is on PSOLID
  EXPECT_THAT(deck.notes[1],
              HasSubstr("t.bdf:14: 2 CQUAD4: faces of solids, now the surfaces pid_2, pid_3"));
  EXPECT_THAT(deck.notes[2], HasSubstr("t.bdf:16: PSHELL 2 gives stiffness to faces of solids, 0.5 "
                                       "thick, 3.9 of mass in the deck's units: left out"));
  EXPECT_THAT(deck.notes[3],
              HasSubstr("t.bdf:17: PCOMP 3 gives stiffness to faces of solids, 0.1 thick"));
}

TEST(NastranSkins, ALinearShellLiesOnAQuadraticFace) {
  std::string text = "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\n";
  const char* grids[] = {"0.,0.,0.", "1.,0.,0.", "0.,1.,0.", "0.,0.,1.", ".5,0.,0.",
                         ".5,.5,0.", "0.,.5,0.", "0.,0.,.5", ".5,0.,.5", "0.,.5,.5"};
  for (int i = 0; i < 10; ++i) text += "GRID," + std::to_string(i + 1) + ",," + grids[i] + "\n";
  text += "CTETRA,1,1,1,2,3,4,5,6,+\n+,7,8,9,10\n";
  const auto linear = read_deck(text + "CTRIA3,5,2,1,2,4\nPSHELL,2,1,.5\nENDDATA\n");
  EXPECT_EQ(mesh::nodes_of(linear.mesh.surface("pid_2")).size(), 6u);
  const auto full = read_deck(text + "CTRIA6,5,2,1,2,4,5,9,8\nPSHELL,2,1,.5\nENDDATA\n");
  EXPECT_EQ(mesh::nodes_of(full.mesh.surface("pid_2")),
            mesh::nodes_of(linear.mesh.surface("pid_2")));
}

TEST(NastranSkins, OthersBetweenSolidsAreRefusedUnlessTheDeckHasNoProperties) {
  const std::string wall = "CQUAD4,10,2,1,2,9,5\n", across = "CQUAD4,10,2,1,2,7,8\n";
  EXPECT_THAT(refusal(kCube + across + "PSHELL,2,1,.5,1\nENDDATA\n"),
              HasSubstr("t.bdf:14: found edge 1-2 of shell CQUAD4 10 on nodes of solids"));
  std::string bare = kCube;
  bare.erase(0, bare.find("GRID"));
  const auto deck = read_deck(bare + wall + "ENDDATA\n");
  EXPECT_THAT(deck.notes.at(0), HasSubstr("1 CQUAD4: not the face of a solid, left out"));
  EXPECT_EQ(read_deck(kCube + wall + "ENDDATA\n", {"CQUAD4"}).ignored.at("CQUAD4"), 1);
}

}  // namespace
}  // namespace clatter::test
