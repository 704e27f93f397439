// SPDX-License-Identifier: GPL-3.0-or-later
// The streamed static reduction against the shapes themselves.
#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "condense/basis/local_part.hpp"
#include "condense/basis/reduced_basis.hpp"
#include "core/base/log.hpp"
#include "core/base/threads.hpp"
#include "core/dense/cholesky.hpp"
#include "core/fe/free_motions.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/random_matrix.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

struct Case {
  explicit Case(int nx = 8, int ny = 6, int nz = 6) : model(test::box_model(nx, ny, nz)) {}
  fe::FeModel model;
  LocalPart part{model, {"left", "right", "point"}};
  const PartitionedMatrix &K = part.K, &M = part.M;
  MatrixXd K_ii = sparse::dense_symmetric(K.ii), M_ii = sparse::dense_symmetric(M.ii);
  MatrixXd Psi = -dense::Cholesky(K_ii).solve(MatrixXd(K.ib));
  std::shared_ptr<const sparse::SupernodalFactor> factor =
      std::make_shared<sparse::SupernodalFactor>(K.ii, K.ib);

  RigidMotions rigid() const {
    return {model.rigid(part.dofs.boundary, Eigen::all),
            model.rigid(part.dofs.interior, Eigen::all)};
  }
  MatrixXd statically(const PartitionedMatrix& A, const MatrixXd& A_ii) const {
    const MatrixXd cross = MatrixXd(A.ib).transpose() * Psi;
    return A.bb + cross + cross.transpose() + Psi.transpose() * A_ii * Psi;
  }
};

/// Both methods for the mass.
class StaticReductionTest : public testing::TestWithParam<StaticMass> {};
INSTANTIATE_TEST_SUITE_P(Mass, StaticReductionTest,
                         testing::Values(StaticMass::kSweep, StaticMass::kElimination),
                         [](const auto& info) {
                           return info.param == StaticMass::kSweep ? "BySweep" : "ByElimination";
                         });

TEST_P(StaticReductionTest, EqualsTheProjectionOnTheShapes) {
  const Case c;
  const std::vector<int32_t> kept{0, 7, 31, static_cast<int32_t>(c.K_ii.rows()) - 1};
  for (const bool restored : {false, true}) {
    const RigidMotions none{MatrixXd(c.K.ib.cols(), 0), MatrixXd(c.K_ii.rows(), 0)};
    const StaticReduction found =
        reduce_statically(c.part, *c.factor, restored ? c.rigid() : none, kept, GetParam());
    ASSERT_EQ(found.rows.rows(), 4);
    const MatrixXd K_bb = c.statically(c.K, c.K_ii), M_bb = c.statically(c.M, c.M_ii);
    EXPECT_LT((found.M_bb - M_bb).norm(), 1e-11 * M_bb.norm());
    EXPECT_LT((found.K_bb - K_bb).norm(), 1e-11 * c.K.bb.norm());
    EXPECT_LT((found.rows - c.Psi(kept, Eigen::all)).norm(), 1e-11 * c.Psi.norm());
    EXPECT_LT(found.rigid_error, 1e-11);
  }
}

TEST(ShapesBySolves, AreThoseOfTheSweep) {
  const Case c;
  const std::vector<int32_t> kept{0, 7, 31};
  const StaticShapes swept = sweep_shapes(*c.factor, c.M, kept, StaticMass::kCheaper);
  const StaticShapes solved = shapes_by_solves(c.part, *c.factor, kept);
  EXPECT_LT((solved.M_bb - swept.M_bb).norm(), 1e-12 * swept.M_bb.norm());
  EXPECT_LT((solved.rows - swept.rows).norm(), 1e-12 * swept.rows.norm());
  // The boundary's own mass alone is another matrix: the comparison can fail.
  EXPECT_GT((solved.M_bb - c.M.bb).norm(), 0.1 * swept.M_bb.norm());
}

TEST_P(StaticReductionTest, ThreadsShareTheColumnsOut) {
  const Case c;
  set_thread_count(1);
  const StaticReduction one = reduce_statically(c.part, *c.factor, c.rigid(), {5}, GetParam());
  set_thread_count(3);
  const StaticReduction three = reduce_statically(c.part, *c.factor, c.rigid(), {5}, GetParam());
  set_thread_count(0);
  EXPECT_LT((one.M_bb - three.M_bb).norm(), 1e-14 * one.M_bb.norm());
  EXPECT_LT((one.rows - three.rows).norm(), 1e-14 * one.rows.norm());
}

TEST_P(StaticReductionTest, RowsOfOneCornerOfALargeTreeAreTheRowsOfTheShapes) {
  const Case c(20, 9, 9);
  std::vector<int32_t> kept;
  for (int32_t k = 0; k < 9; ++k) kept.push_back(static_cast<int32_t>(c.K_ii.rows()) - 9 + k);
  const sparse::SupernodeTree& tree = c.factor->tree();
  std::set<int32_t> on_paths;  // supernodes that these rows need
  const std::vector<int32_t> owners = tree.owners(), places = tree.inverse_order();
  for (const int32_t row : kept)
    for (int32_t s = owners[places[row]]; s >= 0; s = tree.parent[s]) on_paths.insert(s);
  ASSERT_LT(4 * static_cast<int32_t>(on_paths.size()), tree.supernodes());
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    const StaticReduction found = reduce_statically(c.part, *c.factor, c.rigid(), kept, GetParam());
    const MatrixXd M_bb = c.statically(c.M, c.M_ii);
    EXPECT_LT((found.rows - c.Psi(kept, Eigen::all)).norm(), 1e-11 * c.Psi.norm()) << threads;
    EXPECT_LT((found.M_bb - M_bb).norm(), 1e-11 * M_bb.norm()) << threads;
    // The mass of the rigid motions, to the last digits.
    const MatrixXd r = c.model.rigid, r_b = c.rigid().at_boundary;
    const MatrixXd whole = r.transpose() * multiply_symmetric(c.model.M, r);
    EXPECT_LT((r_b.transpose() * found.M_bb * r_b - whole).norm(), 5e-15 * whole.norm());
  }
  set_thread_count(0);
}

TEST_P(StaticReductionTest, RigidMotionsAreCarriedToTheLastBit) {
  const Case c;
  RigidMotions rough = c.rigid();
  rough.inside *= 1.0 + 1e-6;  // as if the solve had lost ten digits
  const StaticReduction found = reduce_statically(c.part, *c.factor, rough, {3}, GetParam());
  EXPECT_NEAR(found.rigid_error, 1e-6, 1e-8);
  const MatrixXd& r_b = rough.at_boundary;
  EXPECT_LT((found.rows * r_b - rough.inside.row(3)).norm(), 1e-14 * r_b.norm());
  const MatrixXd r_Mr = r_b.transpose() * found.M_bb * r_b;
  const MatrixXd cross = r_b.transpose() * MatrixXd(c.M.ib).transpose() * rough.inside;
  const MatrixXd expected = r_b.transpose() * c.M.bb * r_b + cross + cross.transpose() +
                            rough.inside.transpose() * c.M_ii * rough.inside;
  EXPECT_LT((r_Mr - expected).norm(), 1e-12 * expected.norm());
}

TEST(ReducedBasisTest, AppliesShapesThatItDoesNotHold) {
  const Case c;
  ReducedBasis basis(c.part, c.factor);
  basis.shapes = test::random_matrix(c.K_ii.rows(), 5, 1);
  const Index n_b = basis.boundary();
  MatrixXd V_i(c.K_ii.rows(), basis.size());
  V_i << c.Psi, basis.shapes;
  const MatrixXd q = test::random_matrix(basis.size(), 4, 2);
  EXPECT_LT((basis.interior(q) - V_i * q).norm(), 1e-11 * (V_i * q).norm());
  const MatrixXd f_i = test::random_matrix(V_i.rows(), 3, 3), f_b = test::random_matrix(n_b, 3, 4);
  MatrixXd expected = V_i.transpose() * f_i;
  expected.topRows(n_b) += f_b;
  EXPECT_LT((basis.project(f_i, f_b) - expected).norm(), 1e-11 * expected.norm());
}

}  // namespace
}  // namespace clatter::condense
