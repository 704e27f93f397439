// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

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
  test::expect_parts(
      test::refusal_of([&] { shear_flow_factor(1.0, 5.0); }),
      {"peklenik: no ", " for 5, expected one of 0.1111, 0.1667, 0.3333, 1, 3, 6, 9"});
  EXPECT_NEAR(shear_stress_factor(1.0, 1.0).value, 11.1 * std::exp(-2.27), 1e-12);
  EXPECT_NEAR(pressure_stress_factor(2.0, 1.0 / 6.0).value, 1.0 - 1.51 * std::exp(-1.08), 1e-15);
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

TEST(FlowFactors, HardN4_FactorsArePositiveAndConstantBelowTheirRange) {
  // Evaluated down to H = 0.5, the fits of 1/9 and 1/6 gave -0.200 and -0.119 there, and so flow
  // uphill.
  for (double peklenik : {1.0 / 9.0, 1.0 / 6.0, 1.0 / 3.0, 1.0, 3.0, 6.0, 9.0}) {
    const double lowest = lowest_ratio(peklenik);
    EXPECT_EQ(lowest, peklenik < 1.0 ? 1.0 : 0.5);
    const double end = pressure_flow_factor(lowest, peklenik).value;
    for (double h = -4.0; h < 6.0; h += 0.01) {
      const ValueSlope factor = pressure_flow_factor(h, peklenik);
      EXPECT_GT(factor.value, 0.0) << peklenik << " at " << h;
      if (h >= lowest) continue;
      EXPECT_EQ(factor.value, end);
      EXPECT_EQ(factor.slope, 0.0);
    }
  }
  for (double peklenik : {1.0 / 9.0, 1.0 / 6.0, 1.0 / 3.0, 1.0, 3.0, 6.0, 9.0}) {
    const double lowest = lowest_ratio(peklenik);
    const ValueSlope below = shear_flow_factor(0.9 * lowest, peklenik);
    EXPECT_EQ(below.value, shear_flow_factor(lowest, peklenik).value);
    EXPECT_EQ(below.slope, 0.0);
    EXPECT_DOUBLE_EQ(pressure_stress_factor(-1.0, peklenik).value,
                     pressure_stress_factor(lowest_stress_ratio(peklenik), peklenik).value);
    EXPECT_DOUBLE_EQ(shear_stress_factor(0.1, peklenik).value,
                     shear_stress_factor(0.5, peklenik).value);
    double before = shear_stress_factor(0.0, peklenik).value;
    for (double h = -4.0; h < 12.0; h += 0.01) {
      EXPECT_GT(pressure_stress_factor(h, peklenik).value, 0.0) << peklenik << " at " << h;
      const ValueSlope stress = shear_stress_factor(h, peklenik);
      EXPECT_GT(stress.value, 0.0);
      EXPECT_LT(std::abs(stress.value - before), 0.06) << peklenik << " at " << h;  // no jump
      before = stress.value;
    }
  }
}

TEST(FlowFactors, StressFactorsTendToThoseOfSmoothWalls) {
  for (double peklenik : {1.0 / 9.0, 1.0 / 6.0, 1.0 / 3.0, 1.0, 3.0, 6.0, 9.0}) {
    EXPECT_LT(shear_stress_factor(7.0, peklenik).value, 0.03);
    EXPECT_LT(shear_stress_factor(30.0, peklenik).value, 1e-11);
    EXPECT_NEAR(pressure_stress_factor(60.0, peklenik).value, 1.0, 1e-12);
    for (double h : {0.7, 1.4, 3.0, 6.0, 8.0}) {
      if (h != lowest_stress_ratio(peklenik))
        expect_slope([&](double x) { return pressure_stress_factor(x, peklenik); }, h);
      expect_slope([&](double x) { return shear_stress_factor(x, peklenik); }, h);
    }
  }
}

// Roughness across the sliding direction (gamma = 0) has a closed form: the flow over it is
// constant, so the smooth wall's shear is mu U (4 <1/h> - 3 <1/h^2>^2 / <1/h^3>), and phi_fs what
// exceeds <1/h>. The fit of gamma = 1/9 has its sign and size.
TEST(FlowFactors, ShearStressFactorIsBelowThatOfRidgesAcross) {
  for (double h : {3.5, 4.0, 5.0, 6.0}) {
    double m_1 = 0.0, m_2 = 0.0, m_3 = 0.0;
    const int n = 4000;
    for (int k = 0; k < n; ++k) {
      const double t = -1.0 + (k + 0.5) * 2.0 / n, gap = h + 3.0 * t,
                   weight = 35.0 / 32.0 * std::pow(1.0 - t * t, 3) * 2.0 / n;
      m_1 += weight / gap;
      m_2 += weight / (gap * gap);
      m_3 += weight / (gap * gap * gap);
    }
    const double ridges = h * 3.0 * (m_1 - m_2 * m_2 / m_3);
    const double fit = shear_stress_factor(h, 1.0 / 9.0).value;
    EXPECT_GT(fit, 0.3 * ridges) << h;
    EXPECT_LT(fit, 1.1 * ridges) << h;
  }
}

// The gradient's force on both walls together is h_T dp/dz: swapping the walls gives the rest.
TEST(FlowFactors, FrictionFactorsOfSwappedWallsBalance) {
  const int n = 200;
  const Eigen::ArrayXd gaps = Eigen::ArrayXd::LinSpaced(n, -1e-6, 8e-6);
  FilmCells film;
  film.resize(n);
  for (double peklenik : {1.0 / 6.0, 1.0, 9.0}) {
    const auto shear_of = [&](double piston, double liner) {
      const RoughFilm rough({piston, liner, peklenik, true, true});
      rough.thicknesses(gaps, film);
      ShearThickness shear;
      shear.inverse.setZero(n);
      shear.inverse_slope.setZero(n);
      rough.shear(gaps, film, shear);
      return shear;
    };
    const ShearThickness one = shear_of(0.6e-6, 0.0), other = shear_of(0.0, 0.6e-6);
    EXPECT_LT((one.lever + other.lever - 2.0 * film.content).abs().maxCoeff(), 1e-20);
    EXPECT_LT((one.inverse - other.inverse).abs().maxCoeff(), 1e-9 * one.inverse.maxCoeff());
    EXPECT_GT(one.inverse.minCoeff(), 0.0);
    const double step = gaps[1] - gaps[0];
    for (int i = 1; i + 1 < n; ++i) {
      // Central differences over 0.075 sigma, except at the ends of the ranges.
      const double slope = (one.lever[i + 1] - one.lever[i - 1]) / (2.0 * step);
      EXPECT_NEAR(one.lever_slope[i], slope, 0.3);
    }
  }
  test::expect_parts(test::refusal_of([] {
                       RoughFilm({1e-6, 0.0, 1.0, false, true});
                     }),
                     {"friction_factors: need flow_factors"});
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

/// Positive, monotone, without jumps, and the derivatives are those of the values.
void expect_smooth_into_contact(const RoughnessOptions& options) {
  const RoughFilm rough(options);
  const double sigma = rough.sigma(), step = 1e-2 * sigma;
  const int n = 801;
  FilmCells film;
  film.resize(n);
  const Eigen::ArrayXd gaps = Eigen::ArrayXd::LinSpaced(n, -3.0 * sigma, 5.0 * sigma);
  rough.thicknesses(gaps, film);
  const auto reaches = [&](int i, double end) {  // to rounding
    return std::abs(gaps[i] / sigma - end) < 1.01e-2;
  };
  using Pair = std::pair<const Eigen::ArrayXd*, const Eigen::ArrayXd*>;
  for (const auto& [values, slopes] :
       {Pair{&film.content, &film.d_content}, Pair{&film.flow_axial, &film.d_flow_axial},
        Pair{&film.flow_angle, &film.d_flow_angle}, Pair{&film.carry, &film.d_carry}}) {
    for (int i = 1; i < n; ++i) {
      const double rise = (*values)[i] - (*values)[i - 1];
      ASSERT_GT((*values)[i - 1], 0.0) << options.peklenik << " cell " << i;
      ASSERT_GT(rise, 0.0) << options.peklenik << " cell " << i;
      ASSERT_LT(rise, 2.0 * step) << options.peklenik << " cell " << i;
      // The mean of the slopes, except across the end of a range, where they jump.
      const double low = (*slopes)[i - 1], high = (*slopes)[i];
      if (std::abs(high - low) < 0.05 && !reaches(i, 0.5) && !reaches(i, 1.0)) {
        ASSERT_NEAR(rise / step, 0.5 * (low + high), 1e-3) << options.peklenik << " cell " << i;
      }
    }
  }
}

TEST(RoughFilm, HardN4_ThicknessesArePositiveAndMonotoneIntoContactForEveryPattern) {
  // Rows 1/9 and 1/6, and across them 9 and 6, have no shear factor: equal walls need none.
  for (double peklenik : {1.0 / 9.0, 1.0 / 6.0, 1.0 / 3.0, 1.0, 3.0, 6.0, 9.0})
    expect_smooth_into_contact({0.7e-6, 0.7e-6, peklenik, true});
  for (double peklenik : {1.0 / 3.0, 1.0, 3.0, 6.0}) {
    expect_smooth_into_contact({1e-6, 0.0, peklenik, true});
    expect_smooth_into_contact({0.2e-6, 0.8e-6, peklenik, true});
  }
}

TEST(RoughFilm, HardN5_EqualWallsNeedNoShearFactor) {
  // p p - l l, contracted to a fused multiply-add (gcc -ffp-contract=fast, clang by default), is
  // the rounding of l l: equal walls then carried a little less than h_T.
  FilmCells film;
  film.resize(1);
  for (double peklenik : {1.0 / 9.0, 1.0 / 6.0, 9.0})
    for (int k = 1; k <= 100; ++k) {
      const double wall = 1e-8 * k;
      RoughFilm({wall, wall, peklenik, true}).thicknesses(Eigen::ArrayXd::Constant(1, wall), film);
      EXPECT_EQ(film.carry[0], film.content[0]);
      RoughFilm({wall, 2.0 * wall, peklenik, true})
          .thicknesses(Eigen::ArrayXd::Constant(1, wall), film);
      EXPECT_GT(film.carry[0], film.content[0]);
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
                     {"flow_factors: need a roughness above 0: both walls are smooth"});
}

}  // namespace
}  // namespace clatter::film
