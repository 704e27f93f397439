// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "dynamics/film/flow_factors.hpp"
#include "dynamics/film/roughness.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

void expect_slope(const std::function<ValueSlope(double)>& law, double at,
                  double tolerance = 1e-6) {
  const double d = 1e-5;
  const double slope = (law(at + d).value - law(at - d).value) / (2 * d);
  EXPECT_NEAR(law(at).slope, slope, tolerance * (1.0 + std::abs(slope))) << at;
}

TEST(FlowFactors, HandValues) {
  EXPECT_NEAR(pressure_flow_factor(1.0, 1.0).value, 1.0 - 0.9 * std::exp(-0.56), 1e-15);
  EXPECT_NEAR(pressure_flow_factor(2.0, 3.0).value, 1.0 + 0.225 / std::pow(2.0, 1.5), 1e-15);
  EXPECT_NEAR(shear_flow_factor(1.0, 1.0).value, 1.899 * std::exp(-0.87), 1e-12);
  EXPECT_NEAR(shear_flow_factor(6.0, 1.0).value, 1.126 * std::exp(-1.5), 1e-12);
  test::expect_parts(test::refusal_of([&] { pressure_flow_factor(1.0, 2.0); }),
                     {"peklenik: no ", " for 2, expected one of ", "0.3333, 1, 3, 6, 9"});
  test::expect_parts(test::refusal_of([&] { shear_flow_factor(1.0, 9.0); }),
                     {"peklenik: no ", " for 9, expected one of 0.3333, 1, 3, 6"});
}

TEST(FlowFactors, TendToOneAndZeroForThickFilms) {
  EXPECT_NEAR(pressure_flow_factor(50.0, 1.0).value, 1.0, 1e-10);
  EXPECT_NEAR(pressure_flow_factor(1e5, 9.0).value, 1.0, 1e-7);
  EXPECT_NEAR(shear_flow_factor(100.0, 1.0).value, 0.0, 1e-10);
  EXPECT_NEAR(100.0 * mean_inverse_gap(100.0).value, 1.0, 2e-4);  // 1 + 1/H^2
}

TEST(FlowFactors, SlopesAreDerivatives) {
  for (double h : {0.7, 2.0, 4.0, 7.0}) {
    for (double peklenik : {1.0 / 9.0, 1.0, 6.0})
      expect_slope([&](double x) { return pressure_flow_factor(x, peklenik); }, h);
    expect_slope([](double x) { return shear_flow_factor(x, 3.0); }, h);
    expect_slope([](double x) { return mean_gap(x, 1.0); }, h);
  }
  for (double h : {-3.0, 0.0}) expect_slope([](double x) { return mean_gap(x, 1.0); }, h);
  for (double h : {0.5, 2.9, 3.5, 8.0, 12.0})
    expect_slope([](double x) { return mean_inverse_gap(x); }, h);
}

TEST(FlowFactors, MeanGapStaysPositiveAndIsTheGaussianMean) {
  EXPECT_NEAR(mean_gap(0.0, 2.0).value, 2.0 / std::sqrt(2.0 * M_PI), 1e-15);
  EXPECT_NEAR(mean_gap(10.0, 1.0).value, 10.0, 1e-12);
  for (double h = -8.0; h < 0.0; h += 0.5) {
    EXPECT_GT(mean_gap(h, 1.0).value, 0.0);
    EXPECT_LT(mean_gap(h, 1.0).value, mean_gap(h + 0.5, 1.0).value);
  }
}

TEST(FlowFactors, MeanInverseGapIsItsDefiningIntegral) {
  // 35/96 (1 - (d/3)^2)^3 / (H + d) over gaps above 1/100, midpoint rule in log(H + d).
  for (double h : {0.3, 1.0, 2.5, 4.0, 8.0, 15.0}) {
    const double first = std::max(h - 3.0, 0.01), last = h + 3.0;
    const int n = 20000;
    const double width = std::log(last / first) / n;
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
      const double gap = first * std::exp((k + 0.5) * width);
      const double d = (gap - h) / 3.0;
      sum += 35.0 / 96.0 * std::pow(1.0 - d * d, 3) * width;
    }
    // Under H = 3 Patir and Cheng drop terms of the order of the cut-off 1/100.
    EXPECT_NEAR(mean_inverse_gap(h).value / sum, 1.0, h < 3.0 ? 2e-2 : 1e-7) << h;
  }
}

TEST(RoughFilm, ThicknessesAreContinuousPositiveAndMonotoneIntoContact) {
  const double sigma = 1e-6;
  const RoughFilm rough({sigma, 0.0, 1.0, true});
  FilmCells film;
  const int n = 800;
  film.resize(n);
  rough.thicknesses(Eigen::ArrayXd::LinSpaced(n, -3.0 * sigma, 5.0 * sigma), film);
  for (int i = 1; i < n; ++i) {
    for (const Eigen::ArrayXd* values :
         {&film.content, &film.flow_axial, &film.flow_angle, &film.carry}) {
      EXPECT_GT((*values)[i - 1], 0.0);
      EXPECT_GT((*values)[i], (*values)[i - 1]) << i;
      EXPECT_LT((*values)[i] - (*values)[i - 1], 2e-2 * sigma)
          << i;  // steps of 1e-2 sigma, slope below 2
    }
  }
}

TEST(RoughFilm, SmoothWallsLeaveTheGapAlone) {
  const RoughFilm rough({0.0, 0.0, 1.0, false});
  FilmCells film;
  film.resize(2);
  rough.thicknesses(Eigen::ArrayXd::Constant(2, 3e-6), film);
  EXPECT_EQ(film.content[0], 3e-6);
  EXPECT_EQ(film.carry[1], 3e-6);
  test::expect_parts(test::refusal_of([&] {
                       RoughFilm({0.0, 0.0, 1.0, true});
                     }),
                     {"flow_factors: both walls are smooth, expected a roughness > 0"});
}

}  // namespace
}  // namespace clatter::film
