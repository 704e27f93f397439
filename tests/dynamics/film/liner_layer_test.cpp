// SPDX-License-Identifier: GPL-3.0-or-later
// The layer of oil that is remembered on the liner.
#include "dynamics/film/liner_layer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/base/error.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"
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

/// A piston that is held on the bore's axis and moves with the crank.
struct Held {
  explicit Held(const PistonLinerOptions& options) : element(make_element(options, false)) {
    rest = Eigen::VectorXd::Zero(element->size());
  }
  void start(double time) {
    const double kappa = 1e-9;
    stages({{time + kappa, kappa, 0, {}}}, time, time + kappa);
  }
  void step(const dynamics::Tableau& A, double time, double dt) {
    const double kappa = A.d * dt;
    stages({{time + A.c_1 * dt, kappa, 1, {A.a_10 * dt}},
            {time + dt, kappa, 2, {A.a_20 * dt, A.a_21 * dt}}},
           time, time + dt);
  }
  void stages(const std::vector<dynamics::Stage>& all, double begin, double end) {
    element->begin_step(begin);
    for (const dynamics::Stage& stage : all) {
      element->evaluate(stage, rest, Eigen::VectorXd::Zero(rest.size()), false, response);
      element->finish_stage(stage);
    }
    element->accept_step(end);
  }
  std::unique_ptr<PistonLiner> element;
  Eigen::VectorXd rest;
  dynamics::Response response;
};

PistonLinerOptions remembered(double clearance, double thickness) {
  PistonLinerOptions options;
  options.cells_around = 2;
  options.cells_along = 14;
  options.clearance = clearance;
  options.effects.asperities = options.effects.friction = false;
  options.roughness = {0.0, 0.0, 1.0, false};
  options.oil_thickness = thickness;
  options.liner_layer.emplace();
  options.liner_layer->bottom = 0.08;
  options.liner_layer->top = 0.32;
  return options;
}

constexpr double kBegin = 6.2e-3;  // [s]; the stroke is fastest and the start step changes nothing

/// A revolution of the crank and a little further, in `steps` steps.
void revolve(Held& piston, const dynamics::Tableau& method, int steps) {
  const double begin = kBegin, end = kBegin + 0.031;
  piston.start(begin);
  for (int k = 0; k < steps; ++k)
    piston.step(method, begin + (end - begin) * k / steps, (end - begin) / steps);
}

TEST(LinerLayer, AUniformLayerReturnsUnchangedFromTheEntireStroke) {
  for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    Held piston(remembered(20e-6, 5e-6));
    revolve(piston, *method, 700);
    double worst = 0.0;
    for (const PadSnapshot& pad : piston.element->snapshot()) {
      for (const double t : pad.liner_oil.reshaped())
        if (t > 0.0) worst = std::max(worst, std::abs(t / 5e-6 - 1.0));
      worst = std::max(worst, (pad.fill.array() * pad.gap.array() / 5e-6 - 1.0).abs().maxCoeff());
    }
    const OilBalance oil = *piston.element->oil_balance();
    std::printf("    %-7s uniform layer after the stroke and back: %.1e, oil missing %.1e\n",
                method->name.c_str(), worst, oil.residue());
    EXPECT_LT(worst, 1e-10);
    EXPECT_LT(oil.residue(), 1e-12);
    EXPECT_GT(oil.moved, 4.0 * 0.12 * 5e-6 * 0.07);  // both pads, both edges, most of the stroke
  }
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
    if (state[static_cast<size_t>(k)] > 0.0)
      state[static_cast<size_t>(k)] = hump(z[k]) * (z[1] - z[0]);
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
  Eigen::ArrayXd lower, upper, moved;
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
      layer.meet(travel, lower, upper);
      film.set_outside_layers(lower, upper);
      film.solve(film_cells, oil.before(film, weights), stage);
      oil.volumes(film, weights, stage.kappa, moved);
      oil.finish_stage(film, film_cells.content, i, stage.kappa);
    }
    oil.accept_step();
    EdgeVolumes edges;
    film.add_up_edges(moved, edges);
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

PistonLinerOptions busy() {
  PistonLinerOptions options = remembered(12e-6, 7e-6);
  options.cells_around = 4;
  options.skirt.barrel_top = 20e-6;
  options.skirt.barrel_bottom = 15e-6;
  options.skirt.ovality = 20e-6;
  LinerLayerOptions& layer = *options.liner_layer;
  layer.splash = 2e-3;
  layer.splash_thickness = 9e-6;
  layer.most = 30e-6;
  layer.rings = {{35e-3, 0.02, 1000.0, 0.5e-6}, {43e-3, 0.01, 500.0, 0.2e-6}};
  options.ends = {0.115, 0.31};  // the skirt leaves the bottom by 15 mm
  return options;
}

TEST(LinerLayer, NoOilIsMissingAfterACycleWithEveryEffect) {
  for (const dynamics::Tableau* method : {&dynamics::sdirk2(), &dynamics::tr_bdf2()}) {
    Held piston(busy());
    piston.rest[1] = 6e-6;
    revolve(piston, *method, 500);
    const OilBalance oil = *piston.element->oil_balance();
    std::printf(
        "    %-7s oil [mm3]: first %.2f, gap %.2f, liner %.2f, supplied %.2f, scraped %.2f, "
        "dripped "
        "%.2f, sides %.3f, ends %.2f; missing %.1e of %.2f moved\n",
        method->name.c_str(), 1e9 * oil.first, 1e9 * oil.gap, 1e9 * oil.liner, 1e9 * oil.supplied,
        1e9 * oil.scraped, 1e9 * oil.dripped, 1e9 * oil.sides, 1e9 * oil.ends, oil.residue(),
        1e9 * oil.moved);
    EXPECT_LT(oil.residue(), 1e-10);
    for (const double part : {oil.supplied, oil.scraped, oil.dripped, oil.sides})
      EXPECT_GT(part, 1e-4 * oil.moved);
    EXPECT_NE(oil.ends, 0.0);
    OilBalance leaky = oil;
    leaky.scraped *= 1.0 + 1e-6;
    EXPECT_GT(leaky.residue(), 1e-10);  // it would be seen
    for (const PadSnapshot& pad : piston.element->snapshot())
      EXPECT_GE(pad.liner_oil.minCoeff(), 0.0);
  }
}

TEST(LinerLayer, NoOilIsMissingAroundTheEntireSkirtAndNoneLeavesOverSides) {
  PistonLinerOptions options = busy();
  options.span = SkirtSpan::kWhole;
  options.cells_around = 12;
  Held piston(options);
  piston.rest[1] = 6e-6;
  revolve(piston, dynamics::tr_bdf2(), 500);
  const OilBalance oil = *piston.element->oil_balance();
  EXPECT_LT(oil.residue(), 1e-10);
  EXPECT_EQ(oil.sides, 0.0);
  EXPECT_GT(oil.moved, 10.0 * oil.first * 0.1);
}

TEST(LinerLayer, AMirroredPistonHasAMirroredLayer) {
  const auto run = [](double lateral) {
    Held piston(busy());
    piston.rest[1] = lateral;
    revolve(piston, dynamics::sdirk2(), 300);
    return piston.element->snapshot();
  };
  const auto one = run(5e-6), other = run(-5e-6);
  for (const int pad : {0, 1}) {
    const Eigen::MatrixXd a = one[static_cast<size_t>(pad)].liner_oil,
                          b = other[static_cast<size_t>(1 - pad)].liner_oil;
    EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-9 * a.maxCoeff());
  }
  EXPECT_GT((one[0].liner_oil - one[1].liner_oil).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(LinerLayer, ARejectedStepChangesNothingAndARestoredStateContinuesBitByBit) {
  const dynamics::Tableau& method = dynamics::tr_bdf2();
  Held piston(busy());
  revolve(piston, method, 200);
  const std::vector<double> saved = piston.element->save();
  const double t = kBegin + 0.031, dt = 5e-5, kappa = method.d * dt;
  piston.element->begin_step(t);
  const dynamics::Stage stage{t + method.c_1 * dt, kappa, 1, {method.a_10 * dt}};
  piston.element->evaluate(stage, piston.rest, piston.rest, false, piston.response);
  piston.element->finish_stage(stage);  // then the step is rejected
  EXPECT_EQ(piston.element->save(), saved);
  Held restored(busy());
  restored.element->restore(saved);
  EXPECT_EQ(restored.element->oil_balance()->missing(), piston.element->oil_balance()->missing());
  for (Held* one : {&piston, &restored})
    for (int k = 0; k < 5; ++k) one->step(method, t + k * dt, dt);
  EXPECT_EQ(restored.element->save(), piston.element->save());
  EXPECT_NE(restored.element->save(), saved);
}

TEST(LinerLayer, IsAbsentUnlessItIsRequested) {
  PistonLinerOptions options = busy();
  const size_t with = make_element(options, false)->save().size();
  options.liner_layer.reset();
  const auto without = make_element(options, false);
  EXPECT_LT(without->save().size(), with);
  EXPECT_FALSE(without->oil_balance().has_value());
  EXPECT_EQ(without->snapshot().front().liner_oil.size(), 0);
}

}  // namespace
}  // namespace clatter::film
