// SPDX-License-Identifier: GPL-3.0-or-later
// The closed ring as a journal bearing: long, short and finite, half-speed whirl, closed oil.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "dynamics/film/recess.hpp"
#include "film_march.hpp"

namespace clatter::film {
namespace {

struct Carried {
  double load, attitude;  // [N], [deg]
};

/// A bearing of R = c = mu = U = 1 with a full groove at the widest gap, one cell wide, where
/// p = 0: there JFO and the Reynolds condition agree. `groove`: its column; the ring is closed at
/// its first one. `length` 0: infinitely long, per length.
Carried bearing(double eccentricity, double length, int around, int along, int groove) {
  const bool is_long = length == 0.0;
  const double width = is_long ? 1.0 : length;
  const PadGrid grid = PadGrid::uniform(0.0, 2.0 * std::numbers::pi, around, -0.5 * width,
                                        0.5 * width, along, 1.0, true);
  const Edge side = is_long ? Edge::wall() : Edge{};
  Reynolds film(grid, {{}, {}, side, side}, true, true);
  Recess supply{.bottom = -width, .top = width, .angle_begin = grid.angle_edges()[groove]};
  supply.angle_span = 2.0 * std::numbers::pi / around;
  RecessCells recesses;
  RecessMap({supply}, grid).at(0.0, recesses);
  const double widest = grid.angle(groove);
  Eigen::ArrayXd h(grid.size());
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j)
      h[grid.cell(i, j)] = 1.0 + eccentricity * std::cos(grid.angle(i) - widest);
  FilmStage stage{1.0, 1.0, 0.5, 0.0, true};
  stage.recesses = &recesses;
  film.solve(smooth(h), {}, stage);
  EXPECT_LT(film.residual(), 1e-10);
  double line = 0.0, across = 0.0;
  for (int i = 0; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double force = film.pressure()[grid.cell(i, j)] * grid.area()[grid.cell(i, j)];
      line -= force * std::cos(grid.angle(i) - widest);
      across += force * std::sin(grid.angle(i) - widest);
    }
  return {std::hypot(line, across), std::atan2(across, line) * 180.0 / std::numbers::pi};
}

TEST(WholeBearing, ALongOneHasTheReynoldsConditionsLoadAndAttitude) {
  // By quadrature of the one-dimensional equation with p = dp/df = 0 at the rupture.
  struct Case {
    double eccentricity, load, attitude;
  };
  for (const Case& one :
       {Case{0.5, 6.455556, 58.296}, Case{0.8, 15.083281, 42.181}, Case{0.9, 27.653434, 31.667}}) {
    double last = 0.0;
    for (const int n : {90, 180, 360, 720}) {
      const Carried found = bearing(one.eccentricity, 0.0, n, 1, n / 3);
      const double error = found.load / one.load - 1.0;
      std::printf("    long, eps %.1f, %3d cells: load %+.2e (order %.2f), attitude %+.3f deg\n",
                  one.eccentricity, n, error, n > 90 ? order(last, error) : 0.0,
                  found.attitude - one.attitude);
      if (n == 720) {
        // The groove, a cell wide, carries nothing: first order.
        EXPECT_NEAR(error, 0.0, 2e-3);
        EXPECT_NEAR(found.attitude, one.attitude, 0.1);
        EXPECT_GT(order(last, error), 0.9);
      }
      last = error;
    }
  }
}

/// Sommerfeld number of L/D = 1 by Christopherson's method: central differences at nodes of half of
/// the width, relaxed with p >= 0 (Christopherson 1941).
double nodal_sommerfeld(double eccentricity) {
  constexpr int around = 120, along = 20;  // intervals
  const double df = 2.0 * std::numbers::pi / around, dz = 1.0 / along;
  std::array<std::array<double, along + 1>, around + 1> p{};
  const auto cube = [&](double i) { return std::pow(1.0 + eccentricity * std::cos(i * df), 3); };
  for (int sweep = 0; sweep < 600; ++sweep)
    for (int i = 1; i < around; ++i) {
      const double east = cube(i + 0.5) / (df * df), west = cube(i - 0.5) / (df * df),
                   side = cube(i) / (dz * dz), source = 6.0 * eccentricity * std::sin(i * df);
      for (int j = 0; j < along; ++j) {  // j = 0: the middle
        const double before = j > 0 ? p[i][j - 1] : p[i][1];
        const double next =
            (east * p[i + 1][j] + west * p[i - 1][j] + side * (p[i][j + 1] + before) + source) /
            (east + west + 2.0 * side);
        p[i][j] = std::max(0.0, p[i][j] + 1.85 * (next - p[i][j]));
      }
    }
  double line = 0.0, across = 0.0;
  for (int i = 1; i < around; ++i)
    for (int j = 0; j < along; ++j) {
      const double force = p[i][j] * df * dz * (j == 0 ? 1.0 : 2.0);
      line += force * std::cos(i * df);
      across += force * std::sin(i * df);
    }
  return 2.0 / (std::numbers::pi * std::hypot(line, across));
}

TEST(WholeBearing, AFiniteOneHasTheLoadAndAttitudeOfRaimondiAndBoyd) {
  // Raimondi and Boyd 1958, L/D = 1: Sommerfeld number S = mu N R^2 L D / (c^2 W) to three digits.
  struct Case {
    double eccentricity, sommerfeld, attitude;
  };
  for (const Case& one : {Case{0.2, 0.631, 74.02}, Case{0.4, 0.264, 63.10}, Case{0.6, 0.121, 50.58},
                          Case{0.8, 0.0446, 36.24}, Case{0.9, 0.0188, 26.45}}) {
    const Carried found = bearing(one.eccentricity, 2.0, 180, 32, 45);
    const double sommerfeld = 2.0 / (std::numbers::pi * found.load);
    std::printf("    L/D = 1, eps %.1f: S %.4f (table %.4f), attitude %.2f deg (table %.2f)\n",
                one.eccentricity, sommerfeld, one.sommerfeld, found.attitude, one.attitude);
    // Their value at 0.4 is 1.5 % off both this and nodal_sommerfeld().
    EXPECT_NEAR(sommerfeld / one.sommerfeld, 1.0, one.eccentricity == 0.4 ? 0.02 : 5e-3);
    EXPECT_NEAR(found.attitude, one.attitude, one.eccentricity < 0.5 ? 0.8 : 0.2);
    EXPECT_NEAR(sommerfeld / nodal_sommerfeld(one.eccentricity), 1.0, 5e-3);
  }
}

TEST(WholeBearing, AShortOneTendsToOcvirkFromBelow) {
  const double limit = 0.750381;  // eps = .5, W = mu U L^3 / c^2 X
  double last = 0.0;
  for (const double length : {0.4, 0.2, 0.1}) {
    const double x = bearing(0.5, length, 240, 48, 0).load / std::pow(length, 3);
    std::printf("    L/R = %.1f: X %.5f (%+.2e)\n", length, x, x / limit - 1.0);
    if (last > 0.0) {
      EXPECT_LT(std::abs(x - limit), std::abs(last - limit));
    }
    last = x;
  }
  EXPECT_NEAR(last / limit, 1.0, 3e-3);
}

TEST(WholeBearing, ItDoesNotMatterWhereTheRingIsClosed) {
  const Carried one = bearing(0.7, 1.0, 48, 8, 0);
  for (const int groove : {1, 23, 24, 46, 47}) {
    const Carried other = bearing(0.7, 1.0, 48, 8, groove);
    EXPECT_NEAR(other.load / one.load, 1.0, 1e-11);
    EXPECT_NEAR(other.attitude, one.attitude, 1e-9);
  }
}

/// A gap that whirls at `speed` [rad/s] around a ring of R = c = 1.
GivenGap whirling(const PadGrid& grid, double eccentricity, double speed) {
  const auto field = [grid, eccentricity](double phase, double (*of)(double)) {
    Eigen::ArrayXd values(grid.size());
    for (int i = 0; i < grid.n_angle(); ++i)
      for (int j = 0; j < grid.n_axial(); ++j)
        values[grid.cell(i, j)] = eccentricity * of(grid.angle(i) - phase);
    return values;
  };
  return {[=](double t) -> Eigen::ArrayXd { return 1.0 + field(speed * t, std::cos); },
          [=](double t) -> Eigen::ArrayXd { return speed * field(speed * t, std::sin); }};
}

TEST(WholeBearing, AFilmThatWhirlsAtHalfOfTheSpeedHasNoPressure) {
  // h(f - w t / 2) is carried along as it is: oil whirl.
  double last = 0.0;
  for (const int n : {24, 48, 96}) {
    const PadGrid grid = PadGrid::uniform(0.0, 2.0 * std::numbers::pi, n, -0.5, 0.5, 4, 1.0, true);
    const auto highest = [&](double whirl) {
      Reynolds film(grid, {}, false);
      FilmMarch march(film, whirling(grid, 0.6, whirl), {1.0, 1.0, 0.5, 0.0}, 0.0,
                      Eigen::ArrayXd::Ones(grid.size()));
      const double dt = 2.0 / n;
      for (int k = 0; k < n / 4; ++k) march.step(dynamics::tr_bdf2(), dt);
      return film.pressure().abs().maxCoeff();
    };
    const double error = highest(0.5) / highest(0.0);
    std::printf("    %2d cells: pressure in half-speed whirl %.2e of that at rest (order %.2f)\n",
                n, error, n > 24 ? order(last, error) : 0.0);
    if (n > 48) {
      EXPECT_LT(error, 3e-3);
      EXPECT_GT(order(last, error), 1.8);
    }
    last = error;
  }
}

TEST(WholeBearing, AClosedRingKeepsItsOilWhileItCavitates) {
  const PadGrid grid = PadGrid::uniform(0.0, 2.0 * std::numbers::pi, 48, -0.5, 0.5, 3, 1.0, true);
  Reynolds film(grid, {{}, {}, Edge::wall(), Edge::wall()}, true);
  FilmMarch march(film, whirling(grid, 0.6, 0.1), {1.0, 1.0, 0.5, 0.0, false, 1e6}, 0.0,
                  Eigen::ArrayXd::Constant(grid.size(), 0.8));
  const double before = (march.oil().content() * grid.area()).sum();
  for (int k = 0; k < 400; ++k) march.step(dynamics::tr_bdf2(), 0.05);
  EXPECT_NEAR((march.oil().content() * grid.area()).sum() / before, 1.0, 1e-11);
  EXPECT_GT(film.pressure().maxCoeff(), 1.0);
  EXPECT_LT(film.fill().minCoeff(), 0.9);
}

}  // namespace
}  // namespace clatter::film
