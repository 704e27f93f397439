// SPDX-License-Identifier: GPL-3.0-or-later
// Nodes and elements that a deck generates, its own axes and numbers by name.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::HasSubstr;

constexpr double kExact = 1e-14;  // rounding of coordinates near 1

Eigen::Vector3d at(const Deck& deck, int32_t id) { return deck.mesh.nodes.row(node(deck, id)); }

/// 2 x 2 x 3 cubes of edges 1, 1 and 2: a line, a face and a block of nodes, one cell copied.
const std::string kBlock =
    "*NODE\n1, 0, 0, 0\n3, 2, 0, 0\n*NGEN, NSET=FRONT\n1, 3, 1\n"
    "*NCOPY, CHANGE NUMBER=20, OLD SET=FRONT, SHIFT, NEW SET=BACK\n0, 2, 0\n\n"
    "*NFILL, NSET=FLOOR\nFRONT, BACK, 2, 10\n"
    "*NCOPY, CHANGE NUMBER=300, OLD SET=FLOOR, SHIFT, NEW SET=ROOF\n0, 0, 6\n"
    "*NFILL, NSET=ALL\nFLOOR, ROOF, 3, 100\n"
    "*ELEMENT, TYPE=C3D8\n1, 1, 2, 12, 11, 101, 102, 112, 111\n"
    "*ELGEN, ELSET=EALL\n1, 2, 1, 1, 2, 10, 10, 3, 100, 100\n";

TEST(AbaqusGenerate, ABlockOfOneCell) {
  const Deck deck = read(kBlock);
  EXPECT_EQ(deck.mesh.cell_count(), 12);
  EXPECT_EQ(deck.mesh.nodes.rows(), 36);
  EXPECT_EQ(at(deck, 322), Eigen::Vector3d(1, 2, 6));
  EXPECT_EQ(at(deck, 112), Eigen::Vector3d(1, 1, 2));
  EXPECT_EQ(deck.mesh.node_set("ROOF").size(), 9u);
  EXPECT_EQ(deck.mesh.regions, std::vector<std::string>{"solid"});  // *ELEMENT has no set
}

/// Where nodes without cells are: each has a mass, which makes it a point.
Eigen::Vector3d made(const std::string& cards, int32_t id) {
  const Deck deck = read(kCube + cards + "*ELEMENT, TYPE=MASS, ELSET=M\n900, " +
                         std::to_string(id) + "\n*MASS, ELSET=M\n1.\n");
  return deck.points.at(0).at;
}

TEST(AbaqusGenerate, ArcsHaveEqualAngles) {
  const std::string ends = "*NODE\n101, 2, 0, 1\n104, 0, 2, 1\n121, -2, 0, 1\n";
  const double c = std::sqrt(3.0);
  EXPECT_LT((made(ends + "*NGEN, LINE=C\n101, 104, 1, , 0, 0, 1\n", 102) - Eigen::Vector3d(c, 1, 1))
                .norm(),
            kExact);
  EXPECT_LT((made(ends + "*NGEN, LINE=C\n101, 121, 10, , 0, 0, 1, 0, 0, -1\n", 111) -
             Eigen::Vector3d(0, -2, 1))
                .norm(),
            kExact);
  EXPECT_THAT(refusal(kCube + ends + "*NGEN, LINE=C\n101, 121, 10, , 0, 0, 1\n"),
              HasSubstr("and the normal of the circle"));
}

TEST(AbaqusGenerate, AParabolaGoesThroughItsMiddle) {
  // Middle (1, 1): a quarter of the way at (0.5, 0.75).
  EXPECT_EQ(made("*NODE\n101, 0, 0, 0\n105, 2, 0, 0\n*NGEN, LINE=P\n101, 105, 1, , 1, 1, 0\n", 102),
            Eigen::Vector3d(0.5, 0.75, 0));
}

// Each distance is BIAS times the next one: below 1 the first are the shortest.
TEST(AbaqusGenerate, FilledNodesAreBiased) {
  const auto x = [&](const std::string& options, int32_t node, int intervals = 3) {
    const int last = 201 + intervals;
    const std::string ends =
        "*NODE, NSET=A\n201, 0, 0, 0\n*NODE, NSET=B\n" + std::to_string(last) + ", 7, 0, 0\n";
    return made(ends + "*NFILL, " + options + "\nA, B, " + std::to_string(intervals) + ", 1\n",
                node)[0];
  };
  EXPECT_NEAR(x("BIAS=0.5", 202), 1.0, kExact);  // 1, 2, 4
  EXPECT_NEAR(x("BIAS=0.5", 203), 3.0, kExact);
  EXPECT_NEAR(x("BIAS=2.", 202), 4.0, kExact);  // 4, 2, 1
  EXPECT_NEAR(x("BIAS=2.", 203), 6.0, kExact);
  // TWO STEP: 1, 2, 4 in halves.
  const double halves[] = {0.5, 1.0, 2.0, 3.0, 5.0};
  for (int k = 1; k < 6; ++k)
    EXPECT_NEAR(x("BIAS=0.5, TWO STEP", 201 + k, 6), halves[k - 1], kExact) << k;
  // Many intervals do not overflow.
  EXPECT_NEAR(x("BIAS=0.1", 201 + 1999, 2000), 7.0 * 0.1, 1e-12);
}

TEST(AbaqusGenerate, CopiesAreMovedSeveralTimesTurnedOrReflected) {
  const std::string one = "*NODE, NSET=A\n101, 1, 2, 3\n";
  const std::string copy = "*NCOPY, CHANGE NUMBER=10, OLD SET=A, ";
  EXPECT_EQ(made(one + copy + "SHIFT, MULTIPLE=3\n1, 0, 0\n", 131), Eigen::Vector3d(4, 2, 3));
  EXPECT_LT(
      (made(one + copy + "SHIFT\n0, 0, 1\n0, 0, 0, 0, 0, 1, 90\n", 111) - Eigen::Vector3d(-2, 1, 4))
          .norm(),
      kExact);
  EXPECT_EQ(made(one + copy + "REFLECT=POINT\n0, 0, 1\n", 111), Eigen::Vector3d(-1, -2, -1));
  EXPECT_EQ(made(one + copy + "REFLECT=LINE\n0, 0, 0, 0, 0, 5\n", 111), Eigen::Vector3d(-1, -2, 3));
  EXPECT_EQ(made(one + copy + "REFLECT=MIRROR\n0, 0, 1, 1, 0, 1\n0, 1, 1\n", 111),
            Eigen::Vector3d(1, 2, -1));
}

TEST(AbaqusGenerate, AxesOfSystemAndCurvedCoordinates) {
  // x' along y from (10, 0, 0): (1, 2, 3) is at (10 - 2, 1, 3).
  EXPECT_EQ(made("*SYSTEM\n10, 0, 0, 10, 1, 0\n*NODE\n101, 1, 2, 3\n", 101),
            Eigen::Vector3d(8, 1, 3));
  EXPECT_EQ(made("*SYSTEM\n10, 0, 0, 10, 1, 0\n*SYSTEM\n*NODE\n101, 1, 2, 3\n", 101),
            Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((made("*NODE, SYSTEM=C\n101, 2, 30, 5\n", 101) - Eigen::Vector3d(std::sqrt(3.0), 1, 5))
                .norm(),
            kExact);
  EXPECT_LT((made("*NODE, SYSTEM=S\n101, 2, 90, 30\n", 101) - Eigen::Vector3d(0, std::sqrt(3.0), 1))
                .norm(),
            kExact);
}

// The rows of Abaqus' figure of *NMAP, by hand.
TEST(AbaqusGenerate, MappedNodesHaveTheBasicCoordinatesOfTheirOwnOnes) {
  const std::string one = "*NODE, NSET=A\n101, 2, 90, 5\n*NMAP, NSET=A, TYPE=";
  const auto expect = [&](const std::string& cards, const Eigen::Vector3d& x) {
    EXPECT_LT((made(one + cards, 101) - x).norm(), 1e-13) << cards;
  };
  expect("RECTANGULAR\n10, 20, 30\n", {12, 110, 35});
  // x' = y and y' = -x from (1, 0, 0), the second coordinate a hundredth.
  expect("RECTANGULAR\n1, 0, 0, 1, 7, 0\n-3, 4, 0\n, .01, 1.\n", {1 - .9, 2, 5});
  // The axis along x from (1, 0, 0), the zero angle along y: at 90 degrees z.
  expect("CYLINDRICAL\n1, 0, 0, 4, 0, 0\n8, 3, 0\n", {6, 0, 2});
  // At half the angle and three times the radius.
  expect("CYLINDRICAL\n1, 0, 0, 4, 0, 0\n8, 3, 0\n3., .5\n",
         {6, 6 * std::sqrt(.5), 6 * std::sqrt(.5)});
  // The polar axis along x, the zero angle along y; 5 degrees out of the equator's plane, times 6.
  expect("SPHERICAL\n0, 0, 0, 1, 0, 0\n0, 1, 0\n1., 1., 6.\n", {1, 0, std::sqrt(3.0)});
  // Axes along x, x + y and z + y.
  expect("DIAMOND\n0, 0, 0, 1, 0, 0\n1, 1, 0, 0, 1, 1\n, .1\n",
         {2 + 9 * std::sqrt(.5), 14 * std::sqrt(.5), 5 * std::sqrt(.5)});
  EXPECT_THAT(refusal(kCube + "*NMAP, NSET=NALL, TYPE=BLENDED\n1, 0, 0, 0\n"),
              HasSubstr("deck.inp:14: *NMAP: TYPE=BLENDED is not supported, expected RECTANGULAR"));
  EXPECT_THAT(refusal(kCube + "*NMAP, NSET=NALL, TYPE=CYLINDRICAL\n0, 0, 0, 1, 0, 0\n2, 0, 0\n"),
              HasSubstr("its points lie on a line"));
  EXPECT_THAT(refusal(kCube + "*NMAP, NSET=NO, TYPE=RECTANGULAR\n1, 0, 0\n"),
              HasSubstr("found no set 'NO'"));
}

TEST(AbaqusGenerate, ParametersAreNumbersByName) {
  const std::string cards =
      "*PARAMETER\n# of the part\nwide = 2.5\nn = 3\nall = (wide + 0.5)*n - 2**2/sqrt(16.)  # 8\n"
      "*NODE\n101, <wide>, <n>, <all>\n";
  EXPECT_EQ(made(cards, 101), Eigen::Vector3d(2.5, 3, 8));
  EXPECT_THAT(refusal(kCube + "*PARAMETER\na = 1\n*NODE\n101, <b>, 0, 0\n"),
              HasSubstr("deck.inp:17: found no parameter 'b' (*PARAMETER)"));
  EXPECT_THAT(refusal(kCube + "*PARAMETER\na = 1/2\n"), HasSubstr("write 1. for 1"));
  EXPECT_THAT(refusal(kCube + "*PARAMETER\na = open('x')\n"), HasSubstr("expected an expression"));
}

TEST(AbaqusGenerate, WhatIsMissingIsNamed) {
  EXPECT_EQ(refusal(kCube + "*NGEN\n1, 200, 1\n"),
            "deck.inp:15: *NGEN: found no node 200 before it");
  EXPECT_EQ(refusal(kCube + "*NGEN\n1, 8, 3\n"),
            "deck.inp:15: found 1 to 8 by 3, expected a multiple of the step");
  EXPECT_EQ(refusal(kCube + "*ELGEN\n7, 2\n"), "deck.inp:15: *ELGEN: found no element 7 before it");
  EXPECT_THAT(refusal(kCube + "*NCOPY, CHANGE NUMBER=10, OLD SET=X, SHIFT\n1, 0, 0\n"),
              HasSubstr("found no set 'X'"));
  EXPECT_EQ(refusal(kCube + "*NFILL, BIAS=-2.\nNALL, NALL, 2, 100\n"),
            "deck.inp:14: *NFILL: found BIAS=-2., expected a ratio above 0");
  EXPECT_EQ(refusal(kCube + "*NFILL, BIAS=2., TWO STEP\nNALL, NALL, 3, 100\n"),
            "deck.inp:15: found 3 intervals with TWO STEP, expected an even number");
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
