// SPDX-License-Identifier: GPL-3.0-or-later
// The weight of parts with supports: against the full model, beam theory and inertia invariants.
#include "condense/basis/inertia_force.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>

#include "condense/condense.hpp"
#include "core/base/log.hpp"
#include "core/dense/solve.hpp"
#include "tests/condense/solid_model.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kLength = 0.6, kHeight = 0.03, kModulus = 200e9, kDensity = 8000.0;
constexpr const char* kTip = "[[coupling]]\nname = \"tip\"\nsurface = \"x1\"\n";
constexpr const char* kClamp = "[[support]]\nsurface = \"x0\"\n";
constexpr const char* kPull =
    "[[load]]\nname = \"pull\"\nkind = \"acceleration\"\ndirection = [0.0, 0.0, 1.0]\n";

fe::FeModel bar(const std::string& more) {
  return test::solid_bar({kLength, 0.04, kHeight}, {12, 1, 1}, 0.0, kTip + more);
}

rom::ReducedModel reduced_bar(const fe::FeModel& model) {
  CondenseOptions options;
  options.boundary = {"tip"};
  options.modes.count = 6;
  options.modes.frequency_error = 0.0;
  options.skin = {};
  options.inertia_invariants = true;
  StepClock clock;
  return condense(model, options, clock);
}

int tip_z(const std::map<std::string, rom::DofSet>& sets) { return sets.at("tip").dofs.at(2); }

TEST(InertiaForce, HardB9_AClampedBarSagsByBeamTheoryAndAsTheFullModel) {
  const fe::FeModel model = bar(std::string(kClamp) + kPull);
  const rom::ReducedModel reduced = reduced_bar(model);
  ASSERT_EQ(reduced.inertia_force.rows(), reduced.size());
  const VectorXd q = dense::solve_symmetric(reduced.K_rr, reduced.inertia_force.col(2));
  const double sag = q[tip_z(reduced.sets)];
  // w L^4 / (8 E I), w = rho A, I = A h^2 / 12; shear adds 0.3 %, twelve coarse cells take some.
  const double theory =
      12.0 * kDensity * std::pow(kLength, 4) / (8.0 * kModulus * kHeight * kHeight);
  EXPECT_NEAR(sag / theory, 1.0, 0.02);
  const Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower> factor(model.K);
  const VectorXd full = factor.solve(model.loads.at("pull"));
  // Constraint modes are exact for statics at the boundary; assembly integrates its load itself.
  EXPECT_NEAR(std::abs(sag / full[tip_z(model.sets)]), 1.0, 1e-9);
  // The boundary rows of the rigid motions lack what the modes of the interior carry.
  const VectorXd rows = dense::solve_symmetric(reduced.K_rr, reduced.M_rr * reduced.rigid.col(2));
  EXPECT_LT(rows[tip_z(reduced.sets)], 0.9 * sag);
}

TEST(InertiaForce, IsThatOfTheInertiaInvariantsForTranslationsAndRotations) {
  const rom::ReducedModel reduced = reduced_bar(bar(kClamp));
  const auto difference = [&](const VectorXd& expected, int column) {
    return (reduced.inertia_force.col(column) - expected).norm() / expected.norm();
  };
  for (int k = 0; k < 3; ++k) {
    const size_t a = static_cast<size_t>(k), b = (a + 1) % 3, c = (a + 2) % 3;
    EXPECT_LT(difference(reduced.inertia.first[a], k), 1e-9);
    // A rotation about k moves b towards c.
    EXPECT_LT(
        difference(reduced.inertia.moment[3 * b + c] - reduced.inertia.moment[3 * c + b], 3 + k),
        1e-9);
  }
}

TEST(InertiaForce, OfAFreePartIsTheReducedMassTimesItsRigidMotions) {
  const fe::FeModel model = bar("");
  const rom::ReducedModel reduced = reduced_bar(model);
  EXPECT_EQ(reduced.inertia_force.rows(), 0);
  const LocalPart part(model, {"tip"});
  ModeRequest request;
  request.count = 6;
  request.frequency_error = 0.0;
  StepClock clock;
  const CraigBampton source = craig_bampton(part, static_part(part, {}, clock), request, clock);
  const MatrixXd found = inertia_force(part, source.basis);
  const MatrixXd expected = source.M_rr * reduced.rigid;
  // Rigid motions are exact in the basis but for the rounding of its constraint modes.
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

}  // namespace
}  // namespace clatter::condense
