// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A bar to couple, hold and load, and dense solves of it.
#include <gtest/gtest.h>

#include <random>

#include "block_mesh.hpp"
#include "core/dense/cholesky.hpp"
#include "saddle.hpp"
#include "small_solver.hpp"

namespace clatter::assembly::testing {

/// A bar of 0.1 x 0.1 x 0.3 m with node sets for its ends and a few single nodes.
inline mesh::Mesh bar() {
  mesh::Mesh mesh = block_mesh({1, 1, 3}, brick({0.1, 0.1, 0.3}));
  for (const char* side : {"z0", "z1", "x0", "y1"})
    mesh.node_sets[side] = mesh::nodes_of(mesh.surface(side));
  for (Eigen::Index a = 0; a < mesh.nodes.rows(); ++a)
    if (std::abs(mesh.nodes(a, 2) - 0.2) < 1e-12 && mesh.nodes(a, 1) < 1e-12)
      mesh.node_sets["n" + std::to_string(std::lround(1e3 * mesh.nodes(a, 0)))] = {
          static_cast<int32_t>(a)};
  return mesh;
}

inline constexpr const char* kFoot = "[[support]]\nname = \"foot\"\nsurface = \"z0\"\n";

inline void hold_foot(const mesh::Mesh& mesh, Saddle& saddle) {
  for (const int32_t node : mesh.node_sets.at("z0"))
    for (int d = 0; d < 3; ++d) saddle.add(Functional{{3 * node + d}, {1.0}});
}

/// Solves the model for forces on all DoFs (nodes, then points); u of all DoFs.
inline Eigen::VectorXd solve_model(const fe::FeModel& model, const Eigen::VectorXd& f) {
  const Eigen::Index nodal = model.T.rows(), n = model.size();
  Eigen::MatrixXd T(f.size(), n);
  T.topRows(nodal) = model.T;
  if (f.size() > nodal) T.bottomRows(f.size() - nodal) = model.points.T;
  const dense::Cholesky factor(full(model.K));
  EXPECT_TRUE(factor.ok());
  EXPECT_TRUE(dense::Cholesky(full(model.M)).ok());
  return T * factor.solve(T.transpose() * f);
}

inline Eigen::VectorXd some_forces(Eigen::Index size) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal(0.0, 100.0);
  return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return normal(generator); });
}

/// Rounding of a stiffness of condition 1e6, and of the oracle's pseudo-inverse.
inline constexpr double kSolve = 1e-8;

}  // namespace clatter::assembly::testing
