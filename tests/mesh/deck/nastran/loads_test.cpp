// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mesh/deck/nastran/support.hpp"

namespace clatter::test {
namespace {

using Eigen::Vector3d;
using mesh::FaceType;
using mesh::deck::Deck;
using mesh::deck::Step;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr double kLoadsRounding = 1e-14;  // of a few operations on numbers of size 10

Vector3d total(const Step& step, mesh::deck::NodeIndex node_index, int base = 0) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& force : step.forces) {
    const int k = force.direction - base;
    if (force.node_index == node_index && k >= 0 && k < 3) sum[k] += force.value;
  }
  return sum;
}

TEST(NastranLoads, ForcesAreScaledAndTurned) {
  const std::string cord = "CORD2C,5,0,0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  const Deck deck = read_deck(kTet + cord + "FORCE,3,2,,10.,.6,0.,-.8\nFORCE,3,3,5,2.,1.,.5,0.\n");
  ASSERT_THAT(deck.steps, SizeIs(1));
  EXPECT_EQ(deck.steps[0].name, "load_3");
  EXPECT_EQ(deck.steps[0].kind, Step::Kind::kNone);
  EXPECT_LT((total(deck.steps[0], 1) - Vector3d(6, 0, -8)).norm(), kLoadsRounding);
  // Grid 3 at (0, 1, 0): r along y, theta along -x.
  EXPECT_LT((total(deck.steps[0], 2) - Vector3d(-1, 2, 0)).norm(), kLoadsRounding);
}

TEST(NastranLoads, OnTheAxisTheAngleIsZero) {
  const std::string points = ",0.,0.,0.,0.,0.,1.,+\n+,1.,0.,0.\n";
  const Deck deck = read_deck(kTet + "CORD2C,5,0" + points + "CORD2S,6,0" + points +
                              "FORCE,3,4,5,1.,1.,2.,3.\nFORCE,3,1,6,1.,1.,2.,3.\n");
  EXPECT_EQ(total(deck.steps[0], 3), Vector3d(1, 2, 3));   // r, theta, z
  EXPECT_EQ(total(deck.steps[0], 0), Vector3d(1, 3, -2));  // r along x, theta downward, phi along y
}

TEST(NastranLoads, MomentsNeedAPoint) {
  const std::string point = "GRID,9,,3.,4.,5.\nRBE2,7,9,123456,1\n";
  const Deck deck = read_deck(kTet + point + "MOMENT,3,9,,10.,0.,0.,2.\n");
  EXPECT_EQ(total(deck.steps[0], 4, 3), Vector3d(0, 0, 20));
  EXPECT_THAT(refusal(kTet + "MOMENT,3,1,,10.,0.,0.,2.\n"),
              HasSubstr("node 1 of solids has no rotations"));
  EXPECT_THAT(refusal(kTet + "GRID,9\nFORCE,3,9,,10.,0.,0.,2.\n"),
              HasSubstr("t.bdf:9: FORCE: grid 9 belongs to no solid"));
}

TEST(NastranLoads, LoadSumsSetsWithTheirFactors) {
  const Deck deck = read_deck("SOL 101\nCEND\nLOAD = 8\nBEGIN BULK\n" + kTet +
                              "FORCE,3,2,,1.,1.,0.,0.\nFORCE,4,2,,1.,0.,1.,0.\n"
                              "GRAV,5,,9.81,0.,0.,-1.\nLOAD,8,2.,1.,3,3.,4,-1.,5\n");
  ASSERT_THAT(deck.steps, SizeIs(1));
  EXPECT_EQ(deck.steps[0].kind, Step::Kind::kStatic);
  EXPECT_EQ(total(deck.steps[0], 1), Vector3d(2, 6, 0));
  EXPECT_EQ(deck.steps[0].acceleration, Vector3d(0, 0, 19.62));
  EXPECT_THAT(refusal(kTet + "LOAD,8,2.,1.,3\n"), HasSubstr("found no loads of set 3"));
  EXPECT_THAT(refusal("CEND\nLOAD=3\nBEGIN BULK\n" + kTet), HasSubstr("found no loads of set 3"));
}

TEST(NastranLoads, WithoutCaseControlEachLoadOnTopIsAStep) {
  const Deck deck =
      read_deck(kTet + "FORCE,3,2,,1.,1.,0.,0.\nFORCE,4,2,,1.,0.,1.,0.\nLOAD,8,2.,1.,3\n");
  ASSERT_THAT(deck.steps, SizeIs(2));
  EXPECT_EQ(deck.steps[0].name, "load_4");
  EXPECT_EQ(deck.steps[1].name, "load_8");
}

// Nodes of the only face of surface `name`, as GRID numbers.
std::vector<int32_t> face_of(const Deck& deck, const std::string& name) {
  const auto& surface = deck.mesh.surface(name);
  EXPECT_EQ(surface.face_count(), 1);
  std::vector<int32_t> ids;
  for (Eigen::Index i = 0; i < surface.faces[0].nodes.cols(); ++i) {
    ids.push_back(deck.mesh.node_ids[surface.faces[0].nodes(0, i)]);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

TEST(NastranPressure, OnATetrahedronG4IsTheCornerThatIsNotOnTheFace) {
  const Deck deck = read_deck(kTet + "PLOAD4,3,1,5.,,,,1,3\n");
  EXPECT_THAT(face_of(deck, "pload4_3"), ElementsAre(1, 2, 4));
  ASSERT_THAT(deck.steps, SizeIs(1));
  ASSERT_THAT(deck.steps[0].pressures, SizeIs(1));
  EXPECT_EQ(deck.steps[0].pressures[0].surface, "pload4_3");
  EXPECT_EQ(deck.steps[0].pressures[0].value, 5.0);
  // Outward: the face 1 2 4 lies in y = 0 and points along -y.
  const auto& nodes = deck.mesh.surface("pload4_3").faces[0].nodes;
  const Vector3d a = deck.mesh.nodes.row(nodes(0, 0)), b = deck.mesh.nodes.row(nodes(0, 1)),
                 c = deck.mesh.nodes.row(nodes(0, 2));
  EXPECT_LT((b - a).cross(c - a)[1], 0.0);
}

TEST(NastranPressure, QuadranglesAreNamedByADiagonal) {
  std::string deck;
  const int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  for (int i = 0; i < 8; ++i) {
    deck += "GRID," + std::to_string(i + 1) + ",," + std::to_string(at[i][0]) + ".," +
            std::to_string(at[i][1]) + ".," + std::to_string(at[i][2]) + ".\n";
  }
  const std::string hex = deck + "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n";
  EXPECT_THAT(face_of(read_deck(hex + "PLOAD4,3,1,5.,,,,5,7\n"), "pload4_3"),
              ElementsAre(5, 6, 7, 8));
  EXPECT_THAT(face_of(read_deck(hex + "PLOAD4,3,1,5.,,,,6,1\n"), "pload4_3"),
              ElementsAre(1, 2, 5, 6));
  EXPECT_THAT(refusal(hex + "PLOAD4,3,1,5.,,,,1,2\n"), HasSubstr("define no face of cell 1"));
  EXPECT_THAT(refusal(hex + "PLOAD4,3,1,5.,,,,1,7\n"), HasSubstr("define no face of cell 1"));
  EXPECT_THAT(refusal(hex + "PLOAD4,3,1,5.,,,,1\n"), HasSubstr("define no face of cell 1"));

  const std::string wedge = deck + "CPENTA,1,1,1,2,3,5,6,7\n";
  EXPECT_THAT(face_of(read_deck(wedge + "PLOAD4,3,1,5.,,,,5\n"), "pload4_3"), ElementsAre(5, 6, 7));
  EXPECT_THAT(face_of(read_deck(wedge + "PLOAD4,3,1,5.,,,,1,6\n"), "pload4_3"),
              ElementsAre(1, 2, 5, 6));

  const std::string pyramid = deck + "CPYRAM,1,1,1,2,3,4,5\n";
  EXPECT_THAT(face_of(read_deck(pyramid + "PLOAD4,3,1,5.,,,,1,3\n"), "pload4_3"),
              ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(face_of(read_deck(pyramid + "PLOAD4,3,1,5.,,,,2,1\n"), "pload4_3"),
              ElementsAre(1, 2, 5));
  EXPECT_THAT(refusal(pyramid + "PLOAD4,3,1,5.,,,,1,5\n"), HasSubstr("define no face of cell 1"));
}

TEST(NastranPressure, ValuesThatDifferGetSurfacesOfTheirOwn) {
  const Deck deck =
      read_deck("CEND\nLOAD=8\nBEGIN BULK\n" + kTet +
                "PLOAD4,3,1,5.,5.,5.,5.,1,3\nPLOAD4,3,1,-1.,,,,1,2\nLOAD,8,1.,2.,3\n");
  ASSERT_THAT(deck.steps[0].pressures, SizeIs(2));
  EXPECT_EQ(deck.steps[0].pressures[0].surface, "pload4_3_1");
  EXPECT_EQ(deck.steps[0].pressures[0].value, -2.0);
  EXPECT_EQ(deck.steps[0].pressures[1].value, 10.0);
}

TEST(NastranPressure, WhatIsNotPressureOnASolidIsRefused) {
  EXPECT_THAT(refusal(kTet + "PLOAD4,3,1,5.\n"), HasSubstr("G1 of solid 1: found nothing"));
  EXPECT_THAT(refusal(kTet + "PLOAD4,3,7,5.,,,,THRU,9\n"),
              HasSubstr("found no shell 7 and no two-dimensional cell of this number on a face"));
  EXPECT_THAT(refusal(kTet + "PLOAD,3,5.,1,2,9\nGRID,9\n"),
              HasSubstr("PLOAD: grid 9 belongs to no solid"));
  EXPECT_THAT(refusal(kTet + "PLOAD4,3,2,5.,,,,1,3\n"), HasSubstr("found no solid 2"));
  EXPECT_THAT(refusal(kTet + "GRID,9\nPLOAD4,3,1,5.,,,,1,9\n"),
              HasSubstr("node 9 is not a corner of cell 1"));
}

// A triangle with the corners 1, 2, 4 of area 1/2: each gets p A / 3 of a constant pressure, and
// A / 12 (2 p_i + p_j + p_k) of one that varies.
TEST(NastranPressure, AlongAVectorOrVaryingItIsForcesOnTheNodes) {
  const Deck along = read_deck(kTet + "PLOAD4,3,1,6.,,,,1,3,+\n+,0,2.,0.,0.\n");
  EXPECT_THAT(along.steps.at(0).pressures, testing::IsEmpty());
  for (const int node : {0, 1, 3})
    EXPECT_LT((total(along.steps[0], node) - Vector3d(1, 0, 0)).norm(), kLoadsRounding);
  EXPECT_EQ(total(along.steps[0], 2), Vector3d(0, 0, 0));
  // Outward from G1 = 1 the corners are 1, 2, 4; inward is +y.
  const Deck varying = read_deck(kTet + "PLOAD4,3,1,24.,48.,0.,,1,3\n");
  EXPECT_NEAR(total(varying.steps[0], 0)[1], (2 * 24 + 48) / 24.0, 1e-13);
  EXPECT_NEAR(total(varying.steps[0], 1)[1], (2 * 48 + 24) / 24.0, 1e-13);
  EXPECT_NEAR(total(varying.steps[0], 3)[1], (24 + 48) / 24.0, 1e-13);
}

TEST(NastranPressure, OfPloadActsAlongTheNormalOfItsGrids) {
  // 1 2 4 is outward (-y): a positive PLOAD pulls.
  const Deck pulls = read_deck(kTet + "PLOAD,3,5.,1,2,4\n");
  ASSERT_THAT(pulls.steps.at(0).pressures, SizeIs(1));
  EXPECT_EQ(pulls.steps[0].pressures[0].value, -5.0);
  EXPECT_EQ(read_deck(kTet + "PLOAD,3,5.,1,4,2\n").steps.at(0).pressures[0].value, 5.0);
  // A diagonal of a cube is no face: forces on its corners, along its normal.
  const std::string cube =
      "PSOLID,1,1\nMAT1,1,210.,,.3,7.8\nGRID,1,,0.,0.,0.\nGRID,2,,1.,0.,0.\nGRID,3,,1.,1.,0.\n"
      "GRID,4,,0.,1.,0.\nGRID,5,,0.,0.,1.\nGRID,6,,1.,0.,1.\nGRID,7,,1.,1.,1.\nGRID,8,,0.,1.,1.\n"
      "CHEXA,1,1,1,2,3,4,5,6,+\n+,7,8\n";
  const Deck cut = read_deck(cube + "PLOAD,3,8.,1,3,7,5\n");
  EXPECT_THAT(cut.steps.at(0).pressures, testing::IsEmpty());
  for (const int node : {0, 2, 4, 6})
    EXPECT_LT((total(cut.steps[0], node) - Vector3d(2, -2, 0)).norm(), kLoadsRounding);
}

TEST(NastranPressure, OfTwoDimensionalCellsActsOnTheSolidBelow) {
  const std::string skin = "CTRIA3,21,9,1,2,4\n";  // its normal is outward
  EXPECT_EQ(read_deck(kTet + skin + "PLOAD2,3,5.,21\n").steps.at(0).pressures[0].value, -5.0);
  EXPECT_EQ(read_deck(kTet + skin + "PLOAD4,3,21,5.,,,,THRU,21\n").steps.at(0).pressures[0].value,
            -5.0);
}

TEST(NastranLoads, ForcesAlongGrids) {
  // From grid 2 (1, 0, 0) to grid 3 (0, 1, 0).
  const Deck one = read_deck(kTet + "FORCE1,3,4,10.,2,3\n");
  EXPECT_LT((total(one.steps.at(0), 3) - Vector3d(-1, 1, 0) * std::sqrt(50.0)).norm(), 1e-14);
  // x times y.
  const Deck two = read_deck(kTet + "FORCE2,3,4,10.,1,2,1,3\n");
  EXPECT_EQ(total(two.steps.at(0), 3), Vector3d(0, 0, 10));
  EXPECT_THAT(refusal(kTet + "FORCE1,3,4,10.,2,2\n"), HasSubstr("grids that define a direction"));
}

TEST(NastranLoads, AccelIsGravityWhereItIsTheSameEverywhere) {
  const Deck deck = read_deck(kTet + "ACCEL,3,0,0.,0.,1.,X,,,+\n+,0.,-9.81,1.,-9.81\n");
  EXPECT_EQ(deck.steps.at(0).acceleration, Vector3d(0, 0, -9.81));
  EXPECT_EQ(deck.steps.at(0).accelerations.size(), 0);
}

TEST(NastranTemperature, FieldsCoverAllNodes) {
  const std::string temps = "TEMPD,4,20.,6,0.\nTEMP,4,2,50.,3,60.\n";
  const Deck deck = read_deck("SOL 101\nCEND\nTEMP(LOAD) = 4\nBEGIN BULK\n" + kTet + temps);
  EXPECT_EQ(deck.steps[0].temperature, "temperature_4");
  const auto& field = deck.mesh.fields.at("temperature_4");
  EXPECT_THAT(std::vector<double>(field.data(), field.data() + 4), ElementsAre(20., 50., 60., 20.));
  EXPECT_THAT(refusal("CEND\nTEMP(LOAD)=4\nBEGIN BULK\n" + kTet + "TEMP,4,2,50.\n"),
              HasSubstr("found no TEMP of node 1 and no TEMPD"));
  EXPECT_THAT(refusal("CEND\nTEMP=5\nBEGIN BULK\n" + kTet), HasSubstr("found no TEMP or TEMPD"));
}

TEST(NastranTemperature, InitialTemperatureIsTheMaterialsReference) {
  const Deck deck = read_deck("CEND\nTEMP(INIT) = 4\nBEGIN BULK\n" + kTet + "TEMPD,4,20.\n");
  EXPECT_EQ(deck.materials.at("mat_1").reference_temperature, 20.0);
  EXPECT_THAT(refusal("CEND\nTEMP(INIT)=4\nBEGIN BULK\n" + kTet + "TEMPD,4,20.\nTEMP,4,2,50.\n"),
              HasSubstr("the same everywhere"));
}

const std::string kMassPoint = "GRID,9,,3.,4.,5.\nRBE2,7,9,123456,1,2,3\nCONM2,1,9,,2.,.5\n";

TEST(NastranLoads, AnAccelerationOfSomeGridsActsOnTheirMass) {
  const Deck deck = read_deck(kTet + kMassPoint + "ACCEL1,3,,2.,0.,0.,-1.,,,+\n+,1,3,9\n");
  const Step& step = deck.steps.at(0);
  EXPECT_EQ(step.acceleration, Vector3d::Zero());
  ASSERT_EQ(step.accelerations.rows(), 4);
  EXPECT_EQ(step.accelerations.row(0), Eigen::RowVector3d(0, 0, -2));
  EXPECT_EQ(step.accelerations.row(1), Eigen::RowVector3d(0, 0, 0));
  EXPECT_EQ(step.accelerations.row(2), Eigen::RowVector3d(0, 0, -2));
  // The mass of 2 at (0.5, 0, 0) from grid 9: its force, and the moment about the grid.
  EXPECT_EQ(total(step, 4), Vector3d(0, 0, -4));
  EXPECT_EQ(total(step, 4, 3), Vector3d(0, 2, 0));
  EXPECT_THAT(refusal(kTet + "ACCEL1,3,,2.,0.,0.,-1.\n"), HasSubstr("ACCEL1: GID: found nothing"));
  EXPECT_THAT(refusal(kTet + "ACCEL1,3,,2.,0.,0.,-1.,,,+\n+,77\n"), HasSubstr("found no GRID 77"));
}

TEST(NastranLoads, AnAccelerationThatVariesIsLinearBetweenItsPositions) {
  // Along y: 1 up to y = 0, 5 at y = 2, so 3 at y = 1; twice by LOAD.
  const std::string accel = "ACCEL,3,,0.,0.,1.,Y,,,+\n+,0.,1.,2.,5.\nLOAD,8,2.,1.,3\n";
  const Step step = read_deck(kTet + accel).steps.at(0);
  ASSERT_EQ(step.accelerations.rows(), 4);
  EXPECT_EQ(step.accelerations.col(2), Eigen::Vector4d(2, 2, 6, 2));
  EXPECT_EQ(step.accelerations.leftCols(2).norm(), 0.0);
  // In a system whose y is the basic z: x = 1 at grid 4, and the direction is turned.
  const Step turned = read_deck(kTet +
                                "CORD2R,6,0,0.,0.,0.,0.,1.,0.,+\n+,0.,0.,1.\n"
                                "ACCEL,3,6,2.,0.,0.,X,,,+\n+,0.,1.,1.,2.\n")
                          .steps.at(0);
  EXPECT_LT((turned.accelerations.row(3) - Eigen::RowVector3d(0, 0, 4)).norm(), kLoadsRounding);
  EXPECT_LT((turned.accelerations.row(2) - Eigen::RowVector3d(0, 0, 2)).norm(), kLoadsRounding);
  EXPECT_EQ(read_deck(kTet + "ACCEL,3,,0.,0.,1.\n").steps.at(0).acceleration, Vector3d(0, 0, 1));
  EXPECT_THAT(refusal(kTet + "ACCEL,3,,0.,0.,1.,,,,+\n+,0.,1.,2.,5.\n"),
              HasSubstr("ACCEL: DIR: found nothing, expected X, Y or Z"));
  EXPECT_THAT(refusal(kTet + "ACCEL,3,,0.,0.,1.,Z,,,+\n+,2.,1.,2.,5.\n"),
              HasSubstr("found two factors at one LOC"));
}

TEST(NastranLoads, SpcdMovesWhatTheSupportsHold) {
  const std::string bulk = kTet + "SPC1,1,123,1,2,3\nSPCD,3,2,1,.5\nFORCE,4,4,,1.,0.,0.,1.\n";
  const Deck deck = read_deck(
      "SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 3\nSUBCASE 2\nLOAD = 4\n"
      "SUBCASE 3\nLOAD = 5\nBEGIN BULK\n" +
      bulk + "LOAD,5,-2.,1.,3\n");
  ASSERT_THAT(deck.steps, SizeIs(3));
  ASSERT_THAT(deck.steps[0].moved, SizeIs(1));
  EXPECT_EQ(deck.steps[0].moved[0].value, 0.5);
  EXPECT_EQ(deck.steps[0].moved[0].dofs, 0b001);
  EXPECT_THAT(deck.steps[0].moved[0].node_indices, ElementsAre(1));
  EXPECT_THAT(deck.steps[1].moved, SizeIs(0));
  EXPECT_EQ(deck.steps[2].moved.at(0).value, -1.0);
  const auto told = [&](const std::string& spc) { return refusal(kTet + spc + "SPCD,3,2,1,.5\n"); };
  EXPECT_THAT(told("SPC1,1,23,2\n"), HasSubstr("t.bdf:9: SPCD: grid 2: found a component that the "
                                               "supports of load_3 do not hold"));
  EXPECT_THAT(told("SPC,1,2,1,.25\n"), HasSubstr("leave D of SPC blank"));
  EXPECT_EQ(told("SPC,1,2,1\n"), "");
}

}  // namespace
}  // namespace clatter::test
