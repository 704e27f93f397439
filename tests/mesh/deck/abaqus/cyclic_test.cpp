// SPDX-License-Identifier: GPL-3.0-or-later
// *CYCLIC SYMMETRY MODEL: the sector is expanded to the ring.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "core/mesh/boundary.hpp"
#include "tests/mesh/deck/abaqus/support.hpp"

namespace clatter::mesh::deck::testing {
namespace {

using ::testing::HasSubstr;

/// A quarter of a ring about z, one hex8, from radius 1 to 2; sides at 0 and 90 degrees.
const std::string kQuarter =
    "*NODE, NSET=NALL\n"
    "1, 1, 0, 0\n2, 2, 0, 0\n3, 0, 2, 0\n4, 0, 1, 0\n"
    "5, 1, 0, 1\n6, 2, 0, 1\n7, 0, 2, 1\n8, 0, 1, 1\n"
    "*ELEMENT, TYPE=C3D8, ELSET=EALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n" +
    std::string(
        "*MATERIAL, NAME=Steel\n*ELASTIC\n2.1E5, 0.3\n*DENSITY\n7.8E-9\n"
        "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n"
        "*NSET, NSET=LEFT\n1, 2, 5, 6\n*NSET, NSET=RIGHT\n3, 4, 7, 8\n"
        "*SURFACE, NAME=L, TYPE=NODE\nLEFT\n*SURFACE, NAME=R, TYPE=NODE\nRIGHT\n");
const std::string kTie = "*TIE, CYCLIC SYMMETRY, POSITION TOLERANCE=1., NAME=T\nL, R\n";
const std::string kFour = "*CYCLIC SYMMETRY MODEL, N=4, NGRAPH=4\n0,0,0,0,0,1\n";

TEST(AbaqusCyclic, SectorsAreCopiedAndJoinedNodeByNode) {
  Deck deck = read(kQuarter + kTie + kFour + "*BOUNDARY\n1, 1, 3\n");
  deck.mesh.surfaces["skin"] = skin_of(boundary_faces(deck.mesh));
  EXPECT_EQ(deck.mesh.cell_count(), 4);
  EXPECT_EQ(deck.mesh.nodes.rows(), 16);
  check_structure(deck.mesh, "ring");
  EXPECT_EQ(deck.mesh.surface("skin").face_count(), 4 * 4);  // the sides are inside
  for (Eigen::Index a = 0; a < 16; ++a) {
    const double radius = deck.mesh.nodes.row(a).head<2>().norm();
    EXPECT_NEAR(std::abs(radius - 1.5), 0.5, 1e-15);
  }
  // The sector keeps its numbers, a copy adds a power of ten.
  EXPECT_EQ(deck.mesh.node_ids[0], 1);
  EXPECT_EQ(deck.mesh.cells[0].ids, (std::vector<int32_t>{1, 11, 21, 31}));
  ASSERT_EQ(deck.supports.size(), 1u);
  EXPECT_EQ(deck.supports[0].node_indices.size(), 4u);
  EXPECT_THAT(deck.notes.back(), HasSubstr("the sector is expanded to the ring of 4"));
}

TEST(AbaqusCyclic, DirectionsOfSupportsAndForcesTurnWithTheirCopy) {
  const Deck deck = read(kQuarter + kTie + kFour +
                         "*BOUNDARY\n1, 1, 1\n*STEP\n*STATIC\n*CLOAD\n2, 1, 5.\n*END STEP\n");
  ASSERT_EQ(deck.supports.size(), 4u);
  for (const Support& support : deck.supports) {
    const Eigen::Vector3d x = deck.mesh.nodes.row(support.node_indices.at(0)).transpose();
    const Eigen::Matrix3d axes = support.system.empty() ? Eigen::Matrix3d::Identity().eval()
                                                        : deck.systems.at(support.system).axes;
    EXPECT_LT((axes.col(0) - Eigen::Vector3d(x[0], x[1], 0)).norm(), 1e-12);  // radius 1
  }
  ASSERT_EQ(deck.steps.at(0).forces.size(), 4u);
  for (const Step::NodalForce& force : deck.steps[0].forces)
    EXPECT_NEAR(deck.mesh.nodes.row(force.node_index).norm(), 2.0, 1e-15);
}

TEST(AbaqusCyclic, WhatCannotBeRepeatedIsRefusedByLine) {
  EXPECT_THAT(refusal(kQuarter + kTie + "*CYCLIC SYMMETRY MODEL, N=5\n0,0,0,0,0,1\n"),
              HasSubstr("deck.inp:28: found 4 and 4 nodes on the sides; rotated by 72 degrees"));
  EXPECT_THAT(refusal(kQuarter + kTie), HasSubstr("deck.inp:26: *TIE, CYCLIC SYMMETRY and"));
  EXPECT_THAT(refusal(kQuarter + kTie + kFour + kFour),
              HasSubstr("deck.inp:30: found a second *CYCLIC SYMMETRY MODEL"));
  EXPECT_THAT(refusal(kQuarter + kTie + "*CYCLIC SYMMETRY MODEL, N=4\n0,0,0,0,0,0\n"),
              HasSubstr("deck.inp:29: expected two different points of the axis"));
  EXPECT_THAT(refusal(kQuarter + kTie + kFour + "*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n"),
              HasSubstr("deck.inp:31: found an equation in a sector of *CYCLIC SYMMETRY MODEL"));
  EXPECT_THAT(refusal(kQuarter + kTie + kFour +
                      "*STEP\n*STATIC\n*DLOAD\nEALL, GRAV, 9.81, 1., 0., 0.\n*END STEP\n"),
              HasSubstr("found gravity across the axis"));
}

}  // namespace
}  // namespace clatter::mesh::deck::testing
