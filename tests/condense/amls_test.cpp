// SPDX-License-Identifier: GPL-3.0-or-later
// Condensation with fixed-interface modes by multilevel substructuring.
#include <gtest/gtest.h>

#include "condense/condense.hpp"
#include "core/base/log.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"
#include "tests/condense/solid_model.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using sparse::EigenMethod;

constexpr int kRigid = 6;  // only the boundary holds the bar, during condensation

/// A free bar of 3 000 DoFs, large enough that AMLS does not fall back to ARPACK.
const fe::FeModel& bar() {
  static const fe::FeModel model = test::solid_bar(
      {0.2, 0.045, 0.04}, {9, 3, 3}, 0.3, "[[nodes]]\nname = \"foot\"\nnode_set = \"x0\"\n");
  return model;
}

CondenseOptions by(EigenMethod method, int count, double fmax_hz = 0.0) {
  CondenseOptions options;
  options.boundary = {"foot"};
  options.modes.method = method;
  options.modes.count = count;
  options.modes.fmax_hz = fmax_hz;
  options.modes.frequency_error = 0.0;  // no residual modes: they would hide the error of AMLS
  options.skin = {};
  return options;
}

rom::ReducedModel reduce_bar(const CondenseOptions& options) {
  set_quiet(true);
  StepClock clock;
  return condense(bar(), options, clock);
}

/// Elastic frequencies of a reduced model below a limit.
VectorXd elastic_hz(const rom::ReducedModel& reduced, double limit_hz) {
  const VectorXd values =
      dense::symmetric_eigen(reduced.K_rr, reduced.M_rr, dense::EigenParts::kValues)
          .values.tail(reduced.size() - kRigid);
  const VectorXd hz = values.unaryExpr(&sparse::hz_of_value);
  return hz.head((hz.array() < limit_hz).count());
}

TEST(CondenseByAmls, FrequenciesAreThoseOfBlockLanczosFromAbove) {
  const rom::ReducedModel exact = reduce_bar(by(EigenMethod::kBlockLanczos, 40));
  CondenseOptions options = by(EigenMethod::kAmls, 40);
  const double accuracy = options.modes.accuracy = 2e-3;
  const rom::ReducedModel amls = reduce_bar(options);
  const auto& c = amls.certificate;
  ASSERT_TRUE(c.eigen_frequency_error.has_value());  // AMLS was used
  EXPECT_FALSE(exact.certificate.eigen_frequency_error.has_value());
  EXPECT_LE(c.eigen_frequency_error.value(), accuracy);

  const VectorXd interior =
      (amls.fixed_interface_hz - exact.fixed_interface_hz).cwiseQuotient(exact.fixed_interface_hz);
  EXPECT_GT(interior.minCoeff(), -1e-9);  // negative only by rounding
  EXPECT_LT(interior.maxCoeff(), accuracy);
  EXPECT_GT(interior.maxCoeff(), 1e-8);  // the error is not trivial
  EXPECT_GT(c.eigen_residual_max.value(), 10.0 * exact.certificate.eigen_residual_max.value());

  const VectorXd body = elastic_hz(amls, c.cutoff_hz.value());
  ASSERT_GT(body.size(), 10);
  const VectorXd other = elastic_hz(exact, 2.0 * c.cutoff_hz.value()).head(body.size());
  sparse::EigenOptions all;
  all.count = kRigid + static_cast<int>(body.size());
  const VectorXd full =
      sparse::solve_modes(bar().K, bar().M, all).frequencies_hz().tail(body.size());
  for (Index j = 0; j < body.size(); ++j) {
    EXPECT_NEAR(body[j], other[j], accuracy * other[j]) << j;
    EXPECT_GT(body[j], (1.0 - 1e-9) * full[j]) << j;  // Rayleigh and Ritz
  }
}

TEST(CondenseByAmls, ACutOffWithinTheErrorOfAFrequencyIsNotSaidToBeProved) {
  const VectorXd exact = reduce_bar(by(EigenMethod::kBlockLanczos, 40)).fixed_interface_hz;
  CondenseOptions options = by(EigenMethod::kAmls, 40);
  options.modes.accuracy = 0.1;
  const rom::ReducedModel counted = reduce_bar(options);
  EXPECT_LE(counted.certificate.cutoff_hz.value(), counted.fixed_interface_hz[39]);
  const VectorXd rough = counted.fixed_interface_hz;
  Index worst = 0;  // the mode with the largest error, separated from the next
  for (Index j = 0; j < 39; ++j)
    if (rough[j] < exact[j + 1] && rough[j] / exact[j] > rough[worst] / exact[worst]) worst = j;
  ASSERT_GT(rough[worst] / exact[worst] - 1.0, 1e-7);
  options.modes.count = 0;
  options.modes.fmax_hz = exact[worst] + 0.02 * (rough[worst] - exact[worst]);
  const rom::ReducedModel reduced = reduce_bar(options);
  const auto& c = reduced.certificate;
  EXPECT_EQ(c.count_proved.value(), 0.0);
  EXPECT_EQ(c.count_below.value(), static_cast<double>(worst + 1));
  EXPECT_EQ(c.fixed_interface_modes.value(), static_cast<double>(worst + 1));
  std::string text;
  for (const std::string& line : describe(reduced)) text += line + "\n";
  EXPECT_NE(text.find("number is not proved"), std::string::npos) << text;
  EXPECT_NE(text.find("inconclusive within"), std::string::npos) << text;
  EXPECT_NE(text.find("largest error about"), std::string::npos) << text;
}

}  // namespace
}  // namespace clatter::condense
