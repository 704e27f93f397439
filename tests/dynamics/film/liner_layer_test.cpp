// SPDX-License-Identifier: GPL-3.0-or-later
// The layer of oil that is remembered on the liner.
#include "dynamics/film/liner_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/base/error.hpp"
#include "film_march.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

constexpr double kUm = 1e-6;

/// Two columns of 1 m, the skirt from 0 to 4 m above the pin, cells of 1 m.
PadGrid wide_pad() { return PadGrid::uniform(0.0, 2.0, 2, 0.0, 4.0, 4, 1.0); }

LinerLayerOptions wide_liner() {
  LinerLayerOptions options;
  options.bottom = 0.0;
  options.top = 10.0;
  return options;
}

EdgeVolumes volumes(double lower, double upper) {
  EdgeVolumes out;
  out.lower = Eigen::ArrayXd::Constant(2, lower);
  out.upper = Eigen::ArrayXd::Constant(2, upper);
  return out;
}

TEST(LinerLayer, EdgesTakeWhatTheySweepAndLeaveWhatFlowsOut) {
  LinerLayer layer(wide_liner(), wide_pad());
  layer.start(2.0, 6.0);  // the pad is from 2 to 6 m
  EXPECT_DOUBLE_EQ(layer.volume(), 2.0 * 6.0 * 6.0);
  Eigen::ArrayXd lower, upper;
  layer.meet(1.5, lower, upper);
  EXPECT_NEAR(upper[0], 6.0, 1e-12);
  // Up by 1.5 m: 9 m2 lie on the way, the film takes 7 of them and leaves 3 at its lower edge.
  layer.advance(1.0, 1.5, volumes(3.0, -7.0), {});
  const Eigen::ArrayXXd after = layer.thickness();
  EXPECT_NEAR(after(1, 1), 6.0, 1e-12);
  EXPECT_NEAR(after(0, 2), 2.0, 1e-12);  // 3 m2 on 1.5 m
  EXPECT_NEAR(after(0, 3), 2.0, 1e-12);  // free on its lower half
  EXPECT_EQ(after(0, 4), 0.0);
  EXPECT_NEAR(after(0, 7), 6.0 + 2.0 / 0.5, 1e-12);  // what was not taken, on the free half
  EXPECT_NEAR(after(0, 8), 6.0, 1e-12);
  EXPECT_NEAR(layer.volume(), 2.0 * (36.0 + 3.0 - 7.0), 1e-12);
}

TEST(LinerLayer, WhatTheFilmTakesTooMuchIsOwed) {
  LinerLayerOptions options = wide_liner();
  options.splash = 10.0;
  options.splash_thickness = 1.0;
  LinerLayer layer(options, wide_pad());
  layer.start(2.0, 0.0);
  layer.advance(0.0, -0.5, volumes(-1.0, 0.0), {});
  EXPECT_NEAR(layer.volume(), -2.0, 1e-12);
  layer.advance(1.0, 0.0, volumes(0.0, 0.0), {});  // the splash brings 1.5 m of 1 m
  layer.advance(0.0, 0.0, volumes(0.0, 0.0), {});
  EXPECT_NEAR(layer.volume(), 2.0 * (1.5 - 1.0), 1e-12);
  EXPECT_NEAR(layer.balance().supplied, 3.0, 1e-12);
  EXPECT_GE(layer.thickness().minCoeff(), 0.0);
}

TEST(LinerLayer, SplashRefillsAtItsRateUpToItsThicknessAndMoreDripsOff) {
  LinerLayerOptions options = wide_liner();
  options.splash = 0.5;
  options.splash_thickness = 3.0;
  options.most = 4.0;
  LinerLayer layer(options, wide_pad());
  layer.start(3.0, 1.0);
  for (const double expected : {1.5, 2.0, 2.5, 3.0, 3.0}) {
    layer.advance(1.0, 0.0, volumes(0.0, 0.0), {});
    EXPECT_NEAR(layer.thickness()(0, 1), expected, 1e-12);
    EXPECT_NEAR(layer.thickness()(0, 8), 1.0, 1e-12);  // above the skirt nothing reaches it
  }
  layer.advance(1.0, -1.0, volumes(0.0, 0.0), {});  // a ridge of 3 + 3 m on the cell below
  EXPECT_NEAR(layer.thickness()(0, 1), 4.0, 1e-12);
  EXPECT_NEAR(layer.balance().dripped, 2.0 * 2.0, 1e-12);
}

// The closed form: after a ring the layer is min(t, t_ring), in however many steps it passed.
TEST(LinerLayer, ARingThinsTheLayerToItsClosedFormInAnyNumberOfSteps) {
  const RingOptions ring{8.5, 0.02, 1000.0, 0.0};
  const double t_ring = ring_layer(ring, 0.01, -10.0);
  EXPECT_NEAR(t_ring, 1.5 * 0.01 * 10.0 * 0.02 / 1000.0, 1e-18);  // 3 um
  LinerLayerOptions options = wide_liner();
  options.top = 20.0;
  options.rings = {ring};
  for (const double before : {8.0 * kUm, 2.0 * kUm})
    for (const int steps : {1, 7, 1000}) {
      LinerLayer layer(options, wide_pad());
      layer.start(0.0, before);
      const double first = layer.volume();
      for (int k = 0; k < steps; ++k) layer.advance(0.0, 4.5 / steps, volumes(0.0, 0.0), {t_ring});
      // The ring went from 8.5 to 13 m; the skirt, whose top is at 8.5 m, pushed its oil ahead.
      for (const int cell : {9, 10, 11, 12})
        EXPECT_NEAR(layer.thickness()(0, cell), std::min(before, t_ring), 1e-9 * before) << steps;
      EXPECT_NEAR(layer.thickness()(0, 13), before, 1e-9 * before) << steps;
      EXPECT_NEAR(layer.balance().scraped, first - layer.volume(), 1e-12 * first);
    }
}

// Martin's film against a numerical solution for a ring of finite width, wide against its film.
TEST(LinerLayer, TheLayerOfARingIsThatOfTheReynoldsEquation) {
  const double radius = 0.02, h_0 = 2e-6, mu = 0.01, speed = 8.0, half = 16e-3;
  double last = 0.0;
  for (const int cells : {1000, 2000, 4000}) {
    const PadGrid grid = strip(-half, half, cells);
    Reynolds film(grid, strip_edges(), true);
    film.solve(smooth(along(grid, [&](double x) { return h_0 + 0.5 * x * x / radius; })), {},
               {1.0, mu, 0.0, 0.5 * speed, true});
    RingOptions ring{0.1, radius, load(film), 0.0};
    const double layer = ring_layer(ring, mu, speed),
                 flow = film.flows()[film.flows().size() - cells - 1],
                 error = speed * layer / flow - 1.0;
    std::printf("    ring, %4d cells: load %.0f N/m, layer %.4f um, law %+.2e\n", cells, ring.load,
                1e6 * flow / speed, error);
    last = error;
  }
  EXPECT_LT(std::abs(last),
            1e-3);  // half of its width over sqrt(2 R h_0) is 57: the load lacks 1 / 57^2
}

TEST(LinerLayer, HardCasesOfItsOptionsAreRefused) {
  LinerLayerOptions options = wide_liner();
  options.top = 3.0;
  test::expect_parts(test::refusal_of([&] { LinerLayer(options, wide_pad()); }),
                     {"oil on the liner: found cells of 1 m from 0 to 3 m", "skirt's length, 4 m"});
  options = wide_liner();
  options.cell = 1e-7;
  test::expect_parts(test::refusal_of([&] { LinerLayer(options, wide_pad()); }),
                     {"found 1e+08 x 2 cells, expected at most 1e+07"});
  options = wide_liner();
  options.rings = {{3.0, 0.02, 1000.0, 0.0}};
  test::expect_parts(test::refusal_of([&] { LinerLayer(options, wide_pad()); }),
                     {"found a ring at 3 m", "above the skirt's top, 4 m"});
}

/// A hump of oil on the liner that a wide gap passes, back to where it was: mean error.
double hump_error(int cells, const dynamics::Tableau& A) {
  const PadGrid grid = strip(0.0, 0.06, cells);
  LinerLayerOptions options;
  options.top = 0.2;
  LinerLayer layer(options, grid);
  const Edge open = Edge::supply(0.0, 1.0, 0.0);
  Reynolds film(grid, strip_edges(open, open), true);
  OilContent oil(film);
  layer.start(0.02, 1e-6);
  const auto hump = [](double z) {
    return 1e-6 + 5e-6 * std::exp(-std::pow((z - 0.11) / 0.01, 2));
  };
  std::vector<double> state;
  layer.save(state);
  const Eigen::VectorXd z = layer.heights();
  for (Eigen::Index k = 0; k < z.size(); ++k)
    if (state[k] > 0.0) state[k] = hump(z[k]) * (z[1] - z[0]);
  layer.restore(state.begin());
  const Eigen::ArrayXXd first = layer.thickness();
  const double gap = 40e-6;
  const FilmCells film_cells = smooth(Eigen::ArrayXd::Constant(cells, gap));
  oil.start(Eigen::ArrayXd::Constant(cells, 1e-6));
  const int steps = 6 * cells;
  const double dt = 1.0 / steps;
  const auto speed = [](double t) {
    return 0.1 * std::numbers::pi * std::sin(2.0 * std::numbers::pi * t);
  };
  OutsideLayers outside;
  double rates[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < steps; ++k) {
    const double t = k * dt;
    rates[0] = speed(t);
    rates[1] = speed(t + A.c_1 * dt);
    rates[2] = speed(t + dt);
    double travel = 0.0;
    for (int i = 1; i <= 2; ++i) {
      const std::vector<double> weights =
          i == 1 ? std::vector<double>{A.a_10 * dt} : std::vector<double>{A.a_20 * dt, A.a_21 * dt};
      FilmStage stage{A.d * dt, 0.01, 0.0, -0.5 * rates[i]};
      stage.cavity = Cavity::kLayer;
      if (k > 0) stage.profile_before = &oil.profile();
      travel = A.d * dt * rates[i];
      for (size_t j = 0; j < weights.size(); ++j) travel += weights[j] * rates[j];
      layer.meet(travel, outside.begin, outside.end);
      stage.outside = &outside;
      film.solve(film_cells, oil.before(film, weights), stage);
      oil.finish_stage(film, i, stage.kappa, weights);
    }
    oil.accept_step();
    EdgeVolumes edges;
    film.pad().add_up_edges(oil.moved(), edges);
    layer.advance(dt, travel, edges, {});
  }
  const Eigen::ArrayXXd last = layer.thickness();
  double error = 0.0, sum = 0.0;
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    if (first(0, k) == 0.0 || last(0, k) == 0.0) continue;
    error += std::abs(last(0, k) - first(0, k));
    sum += first(0, k) - 1e-6;
  }
  EXPECT_NEAR(layer.volume() + oil.content().sum() * grid.area()[0],
              (first.sum() * (z[1] - z[0])) + 1e-6 * 0.06, 1e-4 * 0.2 * 1e-6);
  return error / sum;
}

TEST(LinerLayer, AHumpThatTheSkirtPassesReturnsAtTheOrderOfTheScheme) {
  for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    double last = 0.0;
    for (const int cells : {30, 60, 120, 240}) {
      const double error = hump_error(cells, *method);
      std::printf("    %-7s %3d cells: error of the hump %.2e (order %.2f)\n", method->name.c_str(),
                  cells, error, last > 0.0 ? order(last, error) : 0.0);
      if (cells == 240) {
        EXPECT_GT(order(last, error), 1.3);
      }
      last = error;
    }
    EXPECT_LT(last, 0.02);
  }
}

}  // namespace
}  // namespace clatter::film
