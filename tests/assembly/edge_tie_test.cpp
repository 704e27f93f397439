// SPDX-License-Identifier: GPL-3.0-or-later
// Edges of sheets on faces of solids.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <map>

#include "block_mesh.hpp"
#include "core/base/log.hpp"
#include "core/mesh/boundary.hpp"
#include "small_solver.hpp"
#include "tests/refusal.hpp"

namespace clatter::assembly::testing {
namespace {

constexpr double kTop = 0.02;  // of the block [m]

/// A block of 100 x 60 x 20 mm and walls, 40 mm high, on the lines between the points of a plan; a
/// plan that ends where it begins is a closed box. Node sets: foot, the lower nodes, and head.
mesh::Mesh walls_on_block(const std::vector<Eigen::Vector2d>& plan, int along, int up,
                          double lift = 0.0) {
  mesh::Mesh mesh = block_mesh({8, 5, 2}, brick({0.1, 0.06, kTop}), {mesh::CellType::kHex8});
  const bool closed = (plan.front() - plan.back()).norm() == 0.0;
  std::vector<Eigen::Vector2d> line;
  for (size_t p = 0; p + 1 < plan.size(); ++p)
    for (int i = 0; i < along; ++i) line.push_back(plan[p] + (plan[p + 1] - plan[p]) * i / along);
  if (!closed) line.push_back(plan.back());
  const auto columns = static_cast<int32_t>(line.size()),
             first = static_cast<int32_t>(mesh.nodes.rows());
  mesh.nodes.conservativeResize(first + columns * (up + 1), Eigen::NoChange);
  for (int32_t j = 0; j <= up; ++j)
    for (int32_t i = 0; i < columns; ++i) {
      const int32_t node = first + j * columns + i;
      mesh.nodes.row(node) << line[static_cast<size_t>(i)].transpose(), kTop + lift + 0.04 * j / up;
      if (j == 0) mesh.node_sets["foot"].push_back(node);
      if (j == up) mesh.node_sets["head"].push_back(node);
    }
  const int32_t cells = closed ? columns : columns - 1;
  mesh::ShellBlock block;
  block.region = static_cast<int32_t>(mesh.regions.size());
  mesh.regions.push_back("wall");
  block.nodes.resize(cells * up, 4);
  for (int32_t j = 0; j < up; ++j)
    for (int32_t i = 0; i < cells; ++i) {
      const int32_t a = first + j * columns + i, b = first + j * columns + (i + 1) % columns;
      block.nodes.row(j * cells + i) << a, b, b + columns, a + columns;
    }
  mesh.shells = {block};
  mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh), mesh.shells);
  return mesh;
}

/// Its walls of quad8, whose lower mid-side nodes are of the foot.
mesh::Mesh quadratic(mesh::Mesh mesh) {
  mesh::ShellBlock& block = mesh.shells[0];
  block.type = mesh::FaceType::kQuad8;
  block.nodes.conservativeResize(Eigen::NoChange, 8);
  std::map<std::pair<int32_t, int32_t>, int32_t> middles;
  std::vector<Eigen::RowVector3d> at;
  const auto first = static_cast<int32_t>(mesh.nodes.rows());
  for (Eigen::Index c = 0; c < block.nodes.rows(); ++c)
    for (Eigen::Index i = 0; i < 4; ++i) {
      const int32_t a = block.nodes(c, i), b = block.nodes(c, (i + 1) % 4);
      const auto [known, added] =
          middles.try_emplace(std::minmax(a, b), first + static_cast<int32_t>(at.size()));
      block.nodes(c, 4 + i) = known->second;
      if (!added) continue;
      at.push_back(0.5 * (mesh.nodes.row(a) + mesh.nodes.row(b)));
      if (i == 0 && at.back().z() < kTop + 1e-3) mesh.node_sets["foot"].push_back(known->second);
    }
  mesh.nodes.conservativeResize(first + std::ssize(at), Eigen::NoChange);
  for (size_t k = 0; k < at.size(); ++k) mesh.nodes.row(first + static_cast<int32_t>(k)) = at[k];
  mesh.surfaces["skin"] = mesh::skin_of(mesh::boundary_faces(mesh), mesh.shells);
  return mesh;
}

std::string wall(double offset = 0.0, const std::string& more = "") {
  return fmt::format(
      "[[shell]]\nregions = [\"wall\"]\nthickness = 0.002\noffset = {}\n[[tie]]\nname = \"weld\"\n"
      "edge = \"foot\"\nmaster = \"z1\"\n{}",
      offset, more);
}

void expect_one_body(const BuiltModel& built) {
  EXPECT_LT(built.certificate.rigid_recovery_error.value(), 1e-11);
  EXPECT_LT(built.certificate.rigid_force_residue.value(), 1e-10);
  EXPECT_LT(built.certificate.mass_error.value(), 1e-9);
  // Six motions without forces and no seventh, as a hinge would be; K scaled to a unit diagonal.
  const Eigen::MatrixXd K = full(built.model.K);
  const Eigen::VectorXd scale = K.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scale.asDiagonal() * K * scale.asDiagonal(),
                                                     Eigen::EigenvaluesOnly)
          .eigenvalues();
  EXPECT_LT(std::abs(values(5)), 1e-12);
  EXPECT_GT(values(6), 1e-7);
}

TEST(EdgeTie, RigidMotionsCrossAWallAtAnAngle) {
  for (const double offset : {0.0, 0.0008})
    expect_one_body(build(walls_on_block({{0.011, 0.013}, {0.083, 0.041}}, 7, 4), wall(offset)));
}

TEST(EdgeTie, QuadraticWallsStandOnTheirMidSideNodesToo) {
  const mesh::Mesh mesh = quadratic(walls_on_block({{0.011, 0.013}, {0.083, 0.041}}, 4, 2));
  EXPECT_EQ(mesh.node_sets.at("foot").size(), 9u);
  const BuiltModel built = build(mesh, wall());
  expect_one_body(built);
}

TEST(EdgeTie, HeatFlowsThroughTheFoot) {
  mesh::Mesh mesh = walls_on_block({{0.01, 0.03}, {0.09, 0.03}}, 8, 4);
  mesh.node_sets["top"] = mesh::nodes_of(mesh.surface("z1"));
  const std::string text = fmt::format(
      "[material.steel]\nregions = [\"{}\", \"wall\"]\nE = 2e11\nnu = 0.3\nrho = 7850.0\n"
      "conductivity = 50.0\nexpansion = 1e-5\n{}[[heat]]\nname = \"warm\"\n"
      "[[heat.fixed]]\nnode_set = \"top\"\ntemperature_c = 100.0\n"
      "[[heat.fixed]]\nnode_set = \"head\"\ntemperature_c = 20.0\n",
      mesh.regions[0], wall());
  const auto field = build_all(mesh, text).model.heat.at("warm");
  const int32_t foot = mesh.node_sets.at("foot")[4];
  EXPECT_NEAR(field.temperature(foot), 373.15, 1e-9);
  EXPECT_NEAR(field.temperature(foot + 2 * 9), 333.15, 1e-9);
  EXPECT_NEAR(std::abs(field.heat(1)), 50.0 * 0.002 * 0.08 * 80.0 / 0.04, 1e-9);
}

TEST(EdgeTie, ABoxTurnsWithTheFaceAtItsCorners) {
  const std::vector<Eigen::Vector2d> box = {
      {0.02, 0.01}, {0.08, 0.01}, {0.08, 0.05}, {0.02, 0.05}, {0.02, 0.01}};
  expect_one_body(build(walls_on_block(box, 5, 4), wall()));
}

TEST(EdgeTie, RigidMotionsCrossAGap) {
  const mesh::Mesh mesh = walls_on_block({{0.011, 0.013}, {0.083, 0.041}}, 7, 4, 0.0005);
  expect_one_body(build(mesh, wall()));
  EXPECT_EQ(
      test::refusal_of([&] { build(mesh, wall(0.0, "distance = 0.0004")); }),
      "test.fe.toml:10: tie weld: found no part of the edge foot that stands on z1 within 0.0004 "
      "m, expected some");
}

TEST(EdgeTie, OfNodesWithoutAFreeEdgeIsRefused) {
  mesh::Mesh mesh = walls_on_block({{0.01, 0.03}, {0.09, 0.03}}, 4, 4);
  for (int32_t& node : mesh.node_sets["foot"]) node += 5;  // the row above the foot
  const std::string text = test::refusal_of([&] { build(mesh, wall()); });
  EXPECT_NE(text.find("tie weld: found no free edge of a sheet between nodes of foot"),
            std::string::npos)
      << text;
  EXPECT_NE(test::refusal_of([&] { build(mesh, wall(0.0, "slave = \"z0\"\n")); }).find("slave"),
            std::string::npos);
}

TEST(EdgeTie, ABoltHasASlaveAlways) {
  const std::string text = test::refusal_of([] {
    build(walls_on_block({{0.01, 0.03}, {0.09, 0.03}}, 4, 4),
          wall(0.0, "[[bolt]]\nname = \"b\"\nmaster = \"z0\"\ndirection = [0, 0, 1]\n"));
  });
  EXPECT_NE(text.find("bolt[0].slave: "), std::string::npos) << text;
}

/// The warnings of a model.
std::vector<std::string> warnings_of(const mesh::Mesh& mesh, const std::string& toml) {
  std::vector<std::string> warnings;
  set_log_sink([&](bool warning, const std::string& text) {
    if (warning) warnings.push_back(text);
  });
  build(mesh, toml);
  set_log_sink({});
  return warnings;
}

TEST(EdgeTie, NodesThatStandOnNothingAreSaid) {
  // Nodes at -40, -20, 0, ... 120 mm of a block from 0 to 100.
  const std::vector<std::string> warnings =
      warnings_of(walls_on_block({{-0.04, 0.03}, {0.12, 0.03}}, 8, 4), wall());
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(
      warnings[0].find("weld: 3 of 9 nodes of the edge foot are not tied: they do not stand on "
                       "z1 within 0.001 m"),
      std::string::npos)
      << warnings[0];
}

TEST(EdgeTie, WideCellsOfTheSolidAreSaid) {
  const std::vector<std::string> warnings =
      warnings_of(walls_on_block({{0.01, 0.03}, {0.09, 0.03}}, 8, 4), wall());
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("weld: the cells of z1 at the edge are 0.012 m wide, of a sheet 0.002 "
                             "m thick: beyond three thicknesses the foot is too stiff"),
            std::string::npos)
      << warnings[0];
}

}  // namespace
}  // namespace clatter::assembly::testing
