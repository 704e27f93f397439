// SPDX-License-Identifier: GPL-3.0-or-later
// Steady sliders with known answers; references in the comments.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/film/friction.hpp"
#include "film_march.hpp"

namespace clatter::film {
namespace {

// W* = W' h2^2 / (mu U L^2): mu = U = L = h2 = 1. The runner slides at speed 1: mean wall speed
// 1/2.
struct Wedge {
  double load, peak, friction, residual;
};

Wedge solve_wedge(const std::function<double(double)>& gap, int cells) {
  const PadGrid grid = strip(0.0, 1.0, cells);
  Reynolds film(grid, strip_edges(), true);
  const FilmCells cells_of = smooth(along(grid, gap));
  film.solve(cells_of, {}, {1.0, 1.0, 0.0, 0.5, true});
  // In the frame of the grid the opposite wall runs at +1, so this body slides at -1.
  Friction friction({0.1, 1e-2}, grid.size());
  const ShearThickness shear{cells_of.content.inverse(), -cells_of.content.square().inverse(),
                             cells_of.content, cells_of.d_content};
  friction.add_film(film, {film.pressure()}, shear, 1.0, -1.0);
  return {load(film), film.pressure().maxCoeff(), friction.force().sum(), film.residual()};
}

TEST(InclinedSlider, ConvergesToTheClosedFormAtSecondOrder) {
  // h1/h2 = 2: W* = 6 ln 2 - 4, F* = 4 ln 2 - 2, p* = 1/4 at x = 2/3 (Reynolds 1886).
  const double exact_load = 0.158883, exact_friction = 0.772589;
  const double w = 6.0 * std::log(2.0) - 4.0, f = 4.0 * std::log(2.0) - 2.0;
  EXPECT_NEAR(w, exact_load, 5e-7);  // printed digits of the reference
  EXPECT_NEAR(f, exact_friction, 5e-7);
  double last_load = 0.0, last_friction = 0.0;
  for (int cells : {24, 48, 96, 192}) {
    const Wedge wedge = solve_wedge([](double x) { return 2.0 - x; }, cells);
    const double load_error = wedge.load / w - 1.0, friction_error = wedge.friction / f - 1.0;
    std::printf(
        "inclined slider n=%3d  W* %.7f (%+.2e, order %.2f)  F* %.7f (%+.2e, order %.2f)  p* "
        "%.7f\n",
        cells, wedge.load, load_error, order(last_load, load_error), wedge.friction, friction_error,
        order(last_friction, friction_error), wedge.peak);
    if (last_load != 0.0) {
      EXPECT_NEAR(order(last_load, load_error), 2.0, 0.1);  // midpoint rule on a smooth pressure
      EXPECT_NEAR(order(last_friction, friction_error), 2.0, 0.1);
    }
    last_load = load_error;
    last_friction = friction_error;
  }
  EXPECT_LT(std::abs(last_load), 1e-4);
  EXPECT_LT(std::abs(last_friction), 1e-4);
  const Wedge fine = solve_wedge([](double x) { return 2.0 - x; }, 192);
  EXPECT_NEAR(fine.peak, 0.25, 1e-4);  // a centre lies within half a cell of x = 2/3
}

TEST(InclinedSlider, PressureOfALinearWedgeIsExactAtTheCentresUpToTheEnds) {
  // The face law integrates a linear gap exactly; only the half cells at the ends carry an error,
  // O(dx^2).
  const int cells = 64;
  const PadGrid grid = strip(0.0, 1.0, cells);
  Reynolds film(grid, strip_edges(), true);
  const FilmCells wedge = smooth(along(grid, [](double x) { return 2.0 - x; }));
  film.solve(wedge, {}, {1.0, 1.0, 0.0, 0.5, true});
  double worst = 0.0;
  for (int j = 0; j < cells; ++j) {
    const double h = wedge.content[j];
    // p = 6 (1/h - 1/h1 ... ): p = 6 (h - 1)(2 - h) / (3 h^2).
    worst = std::max(worst, std::abs(film.pressure()[j] - 2.0 * (h - 1.0) * (2.0 - h) / (h * h)));
  }
  std::printf("inclined slider n=64  largest pressure error %.2e of p* = .25\n", worst);
  EXPECT_LT(worst, 1.5 / (cells * cells));
}

TEST(InclinedSlider, OptimumAndRayleighStepGiveTheirKnownLoads) {
  const double optimum = solve_wedge([](double x) { return 2.18870 - 1.18870 * x; }, 400).load;
  std::printf("optimal slider n=400 W* %.6f (%+.2e)\n", optimum, optimum / 0.160243 - 1.0);
  EXPECT_NEAR(optimum, 0.160243, 1e-5);  // discretisation at n = 400
  // The step at .7182 L lies on a face at 51/71 of the cells; at the optimum the load feels errors
  // of second order only.
  const double step =
      solve_wedge([](double x) { return x < 51.0 / 71.0 ? 1.8660 : 1.0; }, 284).load;
  std::printf("Rayleigh step n=284 W* %.6f (%+.2e)\n", step, step / 0.206267 - 1.0);
  EXPECT_NEAR(step, 0.206267, 1e-6);  // printed digits
}

TEST(RayleighStep, OffItsOptimumConvergesAtFirstOrder) {
  // A jump of the gap at a face is outside the smooth face law: p_step = 6 (h1 - h2) / (h1^3/L1 +
  // h2^3/L2), W = p_step / 2.
  const double exact = 0.5 * 6.0 * 1.5 / (2.5 * 2.5 * 2.5 / 0.5 + 1.0 / 0.5);
  double last = 0.0;
  for (int cells : {40, 80, 160, 320}) {
    const double error =
        solve_wedge([](double x) { return x < 0.5 ? 2.5 : 1.0; }, cells).load / exact - 1.0;
    std::printf("Rayleigh step 2.5:1 n=%3d error %+.2e order %.2f\n", cells, error,
                order(last, error));
    if (last != 0.0) {
      EXPECT_NEAR(order(last, error), 1.0, 0.1);
    }
    last = error;
  }
  EXPECT_LT(std::abs(last), 1e-2);
}

TEST(ParabolicSlider, RuptureLoadPeakAndExitFillMatchTheReference) {
  // L = 76.2 mm, 8/4 um, U = 4.57 m/s, mu = .039, p = 0 at both ends; quadrature with the Reynolds
  // condition at rupture, which JFO shares.
  const double length = 76.2e-3, speed = 4.57, viscosity = 0.039;
  const double rupture_ref = 0.67893443, peak_ref = 1.44829842e8, load_ref = 4.08666522e6,
               fill_ref = 0.564035;
  double last = 0.0;
  for (int cells : {50, 100, 200, 400, 800}) {
    const PadGrid grid = strip(0.0, length, cells);
    Reynolds film(grid, strip_edges(), true);
    const FilmCells gap = smooth(
        along(grid, [&](double x) { return 4e-6 + 4e-6 * std::pow(2.0 * x / length - 1.0, 2); }));
    const int solves = film.solve(gap, {}, {1.0, viscosity, 0.0, 0.5 * speed, true});
    int full = 0;
    while (full < cells && film.is_full(full)) ++full;
    // What leaves over the end was dragged out of the last half cell: theta at the edge = flow /
    // (U/2 h).
    const double fill = film.fill()[cells - 1] * gap.content[cells - 1] / 8e-6;
    const double load_error = load(film) / load_ref - 1.0;
    std::printf(
        "parabolic slider n=%3d rupture %.5f (%+.1e)  p_max %+.1e  W' %+.2e (order %.2f)  "
        "theta_exit %.6f (%+.1e) solves %d residual %.1e\n",
        cells, double(full) / cells, double(full) / cells - rupture_ref,
        film.pressure().maxCoeff() / peak_ref - 1.0, load_error, order(last, load_error), fill,
        fill / fill_ref - 1.0, solves, film.residual());
    last = load_error;
    if (cells < 800) continue;
    EXPECT_NEAR(double(full) / cells, rupture_ref, 2.0 / cells);  // rupture lies on a face
    EXPECT_NEAR(film.pressure().maxCoeff() / peak_ref, 1.0, 1e-4);
    EXPECT_NEAR(load_error, 0.0, 1e-4);
    EXPECT_NEAR(fill / fill_ref, 1.0, 2e-3);
  }
}

}  // namespace
}  // namespace clatter::film
