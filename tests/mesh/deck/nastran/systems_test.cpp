// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using Eigen::Vector3d;
using mesh::deck::Deck;
using mesh::deck::System;
using testing::HasSubstr;

// Rounding of a few operations on numbers of size 10.
constexpr double kSystemsRounding = 1e-14;

// Position of grid 9, given in `grid`, with `cards` in the deck.
Vector3d position(const std::string& cards, const std::string& grid) {
  const Deck deck = read_deck(kTet + cards + "CONM2,1,9,,1.\n" + grid);
  return deck.points.at(0).at;
}

TEST(NastranSystems, Cord2rTurnsAndShifts) {
  // Origin (1, 2, 3), z along basic x, x along basic y, so y along basic z.
  const std::string cord = "CORD2R,5,,1.,2.,3.,2.,2.,3.,+\n+,1.,3.,3.\n";
  EXPECT_LT((position(cord, "GRID,9,5,10.,20.,30.\n") - Vector3d(31, 12, 23)).norm(),
            kSystemsRounding);
}

TEST(NastranSystems, Cord2cCountsDegreesFromItsXzPlane) {
  const std::string cord = "CORD2C,5,,1.,2.,3.,2.,2.,3.,+\n+,1.,3.,3.\n";
  // r = 2 at 90 degrees: along its y, which is basic z.
  EXPECT_LT((position(cord, "GRID,9,5,2.,90.,30.\n") - Vector3d(31, 2, 5)).norm(),
            kSystemsRounding);
  EXPECT_LT((position(cord, "GRID,9,5,2.,30.,0.\n") - Vector3d(1, 2 + std::sqrt(3.0), 4)).norm(),
            kSystemsRounding);
}

TEST(NastranSystems, Cord2sOpensThetaFromItsZAxis) {
  const std::string cord = "CORD2S,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  EXPECT_LT((position(cord, "GRID,9,5,2.,0.,77.\n") - Vector3d(0, 0, 2)).norm(), kSystemsRounding);
  EXPECT_LT((position(cord, "GRID,9,5,2.,90.,0.\n") - Vector3d(2, 0, 0)).norm(), kSystemsRounding);
  EXPECT_LT((position(cord, "GRID,9,5,2.,90.,90.\n") - Vector3d(0, 2, 0)).norm(), kSystemsRounding);
  EXPECT_LT((position(cord, "GRID,9,5,2.,30.,180.\n") - Vector3d(-1, 0, std::sqrt(3.0))).norm(),
            kSystemsRounding);
}

TEST(NastranSystems, ReferencesAreFollowedInAnyOrder) {
  // 7 in 6 in 5: each turns by 90 degrees about z, R (x, y) = (-y, x), and shifts by (1, 0).
  const std::string turn = ",1.,0.,0.,1.,0.,1.,+\n+,1.,1.,0.\n";
  const std::string cords = "CORD2R,7,6" + turn + "CORD2R,6,5" + turn + "CORD2R,5,0" + turn;
  // (1, 0) + R (1, 0) + R^2 (1, 0) + R^3 (2, 3)
  const Vector3d expected(1 + 0 - 1 + 3, 0 + 1 + 0 - 2, 4);
  EXPECT_LT((position(cords, "GRID,9,7,2.,3.,4.\n") - expected).norm(), kSystemsRounding);
}

TEST(NastranSystems, Cord1RefersToGridsThatMayHaveSystemsThemselves) {
  // Grids 2, 3, 4 of the tetrahedron: origin (1,0,0), z toward (0,1,0), xz plane through (0,0,1).
  const std::string cord = "CORD1R,5,2,3,4\n";
  const double r = std::sqrt(2.0);
  EXPECT_LT((position(cord, "GRID,9,5,0.,0.,1.\n") - Vector3d(1 - 1 / r, 1 / r, 0)).norm(),
            kSystemsRounding);
  // Two systems on one card, the second with grids in the first.
  const std::string two =
      "CORD1C,5,1,4,2,6,21,22,23\nGRID,21,5,1.,90.,0.\nGRID,22,5,1.,90.,1.\nGRID,23,5,2.,90.,0.\n";
  // Origin (0,1,0), z along z, x along y; r = 1 at 0 degrees is one more along y.
  EXPECT_LT((position(two, "GRID,9,6,1.,0.,0.\n") - Vector3d(0, 2, 0)).norm(), kSystemsRounding);
}

TEST(NastranSystems, CyclesAndMissingOnesAreRefused) {
  const std::string rest = ",0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  EXPECT_THAT(refusal(kTet + "CORD2R,5,6" + rest + "CORD2R,6,5" + rest),
              HasSubstr("coordinate system 5 refers to itself"));
  EXPECT_THAT(refusal(kTet + "CORD2R,5,5" + rest),
              HasSubstr("t.bdf:8: coordinate system 5 refers"));
  EXPECT_THAT(refusal(kTet + "CORD1R,5,9,2,3\nGRID,9,5,0.,0.,0.\n"), HasSubstr("refers to itself"));
  EXPECT_THAT(refusal(kTet + "CORD2R,5,8" + rest), HasSubstr("found no system 8"));
  EXPECT_THAT(refusal(kTet + "CORD1R,5,1,2,30\n"), HasSubstr("found no GRID 30"));
  EXPECT_THAT(refusal(kTet + "GRID,9,4,0.,0.,0.\n"),
              HasSubstr("t.bdf:8: found no coordinate system 4"));
  EXPECT_THAT(refusal(kTet + "CORD2R,5,0" + rest + "CORD2C,5,0" + rest),
              HasSubstr("found a second coordinate system 5"));
}

TEST(NastranSystems, PointsThatDefineNoAxesAreRefused) {
  for (const char* points :
       {"0.,0.,0.,0.,0.,0.,+\n+,1.,0.,0.\n", "0.,0.,0.,0.,0.,1.,+\n+,0.,0.,5.\n",
        "0.,0.,0.,0.,0.,1.\n", "0.,0.,0.,1.,0.,0.,+\n+,1.,1.-14,0.\n"}) {
    EXPECT_THAT(refusal(kTet + "CORD2R,5,0," + points), HasSubstr("define no axes")) << points;
  }
}

TEST(NastranSystems, GrdsetFillsBlankFieldsOnly) {
  const std::string cord = "CORD2R,5,0,1.,0.,0.,1.,0.,1.,+\n+,2.,0.,0.\n";
  const Deck deck =
      read_deck("PSOLID,1,1\nMAT1,1,210.,,.3\nCTETRA,1,1,1,2,3,4\n" + cord +
                "GRID,1,,0.,0.,0.\nGRID,2,0,1.,0.,0.,0,0\nGRID,3,,0.,1.,0.\nGRID,4,,0.,0.,1.,,2\n"
                "GRDSET,,5,,,,5,13\n");
  EXPECT_EQ(deck.mesh.nodes(0, 0), 1.0);  // in system 5
  EXPECT_EQ(deck.mesh.nodes(1, 0), 1.0);  // zero is the basic system
  ASSERT_EQ(deck.supports.size(), 2u);    // 13 of grids 1 and 3, 2 of grid 4, none of grid 2
  EXPECT_EQ(deck.supports[0].system, "cord_5");
  EXPECT_EQ(deck.systems.at("cord_5").origin, Vector3d(1, 0, 0));
  EXPECT_EQ(deck.systems.at("cord_5").kind, System::Kind::kRectangular);
}

}  // namespace
}  // namespace clatter::test
