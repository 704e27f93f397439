// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/film/viscosity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/base/error.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

TEST(OilViscosity, VogelAndWaltherGiveHandValues) {
  EXPECT_NEAR(viscosity_of(VogelLaw{5e-5, 1000.0, 180.0}, 380.0), 5e-5 * std::exp(5.0), 1e-15);
  const WaltherLaw law{{313.15, 373.15}, {105e-6, 14.2e-6}, 860.0};
  EXPECT_NEAR(viscosity_of(law, 313.15), 860.0 * 105e-6, 1e-13);
  EXPECT_NEAR(viscosity_of(law, 373.15), 860.0 * 14.2e-6, 1e-14);
  // 70 degrees by hand: log10 log10 105.7 = 0.306226, log10 log10 14.9 = 0.069367, share 0.52189
  // of the way in log T, so 0.182614: nu = 10^(10^0.182614) - 0.7 = 32.62 mm2/s.
  EXPECT_NEAR(viscosity_of(law, 343.15) / 860.0 * 1e6, 32.62, 0.01);
}

TEST(OilViscosity, CrossFallsFromOneToItsRatioAndItsSlopeIsItsDerivative) {
  const CrossLaw law{1e6, 0.4, 0.8};
  EXPECT_EQ(shear_thinning(law, 0.0).value, 1.0);
  EXPECT_NEAR(shear_thinning(law, 1e6).value, 0.7, 1e-15);
  EXPECT_NEAR(shear_thinning(law, 1e16).value, 0.4, 1e-7);
  for (const double rate : {1e3, 1e6, 3e7}) {
    const double d = 1e-5;
    const double slope = (shear_thinning(law, rate * std::exp(d)).value -
                          shear_thinning(law, rate * std::exp(-d)).value) /
                         (2.0 * d);
    EXPECT_NEAR(shear_thinning(law, rate).slope, slope, 1e-9);
  }
  EXPECT_EQ(shear_thinning({1e6, 1.0, 0.8}, 1e7).value, 1.0);
}

TEST(OilViscosity, FollowsTheTemperatureOverTheHeight) {
  ViscosityOptions options;
  options.vogel = {5e-5, 1000.0, 180.0};
  options.height = {0.1, 0.2};
  options.temperature = {360.0, 400.0};
  const Viscosity oil(options, 1.0);
  EXPECT_TRUE(oil.varies());
  EXPECT_EQ(oil.reference(), viscosity_of(*options.vogel, 360.0));
  EXPECT_EQ(oil.at_height(0.05), oil.reference());
  EXPECT_NEAR(oil.at_height(0.15), viscosity_of(*options.vogel, 380.0), 1e-15);
  EXPECT_EQ(oil.at_height(0.3), viscosity_of(*options.vogel, 400.0));
  options.temperature = {360.0, 170.0};
  test::expect_parts(test::refusal_of([&] { Viscosity(options, 1.0); }),
                     {"viscosity: found ", " at 170 K, expected "});
}

/// Flow of a slider whose oil thickens with pressure, at each face from p itself: its spread.
double flow_spread(int cells, double& highest) {
  const double mu = 0.03, speed = 1.0;
  ViscosityOptions options;
  options.pressure_coefficient = 2e-8;
  const Viscosity oil(options, mu);
  const PadGrid grid = strip(0.0, 0.02, cells);
  const Eigen::ArrayXd gap = along(grid, [](double x) { return 4e-6 - 1e-4 * x; });
  Reynolds film(grid, strip_edges(), true);
  film.solve(smooth(gap), {}, {1.0, mu, 0.0, 0.5 * speed, true});
  Eigen::ArrayXd p, thickening;
  EXPECT_TRUE(oil.pressure(film.pressure(), p, thickening));
  highest = p.maxCoeff();
  const double flow = film.flows()[0];
  double worst = 0.0;
  for (int j = cells / 8; j + 1 < cells - cells / 8; ++j) {
    // The law itself, mu exp(alpha p), at the middle of two centres.
    const double h = 0.5 * (gap[j] + gap[j + 1]), middle = 0.5 * (p[j] + p[j + 1]),
                 slope = (p[j + 1] - p[j]) / (grid.axial(j + 1) - grid.axial(j)),
                 thick = mu * std::exp(options.pressure_coefficient * middle);
    worst = std::max(
        worst, std::abs((-h * h * h / (12.0 * thick) * slope + 0.5 * speed * h) / flow - 1.0));
  }
  return worst;
}

TEST(OilViscosity, PressureThickeningSolvesTheReynoldsEquationWithBarusLaw) {
  double last = 0.0, highest = 0.0;
  for (const int cells : {50, 100, 200, 400}) {
    const double spread = flow_spread(cells, highest);
    std::printf("    Barus, %3d cells: highest %.1f MPa, flow differs by %.1e (order %.2f)\n",
                cells, 1e-6 * highest, spread, last > 0.0 ? order(last, spread) : 0.0);
    if (last > 0.0) {
      EXPECT_GT(order(last, spread), 1.9);
    }
    last = spread;
  }
  EXPECT_GT(2e-8 * highest, 0.5);  // the oil is at least 1.6 times as thick
}

TEST(OilViscosity, ReducedPressureIsTheInverseAndHasALimit) {
  ViscosityOptions options;
  options.pressure_coefficient = 2e-8;
  const Viscosity oil(options, 0.01);
  Eigen::ArrayXd p, slope;
  const Eigen::ArrayXd given = Eigen::Array3d(0.0, 1e5, 8e7);
  Eigen::ArrayXd reduced(3);
  for (int k = 0; k < 3; ++k) reduced[k] = oil.reduced(given[k]);
  ASSERT_TRUE(oil.pressure(reduced, p, slope));
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(p[k], given[k], 1e-12 * given[k]);
    EXPECT_NEAR(slope[k], std::exp(2e-8 * given[k]), 1e-12 * slope[k]);
  }
  EXPECT_FALSE(oil.pressure(Eigen::ArrayXd::Constant(1, 5e7), p, slope));
}

PistonLinerOptions mixed() {
  PistonLinerOptions options;
  options.cells_around = 6;
  options.cells_along = 9;
  options.clearance = 8e-6;
  options.viscosity = 0.02;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  options.roughness = {0.4e-6, 0.3e-6, 1.0, true};
  return options;
}

Eigen::VectorXd force_of(const PistonLinerOptions& options) {
  const auto element = make_element(options, false);
  const Eigen::VectorXd y = pushed(*element, false, 6e-6, 2e-5), rest = 0.0 * y;
  dynamics::Response response;
  element->begin_step(2e-3);
  const dynamics::Stage first{2e-3, 1e-12, 0, {}};
  element->evaluate(first, y, rest, false, response);
  element->finish_stage(first);
  element->accept_step(2e-3);
  Eigen::VectorXd v = rest;
  v[1] = 5e-3;
  element->evaluate({2e-3 + 2e-6, 2e-6, 1, {2e-6}}, y + 2e-6 * v, v, false, response);
  return response.force;
}

TEST(OilViscosity, LawsThatChangeNothingGiveTheForcesOfConstantViscosity) {
  const PistonLinerOptions plain = mixed();
  const Eigen::VectorXd force = force_of(plain);
  const auto differs = [&](const PistonLinerOptions& options) {
    return (force_of(options) - force).norm() / force.norm();
  };
  // One temperature is a constant: to the bit.
  PistonLinerOptions one = plain;
  one.oil.walther = {{313.15, 373.15}, {105e-6, 14.2e-6}, 860.0};
  one.oil.temperature = {350.0};
  PistonLinerOptions same = plain;
  same.viscosity = viscosity_of(*one.oil.walther, 350.0);
  EXPECT_EQ(force_of(one), force_of(same));
  // The same temperature at all heights, no thinning, hardly any thickening: to rounding.
  PistonLinerOptions level = plain;
  level.oil.vogel = {0.02 / std::exp(1.0), 200.0, 180.0};
  level.oil.height = {0.0, 0.3};
  level.oil.temperature = {380.0, 380.0};
  EXPECT_LT(differs(level), 1e-12);
  PistonLinerOptions newtonian = plain;
  newtonian.oil.cross = {1e6, 1.0, 0.8};
  EXPECT_LT(differs(newtonian), 1e-12);
  PistonLinerOptions barus = plain;
  barus.oil.pressure_coefficient = 1e-20;
  EXPECT_LT(differs(barus), 1e-10);
  // And each does something when it is there.
  level.oil.temperature = {380.0, 400.0};
  newtonian.oil.cross->ratio = 0.5;
  barus.oil.pressure_coefficient = 2e-8;
  for (const PistonLinerOptions* options : {&level, &newtonian, &barus})
    EXPECT_GT(differs(*options), 1e-4);
}

TEST(OilViscosity, ThinningByHalfIsTheForceOfHalfTheViscosity) {
  PistonLinerOptions thinned = mixed(), half = mixed();
  thinned.oil.cross = {1e-3, 0.5, 1.0};  // at all rates of the film
  half.viscosity *= 0.5;
  const Eigen::VectorXd a = force_of(thinned), b = force_of(half);
  EXPECT_LT((a - b).norm(), 1e-7 * b.norm());
}

}  // namespace
}  // namespace clatter::film
