// SPDX-License-Identifier: GPL-3.0-or-later
// The body's own modes with residual flexibility of the boundary.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "condense/condense.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/solve.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/condense/solid_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

rom::ReducedModel reduce_free(const fe::FeModel& model, std::vector<std::string> boundary,
                              const std::string& method, int count, double fmax_hz = 0.0) {
  CondenseOptions options;
  options.method = method;
  options.boundary = std::move(boundary);
  options.modes.count = count;
  options.modes.fmax_hz = fmax_hz;
  options.modes.own_modes = method == "craig-chang";
  options.modes.frequency_error = 0.0;
  options.skin = {};
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

/// Eigenvalues by Eigen's dense solver.
VectorXd spectrum(const MatrixXd& K, const MatrixXd& M) {
  return dense::symmetric_eigen(K, M, dense::EigenParts::kValues).values;
}

VectorXd full_spectrum(const fe::FeModel& model) {
  return spectrum(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M));
}

/// Largest relative frequency error of elastic modes 1 to `count`.
double frequency_error(const VectorXd& found, const VectorXd& expected, int rigid, int count) {
  double error = 0.0;
  for (int j = rigid; j < rigid + count; ++j)
    error = std::max(error, std::abs(std::sqrt(found[j] / expected[j]) - 1.0));
  return error;
}

TEST(CraigChang, TheChainKeepsItsHandComputedFrequencies) {
  // Four masses 2, 2, 2, 1 on unit springs, the first held to the ground: -x_(j-1) + 2 x_j -
  // x_(j+1) = 2 lambda x_j with a free end has lambda = 1 - cos((2 k - 1) pi / 8).
  const fe::FeModel model = test::held_chain();
  const LocalPart part(model, {"end"});
  ModeRequest request;
  request.count = 2;
  request.own_modes = true;
  request.frequency_error = 0.0;
  set_quiet(true);
  StepClock clock;
  const CraigBampton found = craig_bampton(part, static_part(part, {}, clock), request, clock);
  ASSERT_EQ(found.M_rr.rows(), 3);
  const VectorXd values = spectrum(found.K_rr, found.M_rr);
  EXPECT_NEAR(values[0], 1.0 - std::cos(M_PI / 8.0), 1e-13);
  EXPECT_NEAR(values[1], 1.0 - std::cos(3.0 * M_PI / 8.0), 1e-13);
}

TEST(CraigChang, OwnFrequenciesAreExactWhereGuyanAndCraigBamptonErr) {
  const auto model = test::box_model();
  const std::vector<std::string> boundary{"left", "right", "point"};
  const VectorXd full = full_spectrum(model);
  const int count = 25;
  const double fmax = sparse::hz_of_value(0.5 * (full[5 + count] + full[6 + count]));
  const rom::ReducedModel chang = reduce_free(model, boundary, "craig-chang", 0, fmax);
  EXPECT_EQ(chang.certificate.own_modes.value(), count);
  EXPECT_EQ(chang.certificate.count_proved.value(), 1.0);
  EXPECT_EQ(chang.certificate.accurate_to_hz.value(), fmax);
  const VectorXd own = spectrum(chang.K_rr, chang.M_rr);
  EXPECT_LT(frequency_error(own, full, 6, count), 1e-9);  // eigen-residual, squared
  EXPECT_LT(chang.certificate.frequency_error_estimate.value(), 1e-9);
  const rom::ReducedModel guyan = reduce_free(model, boundary, "guyan", 0);
  EXPECT_GT(frequency_error(spectrum(guyan.K_rr, guyan.M_rr), full, 6, 6), 1e-2);
  // As many columns of fixed-interface modes.
  const rom::ReducedModel bampton =
      reduce_free(model, boundary, "craig-bampton", chang.size() - chang.n_boundary);
  EXPECT_GT(frequency_error(spectrum(bampton.K_rr, bampton.M_rr), full, 6, count), 1e-4);
}

TEST(CraigChang, RigidMotionsAndMassAreExactAndBoundaryCoordinatesStay) {
  const auto model = test::box_model();
  const rom::ReducedModel reduced = reduce_free(model, {"right", "left"}, "craig-chang", 10);
  EXPECT_EQ(reduced.size(), 15 + 6 + 10);
  EXPECT_EQ(reduced.certificate.rigid_modes.value(), 6.0);
  EXPECT_LT(reduced.certificate.rigid_stiffness_residue.value(), 1e-10);
  EXPECT_LT(reduced.certificate.mass_error.value(), 1e-12);
  const auto& right = model.set("right").dofs;
  for (size_t k = 0; k < right.size(); ++k)
    EXPECT_EQ(reduced.rigid.row(static_cast<Eigen::Index>(k)), model.rigid.row(right[k]));
  EXPECT_EQ(reduced.rigid.bottomRows(16).norm(), 0.0);
}

/// A symmetric matrix with rigid motions made regular: A + s R R^T.
MatrixXd held_softly(const MatrixXd& K, const MatrixXd& R) {
  return K + K.diagonal().mean() * R * R.transpose();
}

TEST(CraigChang, TheFreeBoundaryAnswersSelfEquilibratedLoadsAsTheFullModel) {
  const auto model = test::box_model();
  const rom::ReducedModel reduced = reduce_free(model, {"left", "right"}, "craig-chang", 4);
  std::vector<int32_t> dofs = model.set("left").dofs;
  const auto& right = model.set("right").dofs;
  dofs.insert(dofs.end(), right.begin(), right.end());
  const MatrixXd rigid_b = model.rigid(dofs, Eigen::all);
  std::mt19937 generator(3);
  std::normal_distribution<double> normal;
  VectorXd f_b = VectorXd::NullaryExpr(15, [&](Eigen::Index) { return normal(generator); });
  f_b -= rigid_b * dense::least_squares(rigid_b, f_b).X;  // no force, no moment
  VectorXd f = VectorXd::Zero(model.size()), f_r = VectorXd::Zero(reduced.size());
  f(dofs) = f_b;
  f_r.head(15) = f_b;
  const VectorXd full = dense::solve_symmetric(
      held_softly(sparse::dense_symmetric(model.K), model.rigid), f)(dofs, 0);
  const VectorXd small =
      dense::solve_symmetric(held_softly(reduced.K_rr, reduced.rigid), f_r).topRows(15);
  const VectorXd difference = small - full;  // up to a rigid motion
  const VectorXd strain = difference - rigid_b * dense::least_squares(rigid_b, difference).X;
  EXPECT_LT(strain.norm(), 1e-9 * full.norm());
}

TEST(CraigChang, HoldsForASolidOnItsSupports) {
  const auto model = test::solid_bar({0.2, 0.02, 0.03}, {6, 1, 1}, 0.3,
                                     "[[support]]\nname = \"foot\"\nsurface = \"x0\"\n"
                                     "[[coupling]]\nname = \"tip\"\nsurface = \"x1\"\n");
  const rom::ReducedModel reduced = reduce_free(model, {"tip"}, "craig-chang", 12);
  EXPECT_EQ(reduced.certificate.rigid_modes.value(), 0.0);
  EXPECT_LT(frequency_error(spectrum(reduced.K_rr, reduced.M_rr), full_spectrum(model), 0, 12),
            1e-9);
}

TEST(BadInput, CraigChangNeedsACutOffOrACount) {
  const auto parse = [](const std::string& text) {
    return condense_keys().read(Config::parse(text, "box.rom.toml"));
  };
  EXPECT_TRUE(
      parse("boundary = [\"left\"]\nmethod = \"craig-chang\"\nfmax_hz = 10.0\n").modes.own_modes);
  test::expect_parts(
      test::refusal_of([&] { parse("boundary = [\"left\"]\nmethod = \"craig-chang\"\n"); }),
      {"fmax_hz", "count"});
  test::expect_parts(test::refusal_of([&] {
                       parse("boundary = [\"left\"]\nmethod = \"macneal\"\nfmax_hz = 10.0\n");
                     }),
                     {"macneal", "craig-chang"});
}

}  // namespace
}  // namespace clatter::condense
