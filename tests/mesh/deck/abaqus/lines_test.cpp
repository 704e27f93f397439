// SPDX-License-Identifier: GPL-3.0-or-later
// Files, lines, keywords, numbers.
#include <fmt/format.h>

#include <fstream>

#include "tests/mesh/deck/abaqus/support.hpp"
#include "tests/mesh/support.hpp"
#include "tests/refusal.hpp"

namespace clatter::mesh::deck {
namespace {

using testing::kCube;
using testing::kCubeNodes;
using testing::kModel;
using testing::kSteel;
using testing::read;
using testing::refusal;

TEST(AbaqusLines, CaseBlanksCommentsAndEmptyLinesDoNotMatter) {
  const Deck deck = read(
      "** a comment\n\n*heading\n anything, at all\r\n*NoDe , nSet = n 1\n 1 , 0. , 0, 0 \n"
      "**\n2,1,,\n\t3,0,1,0\n4,0,0,1,\n*element,TYPE=c3d4,elset=E\n1,1,2,3,4\n"
      "*Material, name=m\n*Elastic\n1,.3\n*SOLIDSECTION,MATERIAL=M,ELSET=e\n");
  EXPECT_EQ(deck.mesh.nodes.rows(), 4);
  EXPECT_EQ(deck.mesh.node_set("n 1").size(), 4u);
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"E"});
  EXPECT_EQ(deck.regions[0].material, "m");
}

TEST(AbaqusLines, AKeywordContinuesAfterACommaWhenParametersFollow) {
  const Deck deck =
      read(kCubeNodes + "*ELEMENT, TYPE=C3D8,\n** between\n ELSET=EALL\n1,1,2,3,4,5,6,7,8\n" +
           kSteel + "*BOUNDARY,\nBOT, 1, 3\n*STEP,\n*FREQUENCY,\n5\n*END STEP\n");
  EXPECT_EQ(deck.mesh.regions[0], "EALL");
  ASSERT_EQ(deck.supports.size(), 1u);
  EXPECT_EQ(deck.steps.at(0).modes, 5);
}

TEST(AbaqusLines, AnElementMaySpanSeveralLines) {
  const Deck deck = read(kCubeNodes + "*ELEMENT, TYPE=C3D8\n1,1,2,3,\n4,5,6\n7,8\n");
  EXPECT_EQ(deck.mesh.cell_count(), 1);
}

TEST(AbaqusLines, TooManyNodesAreRefusedUnlessTheUserIgnoresThem) {
  const std::string text = kCubeNodes + "*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8,9,10,\n";
  EXPECT_NE(refusal(text).find("deck.inp:13: found more than the 8 nodes"), std::string::npos);
  const Deck deck = read(text, {"extra nodes"});
  EXPECT_EQ(deck.mesh.nodes.rows(), 8);
  EXPECT_EQ(deck.ignored.at("EXTRA NODES"), 1);
}

TEST(AbaqusLines, RefusalsNameFileLineAndWhatWasFound) {
  EXPECT_EQ(refusal("*NODE\n1,0,0,zero\n"), "deck.inp:2: found 'zero', expected a coordinate");
  EXPECT_EQ(refusal("*NODE\n-1,0,0,0\n"),
            "deck.inp:2: found '-1', expected the number of a node (1 to 2147483647)");
  EXPECT_EQ(refusal("1, 2\n").substr(0, 11), "deck.inp:1:");
  EXPECT_EQ(refusal(kModel + "*GASKET SECTION, ELSET=S\n1.\n"),
            "deck.inp:24: keyword *GASKET SECTION is not supported; ignore = [\"*GASKET SECTION\"] "
            "skips it with its data lines and its stiffness: [[spring]] or [[tie]] of the recipe "
            "replace it");
  EXPECT_NE(refusal(kCubeNodes + "*ELEMENT, TYPE=CONN2D2\n1,1,2\n")
                .find("deck.inp:12: element type CONN2D2 is not supported; ignore = [\"CONN2D2\"]"),
            std::string::npos);
  EXPECT_NE(refusal(kCubeNodes + "*ELEMENT, TYPE=S4\n1,1,2,3,4\n").find("1 S4"), std::string::npos);
  EXPECT_NE(refusal(kModel + "*BOUNDARY, SUBMODEL\n1, 1\n").find("the parameter SUBMODEL"),
            std::string::npos);
  EXPECT_NE(refusal(kCubeNodes + "*ELEMENT, TYPE=C3D8\n1,1,2,3\n").find("found 3 nodes"),
            std::string::npos);
}

TEST(AbaqusLines, WhatTheUserIgnoresIsCountedAndItsDataSkipped) {
  const Deck deck =
      read(kCube + "*ELEMENT, TYPE=S4, ELSET=SHELLS\n2,1,2,3,4\n3,5,6,\n7,8\n" + kSteel +
               "*Shell Section, ELSET=SHELLS, MATERIAL=X\n1.\n" + "*ELSET, ELSET=MIXED\n1, 2, 3\n",
           {"s4", "*SHELL section"});
  EXPECT_EQ(deck.mesh.cell_count(), 1);
  EXPECT_EQ(deck.ignored.at("S4"), 2);
  EXPECT_EQ(deck.ignored.at("*SHELL SECTION"), 1);
}

TEST(AbaqusLines, IncludesNestRelativeToTheIncludingFile) {
  const mesh::testing::Folder folder;
  std::filesystem::create_directories(folder / "sub");
  std::ofstream(folder / "sub/nodes.inp") << kCubeNodes;
  std::ofstream(folder / "sub/all.inp") << "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=C3D8, "
                                           "ELSET=EALL\n1,1,2,3,4,5,6,7,8\n";
  std::ofstream(folder / "main.inp") << "*include, input=sub/all.inp\n" << kSteel << "*BAD\n";
  try {
    read_abaqus(folder / "main.inp", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("main.inp:12: keyword *BAD"), std::string::npos)
        << error.what();
  }
  const Deck deck = read_abaqus(folder / "main.inp", {{"*BAD"}});
  EXPECT_EQ(deck.mesh.name, "main");
  EXPECT_EQ(deck.mesh.cell_count(), 1);
  ASSERT_EQ(deck.files.size(), 3u);
  EXPECT_TRUE(deck.files[2].ends_with("nodes.inp"));
}

TEST(AbaqusLines, ATableMayComeFromASeparateFile) {
  const mesh::testing::Folder folder;
  std::ofstream(folder / "nodes.txt") << "1,0,0,0\n2,1,0,0\n3,0,1,0\n";
  std::ofstream(folder / "main.inp")
      << "*NODE, INPUT=nodes.txt\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n";
  EXPECT_EQ(read_abaqus(folder / "main.inp", {}).mesh.nodes.rows(), 4);
}

TEST(AbaqusLines, IncludesThatAreMissingOrIncludeThemselvesAreRefused) {
  const mesh::testing::Folder folder;
  std::ofstream(folder / "a.inp") << "*INCLUDE, INPUT=b.inp\n";
  std::ofstream(folder / "b.inp") << "*INCLUDE, INPUT=a.inp\n";
  std::ofstream(folder / "gone.inp") << "\n*INCLUDE, INPUT=nowhere.inp\n";
  std::ofstream(folder / "device.inp") << "*INCLUDE, INPUT=/dev/zero\n";
  const auto message = [&](const std::string& name) {
    try {
      read_abaqus(folder / name, {});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("read");
  };
  EXPECT_NE(message("a.inp").find("b.inp:1: *INCLUDE 'a.inp': this file includes itself"),
            std::string::npos);
  EXPECT_NE(message("gone.inp").find("gone.inp:2: *INCLUDE 'nowhere.inp': found no such file"),
            std::string::npos);
  EXPECT_NE(message("device.inp").find("found no such file"), std::string::npos);
  test::expect_parts(test::refusal_of<FileError>([&] { read_abaqus(folder / "none.inp", {}); }),
                     {"none.inp: no such file"});
}

TEST(AbaqusLines, SixtyNestedFilesAreAccepted) {
  const mesh::testing::Folder folder;
  for (int i = 0; i < 70; ++i) {
    std::ofstream(folder / fmt::format("{}.inp", i))
        << fmt::format("*INCLUDE, INPUT={}.inp\n", i + 1);
  }
  std::ofstream(folder / "70.inp") << "";
  try {
    read_abaqus(folder / "0.inp", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("63.inp:1: found *INCLUDE more than 64 files deep"),
              std::string::npos)
        << error.what();
  }
}

TEST(AbaqusLines, ALineOfTenMegabytesIsRefused) {
  const mesh::testing::Folder folder;
  std::ofstream(folder / "long.inp") << "*HEADING\n" << std::string(10'000'000, 'x') << "\n";
  try {
    read_abaqus(folder / "long.inp", {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("long.inp:2: found a line"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace clatter::mesh::deck
