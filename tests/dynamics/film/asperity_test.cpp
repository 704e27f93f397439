// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "dynamics/film/asperity.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

Asperity unit_law(AsperityOptions::Law law) { return Asperity({law, 1.0, 1.0, 1.0}); }

TEST(Asperity, FitAndExactIntegralGiveTheReferenceFigures) {
  const double fit[] = {0.550449, 0.0777381, 4.92616e-3, 4.40860e-5};
  const double exact[] = {0.616634, 0.0805623, 5.42371e-3, 1.70873e-4};
  for (int h = 0; h <= 3; ++h) {
    // Six printed digits of the reference.
    EXPECT_NEAR(unit_law(AsperityOptions::Law::kFit).at(h).pressure / fit[h], 1.0, 2e-6);
    EXPECT_NEAR(unit_law(AsperityOptions::Law::kExact).at(h).pressure / exact[h], 1.0, 2e-6);
  }
}

TEST(Asperity, FactorOfSummitsIsThatOfGreenwoodAndTripp) {
  // eta beta sigma = 0.2 and sigma / beta = 0.01: 16 sqrt(2) pi / 15 x 0.04 x 0.1.
  EXPECT_NEAR(contact_factor(8e9, 50e-6, 0.5e-6), 4.7390751 * 0.04 * 0.1, 1e-9);
  // Eq. (11) term by term against eq. (12) with the K that it gives.
  const double eta = 1e10, beta = 20e-6, sigma = 0.4e-6, modulus = 53.3e9, gap = 0.5e-6;
  const Asperity law(
      {AsperityOptions::Law::kExact, contact_factor(eta, beta, sigma), modulus, sigma});
  const double direct = 16.0 * std::sqrt(2.0) * M_PI / 15.0 * std::pow(sigma * beta * eta, 2) *
                        modulus * std::sqrt(sigma / beta) * five_halves_bessel(gap / sigma);
  EXPECT_NEAR(law.at(gap).pressure / direct, 1.0, 1e-8);
}

TEST(Asperity, IntegralAgreesWithItsBesselForm) {
  // The Bessel form loses digits by cancellation as l grows: 1e-10 holds to l = 4.
  for (double l : {0.05, 0.3, 1.0, 2.0, 3.0, 4.0})
    EXPECT_NEAR(greenwood_tripp(5, l) / five_halves_bessel(l), 1.0, 1e-10) << l;
}

TEST(Asperity, IntegralObeysItsRecursion) {
  // F_n = n F... : dF_n/dl = -n F_{n-1}; central difference with step 1e-4 is good to 1e-8.
  for (double l : {-6.0, -1.0, 0.0, 1.5, 4.0}) {
    const double d = 1e-4;
    const double slope = (greenwood_tripp(7, l + d) - greenwood_tripp(7, l - d)) / (2 * d);
    EXPECT_NEAR(-slope / (3.5 * greenwood_tripp(5, l)), 1.0, 1e-7) << l;
  }
}

TEST(Asperity, TableOfTheExactLawIsTheIntegral) {
  const Asperity law = unit_law(AsperityOptions::Law::kExact);
  for (double h = -9.0; h < 4.5; h += 0.137) {
    EXPECT_NEAR(law.at(h).pressure / greenwood_tripp(5, h), 1.0, 1e-8)
        << h;  // quintic, step 1/32; worst where F falls fast
    EXPECT_NEAR(law.at(h).slope / (-2.5 * greenwood_tripp(3, h)), 1.0, 1e-6) << h;
  }
}

TEST(Asperity, PressureIsMinusTheSlopeOfTheEnergyAndTheTangentItsSlope) {
  for (auto kind : {AsperityOptions::Law::kFit, AsperityOptions::Law::kExact}) {
    const Asperity law({kind, 1e-3, 53.3e9, 0.5e-6});
    for (double h : {-1.03e-6, 0.0121e-6, 0.507e-6, 1.503e-6}) {
      const double d = 1e-10;
      const double pressure = -(law.at(h + d).energy - law.at(h - d).energy) / (2 * d);
      const double slope = (law.at(h + d).pressure - law.at(h - d).pressure) / (2 * d);
      EXPECT_NEAR(pressure / law.at(h).pressure, 1.0, 1e-6) << h;  // difference step 2e-4 sigma
      EXPECT_NEAR(slope / law.at(h).slope, 1.0, 1e-6) << h;
    }
  }
}

TEST(Asperity, EndsWhereTheFitEndsAndRefusesNonsense) {
  const Asperity law({AsperityOptions::Law::kFit, 1e-3, 53.3e9, 0.5e-6});
  EXPECT_EQ(law.at(2.0e-6).pressure, 0.0);
  EXPECT_GT(law.at(1.99e-6).pressure, 0.0);
  test::expect_parts(
      test::refusal_of([&] {
        Asperity({AsperityOptions::Law::kFit, 1e-3, -1.0, 0.5e-6});
      }),
      {"asperity: found factor 0.001, modulus -1 Pa, roughness 5e-07 m, expected all > 0"});
}

}  // namespace
}  // namespace clatter::film
