// SPDX-License-Identifier: GPL-3.0-or-later
// Static responses to loads as basis vectors.
#include <gtest/gtest.h>

#include "condense/basis/shape_basis.hpp"
#include "condense/condense.hpp"
#include "core/base/log.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/solve.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

rom::ReducedModel reduce_loaded(const fe::FeModel& model, std::vector<std::string> boundary,
                                std::vector<std::string> load_shapes, const std::string& method) {
  CondenseOptions options;
  options.method = method;
  options.boundary = std::move(boundary);
  options.modes.count = method == "guyan" ? 0 : 6;
  options.modes.own_modes = method == "craig-chang";
  options.modes.load_shapes = std::move(load_shapes);
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

/// K u = f with the coordinates `held` at rest.
VectorXd static_answer(MatrixXd K, VectorXd f, const std::vector<int32_t>& held) {
  for (const int32_t dof : held) {
    K.row(dof).setZero();
    K.col(dof).setZero();
    K(dof, dof) = 1.0;
    f[dof] = 0.0;
  }
  return dense::solve_symmetric(K, f);
}

/// Largest error of the reduced skin under a load while the set "left" is held, over the largest
/// displacement.
double skin_error(const fe::FeModel& model, const rom::ReducedModel& reduced,
                  const std::string& load) {
  const VectorXd full = model.T * static_answer(sparse::dense_symmetric(model.K),
                                                model.loads.at(load), model.set("left").dofs);
  const VectorXd q = static_answer(reduced.K_rr, reduced.loads.at(load), reduced.set("left").dofs);
  const VectorXd skin = reduced.skin.T * q;
  double largest = 0.0;
  for (Eigen::Index a = 0; a < reduced.skin.nodes.rows(); ++a)
    for (Eigen::Index b = 0; b < model.nodes.rows(); ++b)
      if ((reduced.skin.nodes.row(a) - model.nodes.row(b)).norm() < 1e-12)
        largest = std::max(largest, (skin.segment<3>(3 * a) - full.segment<3>(3 * b)).norm());
  return largest / full.cwiseAbs().maxCoeff();
}

/// A box with a force along y on its middle section.
fe::FeModel pushed_box() {
  fe::FeModel model = test::box_model();
  VectorXd push = VectorXd::Zero(model.size());
  for (Eigen::Index a = 0; a < model.nodes.rows(); ++a)
    if (std::abs(model.nodes(a, 0) - model.nodes(4, 0)) < 1e-12) push[3 * a + 1] = 1.0;
  model.loads["push"] = push;
  return model;
}

TEST(LoadShapes, MakeTheStaticAnswerExactAtEverySkinNode) {
  const auto model = pushed_box();
  for (const std::string method : {"craig-bampton", "guyan", "craig-chang"}) {
    const rom::ReducedModel with =
        reduce_loaded(model, {"left", "right"}, {"push", "pull"}, method);
    EXPECT_EQ(with.certificate.load_shapes.value(), 2.0);
    EXPECT_LT(skin_error(model, with, "push"), 1e-9) << method;
    EXPECT_LT(skin_error(model, with, "pull"), 1e-9) << method;
  }
  // Without them, the six modes and the static shapes of the boundary leave errors of some per
  // cent.
  const rom::ReducedModel without = reduce_loaded(model, {"left", "right"}, {}, "craig-bampton");
  EXPECT_GT(skin_error(model, without, "push"), 1e-3);
}

TEST(LoadShapes, LookLikeModesWithUnitMass) {
  const rom::ReducedModel reduced =
      reduce_loaded(pushed_box(), {"left", "right"}, {"push", "pull"}, "craig-bampton");
  const auto n = reduced.size() - reduced.n_boundary;
  const MatrixXd K = reduced.K_rr.bottomRightCorner(n, n), M = reduced.M_rr.bottomRightCorner(n, n);
  EXPECT_LT((M - MatrixXd::Identity(n, n)).cwiseAbs().maxCoeff(), 1e-10);
  const VectorXd values = (2.0 * M_PI * reduced.fixed_interface_hz).array().square();
  EXPECT_LT((K - MatrixXd(values.asDiagonal())).norm(), 1e-9 * K.norm());
}

TEST(LoadShapes, OfUniformHeatGiveTheFreeExpansion) {
  // Held without force: every point moves by expansion * dT * (x - x0).
  const auto model =
      test::solid_bar({0.12, 0.04, 0.03}, {4, 2, 2}, 0.3,
                      "[[nodes]]\nname = \"foot\"\nnode_set = \"x0\"\n"
                      "[[load]]\nname = \"heat\"\nkind = \"temperature\"\nvalue = 1.0\n");
  const rom::ReducedModel reduced = reduce_loaded(model, {"foot"}, {"heat"}, "craig-bampton");
  // Six rigid motions are left: the solution of least norm, from which their part is removed.
  const VectorXd u =
      reduced.skin.T * dense::least_squares(reduced.K_rr, reduced.loads.at("heat")).X;
  VectorXd expected(u.size());
  for (Eigen::Index a = 0; a < reduced.skin.nodes.rows(); ++a)
    expected.segment<3>(3 * a) = 1.2e-5 * reduced.skin.nodes.row(a).transpose();
  const MatrixXd rigid = reduced.skin.T * reduced.rigid;
  const VectorXd rest = u - expected;
  const VectorXd strain = rest - rigid * dense::least_squares(rigid, rest).X;
  EXPECT_LT(strain.norm(), 1e-8 * expected.norm());
}

TEST(LoadShapes, ThatDependOnOthersAreDroppedAndCounted) {
  auto model = pushed_box();
  model.loads["twice"] = 2.0 * model.loads.at("push") + model.loads.at("pull");
  VectorXd at_boundary = VectorXd::Zero(model.size());
  at_boundary[model.set("right").dofs.front()] = 1.0;
  model.loads["at_boundary"] = at_boundary;
  const rom::ReducedModel reduced = reduce_loaded(
      model, {"left", "right"}, {"push", "at_boundary", "pull", "twice"}, "craig-bampton");
  EXPECT_EQ(reduced.certificate.load_shapes.value(), 2.0);
  EXPECT_EQ(reduced.certificate.dropped_vectors.value(), 2.0);
  EXPECT_LT(skin_error(model, reduced, "twice"), 1e-9);
}

TEST(ShapeBasisTest, SpansWhatIsNewAndNamesWhatIsNot) {
  // M = I, K = diag(1, 2, 3, 4): kept is the first axis, shapes in the plane of axes 2 and 3.
  const SparseMatrix M = test::diagonal(Eigen::Vector4d::Ones());
  const SparseMatrix K = test::diagonal(Eigen::Vector4d(1.0, 2.0, 3.0, 4.0));
  MatrixXd shapes = MatrixXd::Zero(4, 4);
  shapes.col(0) << 5.0, 1e-6, 0.0, 0.0;
  shapes.col(1) << 1.0, 3e-6, 0.0, 0.0;
  shapes.col(3) << 0.0, 1e6, 1e6, 0.0;
  const ShapeBasis basis = shape_basis(shapes, MatrixXd::Identity(4, 1), sparse::LocalPencil(K, M));
  EXPECT_EQ(basis.dependent, (std::vector<int>{1, 2}));
  ASSERT_EQ(basis.values.size(), 2);
  EXPECT_NEAR(basis.values[0], 2.0, 1e-12);
  EXPECT_NEAR(basis.values[1], 3.0, 1e-12);
}

TEST(BadInput, LoadShapesOfUnknownLoadsNameThosePresent) {
  test::expect_parts(test::refusal_of([&] {
                       reduce_loaded(pushed_box(), {"left", "right"}, {"gsa"}, "craig-bampton");
                     }),
                     {"load_shapes", "gsa", "pull", "push"});
}

TEST(BadInput, LoadShapesOfPrescribedDisplacementsAreRefused) {
  auto model = pushed_box();
  model.prescribed["push"] = VectorXd::Zero(0);
  test::expect_parts(test::refusal_of([&] {
                       reduce_loaded(model, {"left", "right"}, {"push"}, "craig-bampton");
                     }),
                     {"load_shapes", "push", "prescribes"});
}

}  // namespace
}  // namespace clatter::condense
