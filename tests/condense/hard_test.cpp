// SPDX-License-Identifier: GPL-3.0-or-later
// Failures of reduced bodies in practice (hard cases B3, B4, B5, B8).
#include <gtest/gtest.h>

#include "condense/certify/certificate.hpp"
#include "condense/condense.hpp"
#include "core/base/log.hpp"
#include "core/dense/svd.hpp"
#include "core/rom/rigid_mass.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/observed.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::box_model;

rom::ReducedModel reduce_hard(const fe::FeModel& model, std::vector<std::string> boundary,
                              int count) {
  CondenseOptions options;
  options.boundary = std::move(boundary);
  options.modes.count = count;
  options.skin = {};
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

TEST(HardB3, ARepeatedInterfaceDofGetsOneCoordinate) {
  const auto model = box_model();
  const rom::ReducedModel once = reduce_hard(model, {"left", "point"}, 12);
  const rom::ReducedModel twice = reduce_hard(model, {"left", "point", "same_point"}, 12);
  EXPECT_EQ(twice.size(), once.size());
  EXPECT_EQ(twice.set("same_point").dofs, twice.set("point").dofs);
  test::expect_at_most("change by a repeated DoF",
                       (twice.K_rr - once.K_rr).norm() / once.K_rr.norm(), 1e-12);
}

TEST(HardB3, ADuplicatedModeIsDroppedAndTheAnswerStays) {
  const auto model = box_model();
  const LocalPart part(model, {"left", "right"});
  ModeRequest request;
  request.count = 10;
  set_quiet(true);
  StepClock clock;
  const StaticPart statics = static_part(part, {}, clock);
  CraigBampton source = craig_bampton(part, statics, request, clock);
  const ReducedMatrices once = project(part, statics.reduction, source.basis);
  MatrixXd& shapes = source.basis.shapes;
  const Eigen::Index r = source.basis.size(), k = shapes.cols();
  shapes.conservativeResize(Eigen::NoChange, k + 1);
  shapes.col(k) = 3.0 * shapes.col(k - 4) - shapes.col(2);
  const ReducedMatrices twice = project(part, statics.reduction, source.basis);
  const std::vector<int> kept = independent_columns(twice.M_rr, source.basis.boundary());
  ASSERT_EQ(static_cast<Eigen::Index>(kept.size()), r);
  EXPECT_EQ(kept.back(), r - 1);
  test::expect_at_most("change by a duplicated mode",
                       (twice.K_rr(kept, kept) - once.K_rr).norm() / once.K_rr.norm(), 1e-12);
}

TEST(HardB4, SixRigidMotionsSurviveWithoutStiffness) {
  const auto model = box_model();
  const rom::ReducedModel reduced = reduce_hard(model, {"left", "right", "point"}, 25);
  for (int d = 0; d < 6; ++d) {
    const VectorXd r = reduced.rigid.col(d).normalized();
    test::expect_at_most("stiffness of a rigid motion",
                         (reduced.K_rr * r).norm() / reduced.K_rr.norm(), 1e-10);
  }
  EXPECT_EQ(reduced.certificate.rigid_modes.value(), 6.0);
}

TEST(HardB5, TenMassPropertiesEqualTheFullModels) {
  const auto model = box_model();
  for (const int count : {1, 10, 40}) {
    const rom::ReducedModel reduced = reduce_hard(model, {"left", "right"}, count);
    const rom::MassProperties found =
        rom::properties_of(reduced.rigid.transpose() * reduced.M_rr * reduced.rigid);
    test::expect_at_most("error of ten mass properties", compare_mass(found, model.mass).largest(),
                         1e-9);
    EXPECT_LT(reduced.certificate.mass_error.value(), 1e-9);
    EXPECT_LT(reduced.certificate.mass_error_elements.value(), 1e-9);
  }
}

TEST(HardB8, ADoubleModeSpansTheSamePlaneInBothSolvers) {
  // Two equal bodies: each pair of equal modes mixes freely, the plane of the pair does not.
  const auto box = test::spring_box(9, 4, 4);
  const auto twice = test::twice(box);
  sparse::EigenOptions options;
  options.count = 16;
  const sparse::ModeSet block = sparse::solve_modes(twice.K, twice.M, options);
  options.method = sparse::EigenMethod::kArpack;
  options.seed = 77;
  const sparse::ModeSet arpack = sparse::solve_modes(twice.K, twice.M, options);
  ASSERT_EQ(block.rigid, 12);
  const MatrixXd M = MatrixXd(twice.M);
  for (int pair = 12; pair < 16; pair += 2) {
    const MatrixXd overlap =
        block.vectors.middleCols(pair, 2).transpose() * M * arpack.vectors.middleCols(pair, 2);
    const VectorXd cosines = dense::singular_values(overlap);
    test::expect_at_least("smallest cosine between the planes of a double mode", cosines.minCoeff(),
                          1.0 - 1e-9);
  }
}

}  // namespace
}  // namespace clatter::condense
