// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/rom/placement.hpp"

#include <gtest/gtest.h>

namespace clatter::rom {
namespace {

TEST(Placement, TurnsSetsMotionsMassAndSkins) {
  ReducedModel model;
  model.M_rr = model.K_rr = Eigen::MatrixXd::Identity(2, 2);
  DofSet& set = model.sets["node"];
  set.dofs = {0, 1};
  set.labels = {"node.x", "node.rx"};
  set.is_rotation = {0, 1};
  set.position = Eigen::RowVector3d(1.0, 2.0, 3.0).replicate(2, 1);
  set.direction = Eigen::RowVector3d::UnitX().replicate(2, 1);
  set.faces["tri6"] = (IndexMatrix(1, 6) << 0, 1, 2, 3, 4, 5).finished();
  model.rigid = Eigen::MatrixXd::Zero(2, 6);
  model.rigid.row(0) << 1, 0, 0, 0, 3, -2;  // x at (1, 2, 3)
  model.rigid(1, 3) = 1.0;
  Eigen::Matrix3d frame = Eigen::Vector3d(-1.0, 1.0, 1.0).asDiagonal();
  model.mass.mass = 2.0;
  model.mass.centre = Eigen::Vector3d(1.0, 2.0, 3.0);
  model.mass.inertia << 3.0, 0.5, 0.2, 0.5, 4.0, 0.1, 0.2, 0.1, 5.0;
  model.skin.nodes = Eigen::RowVector3d(1.0, 2.0, 3.0);
  model.skin.T = (RowMatrix(3, 2) << 1, 2, 3, 4, 5, 6).finished();
  const ReducedModel moved = placed(model, {Eigen::Vector3d(10.0, 0.0, 0.0), frame});
  const DofSet& there = moved.set("node");
  EXPECT_EQ(Eigen::Vector3d(there.position.row(0)), Eigen::Vector3d(9.0, 2.0, 3.0));
  EXPECT_EQ(Eigen::Vector3d(there.direction.row(0)), Eigen::Vector3d(-1.0, 0.0, 0.0));
  EXPECT_EQ(Eigen::Vector3d(there.direction.row(1)),
            Eigen::Vector3d(1.0, 0.0, 0.0));  // an axial vector
  // u . (-x) at (9, 2, 3): -(t + w x r)_x = -(t_x + w_y 3 - w_z 2).
  const Eigen::RowVectorXd expected = (Eigen::RowVectorXd(6) << -1, 0, 0, 0, -3, 2).finished();
  EXPECT_EQ(Eigen::RowVectorXd(moved.rigid.row(0)), expected);
  EXPECT_EQ(moved.rigid(1, 3), 1.0);
  EXPECT_EQ(moved.mass.centre, Eigen::Vector3d(9.0, 2.0, 3.0));
  EXPECT_EQ(moved.mass.inertia(0, 1), -0.5);
  EXPECT_EQ(moved.mass.inertia(1, 2), 0.1);
  EXPECT_EQ(moved.skin.nodes(0, 0), 9.0);
  EXPECT_EQ(moved.skin.T, (RowMatrix(3, 2) << -1, -2, 3, 4, 5, 6).finished());
  // Seen from the other side, with the middles of the same edges.
  const IndexMatrix turned = (IndexMatrix(1, 6) << 2, 1, 0, 4, 3, 5).finished();
  EXPECT_EQ(there.faces.at("tri6"), turned);
}

}  // namespace
}  // namespace clatter::rom
