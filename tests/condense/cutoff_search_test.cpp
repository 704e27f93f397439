// SPDX-License-Identifier: GPL-3.0-or-later
// The cut-off for a requested accuracy.
#include "condense/basis/cutoff_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "condense/condense.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/dense/symmetric_eigen.hpp"
#include "core/sparse/eigen/dense_solver.hpp"
#include "tests/condense/box_model.hpp"
#include "tests/refusal.hpp"

namespace clatter::condense {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd free_spectrum(const MatrixXd& K, const MatrixXd& M) {
  return dense::symmetric_eigen(K, M, dense::EigenParts::kValues).values;
}

CondenseOptions wanted(double hz, double error, const std::string& method = "craig-bampton") {
  CondenseOptions options;
  options.method = method;
  options.boundary = {"left", "right", "point"};
  options.modes.accurate_to_hz = hz;
  options.modes.frequency_error = error;
  options.modes.own_modes = method == "craig-chang";
  options.skin = {};
  return options;
}

rom::ReducedModel reduce_to_cutoff(const fe::FeModel& model, const CondenseOptions& options) {
  set_quiet(true);
  StepClock clock;
  return condense(model, options, clock);
}

TEST(CutOffSearchTest, EveryModeBelowTheWantedFrequencyMeetsTheTarget) {
  const auto model = test::box_model();
  const VectorXd full =
      free_spectrum(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M));
  const double wanted_hz = sparse::hz_of_value(0.5 * (full[29] + full[30]));
  for (const std::string method : {"craig-bampton", "craig-chang"})
    for (const double target : {5e-3, 1e-4, 1e-6}) {
      const rom::ReducedModel reduced = reduce_to_cutoff(model, wanted(wanted_hz, target, method));
      const VectorXd found = free_spectrum(reduced.K_rr, reduced.M_rr);
      for (Eigen::Index j = 6; j < 30; ++j)
        EXPECT_LT(std::sqrt(found[j] / full[j]) - 1.0, target) << method << " mode " << j;
      const auto& c = reduced.certificate;
      EXPECT_EQ(c.accurate_to_hz.value(), wanted_hz);
      EXPECT_EQ(c.frequency_error_target.value(), target);
      EXPECT_LE(c.frequency_error_bound.value(), target);
      EXPECT_GE(c.cutoffs_tried.value(), 1.0);
      const double first = method == "craig-chang" ? wanted_hz : 1.5 * wanted_hz;
      EXPECT_NEAR(c.cutoff_hz.value(), first * std::pow(1.25, c.cutoffs_tried.value() - 1.0),
                  1e-9 * first);
    }
}

TEST(CutOffSearchTest, TheBoundCoversWhatTheEstimateLeavesOutNearTheCutOff) {
  // One truncated interior mode lambda_k coupled to a mode lambda by g: exact lowering of lambda is
  // g^2 / (lambda_k - lambda), the static estimate g^2 / lambda_k.
  const double hz = 100.0, cutoff = 150.0;
  const double lambda = sparse::value_of_hz(hz), lambda_k = sparse::value_of_hz(cutoff);
  const double g = 1e-3 * lambda;
  const double estimate = 0.5 * g * g / lambda_k / lambda;
  const double exact = 0.5 * g * g / (lambda_k - lambda) / lambda;
  EXPECT_NEAR(cutoff_error_bound(estimate, hz, cutoff), exact, 1e-12 * exact);
}

TEST(CutOffSearchTest, AnAccuracyOutOfReachIsSaidNotClaimed) {
  const auto model = test::box_model();
  const VectorXd full =
      free_spectrum(sparse::dense_symmetric(model.K), sparse::dense_symmetric(model.M));
  test::expect_parts(test::refusal_of<NumericsError>([&] {
                       reduce_to_cutoff(model, wanted(sparse::hz_of_value(full[12]), 1e-30));
                     }),
                     {"box: accurate_to_hz: frequencies up to ", "expected 1.0e-30",
                      "the factor's rounding may not allow less"});
}

TEST(BadInput, AccuracyBesideACutOffOrWithoutAnErrorIsRefused) {
  const auto parse = [](const std::string& text) {
    return test::refusal_of([&] {
      condense_keys().read(Config::parse("boundary = [\"left\"]\n" + text, "box.rom.toml"));
    });
  };
  EXPECT_EQ(parse("accurate_to_hz = 3000\nfrequency_error = 0.005\n"), "accepted");
  EXPECT_EQ(parse("accurate_to_hz = 3000\n"), "accepted");
  test::expect_parts(parse("accurate_to_hz = 3000\nfmax_hz = 6000\n"), {"accurate_to_hz"});
  test::expect_parts(parse("accurate_to_hz = 3000\ncount = 10\n"), {"accurate_to_hz"});
  test::expect_parts(parse("accurate_to_hz = 3000\nfrequency_error = 0\n"), {"frequency_error"});
  test::expect_parts(parse("method = \"guyan\"\naccurate_to_hz = 3000\n"), {"guyan"});
  test::expect_parts(parse("accurate_to_hz = -1\n"), {"accurate_to_hz"});
}

}  // namespace
}  // namespace clatter::condense
