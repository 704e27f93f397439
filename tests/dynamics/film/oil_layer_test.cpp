// SPDX-License-Identifier: GPL-3.0-or-later
// A layer of oil on the liner: its volume at rest, its flux at speed, and both through a reversal.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "film_march.hpp"
#include "piston_scene.hpp"

namespace clatter::film {
namespace {

constexpr double kLayer = 6e-6;

double pressure_at_rest(double gap, Cavity cavity) {
  PistonLinerOptions options;
  options.cells_around = 2;
  options.cells_along = 8;
  options.pad_span = 1.0 * std::numbers::pi / 180.0;  // a gap of nearly one height
  options.clearance = 40e-6;
  options.oil_thickness = kLayer;
  options.cavity = cavity;
  options.effects = {true, true, false, false};
  options.roughness = {0.0, 0.0, 1.0, false};
  PistonLinerBodies bodies;
  bodies.stroke = [](double) { return StrokeState{0.2, 0.0}; };
  PistonLiner element(options, bodies, {0, 1, 2, 3, 4, 5});
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6);
  dynamics::Response response;
  const dynamics::Stage first{0.0, 1e-12, 0, {}};
  element.evaluate(first, y, y, false, response);
  element.finish_stage(first);
  element.accept_step(0.0);
  y[1] = options.clearance - gap;
  element.evaluate({1e-4, 1e-4, 1, {}}, y, Eigen::VectorXd::Zero(6), false, response);
  return element.snapshot().front().pressure.maxCoeff();
}

// Before: a squeezed layer of 6 um filled the gap at 12 um.
TEST(OilLayer, ASqueezedLayerAtRestFillsTheGapOfItsOwnThickness) {
  for (const auto& [cavity, thickness] :
       {std::pair{Cavity::kLayer, kLayer}, std::pair{Cavity::kStriated, 2.0 * kLayer}}) {
    double open = 30e-6, full = 2e-6;  // bisection for the gap at which pressure begins
    while (open - full > 1e-9) {
      const double middle = 0.5 * (open + full);
      (pressure_at_rest(middle, cavity) > 0.0 ? full : open) = middle;
    }
    std::printf("    layer of %.0f um, %s: fills at %.2f um\n", 1e6 * kLayer,
                cavity == Cavity::kLayer ? "layer" : "striated", 1e6 * full);
    EXPECT_NEAR(full, thickness, 2e-9);
  }
}

FilmStage sliding(double dt, double speed, Cavity cavity = Cavity::kLayer) {
  FilmStage stage{dt, 0.01, 0.0, speed};
  stage.cavity = cavity;
  return stage;
}

TEST(OilLayer, ALayerThatEntersKeepsItsThicknessUnderAnyGapAndItsFlux) {
  const int cells = 60;
  const PadGrid grid = strip(0.0, 0.06, cells);
  const double liner = 5.0, u_m = 0.5 * liner;
  const FilmCells film_cells =
      smooth(along(grid, [](double x) { return 1e-6 * (30.0 + 15.0 * std::sin(200.0 * x)); }));
  for (Cavity cavity : {Cavity::kLayer, Cavity::kStriated}) {
    Reynolds film(grid, strip_edges(Edge::supply(0.0, 1.0, kLayer), Edge::supply(0.0, 1.0, kLayer)),
                  true);
    Eigen::ArrayXd content = Eigen::ArrayXd::Zero(cells), profile = content;
    for (int k = 0; k < 1000; ++k) {
      FilmStage stage = sliding(1e-4, u_m, cavity);
      if (k > 0) stage.profile_before = &profile;
      film.solve(film_cells, content, stage);
      content = film.fill() * film_cells.content;
      profile = film.profile();
    }
    const double at_end = film.flows()[film.flows().size() - cells - 1];
    std::printf("    %s: flux %.6f, thickness %.6f to %.6f of the layer's\n",
                cavity == Cavity::kLayer ? "layer" : "striated", at_end / (liner * kLayer),
                content.minCoeff() / kLayer, content.maxCoeff() / kLayer);
    EXPECT_NEAR(at_end, liner * kLayer, 1e-12 * liner * kLayer);
    if (cavity == Cavity::kLayer)
      EXPECT_LT((content - kLayer).abs().maxCoeff(), 1e-12 * kLayer);
    else
      EXPECT_GT(content.mean(), 1.8 * kLayer);
  }
}

// The flux t U of a layer is that of a full film without pressure gradient, h U / 2, at h = 2 t:
// the inlet of a starved film.
TEST(OilLayer, ASlidingLayerFillsAParallelGapOfLessThanTwiceItsThickness) {
  const int cells = 60;
  const PadGrid grid = strip(0.0, 0.06, cells);
  const auto highest = [&](double parallel) {
    const Eigen::ArrayXd gap =
        along(grid, [=](double x) { return parallel + std::max(0.0, 30e-6 * (1.0 - x / 0.03)); });
    Reynolds film(grid, strip_edges(Edge::supply(0.0, 1.0, kLayer), Edge::supply(0.0, 1.0, kLayer)),
                  true);
    Eigen::ArrayXd content = Eigen::ArrayXd::Constant(cells, kLayer);
    for (int k = 0; k < 600; ++k) {
      film.solve(smooth(gap), content, sliding(1e-4, 2.5));
      content = film.fill() * gap;
    }
    return film.pressure().maxCoeff();
  };
  EXPECT_EQ(highest(2.02 * kLayer), 0.0);
  EXPECT_GT(highest(1.98 * kLayer), 1e3);
}

// The hump moves 12 mm with the liner and back.
double error_after_reversal(int cells, double* lost) {
  const PadGrid grid = strip(0.0, 0.06, cells);
  Reynolds film(grid, {Edge::wall(), Edge::wall(), Edge::wall(), Edge::wall()}, true);
  const FilmCells film_cells =
      smooth(along(grid, [](double x) { return 1e-6 * (30.0 + 10.0 * std::cos(80.0 * x)); }));
  const Eigen::ArrayXd first = along(grid, [](double x) {
    return 1e-6 * (2.0 + 5.0 * std::pow(std::cos(std::numbers::pi * (x - 0.02) / 0.12), 16));
  });
  Eigen::ArrayXd content = first, profile = first;
  const int steps = 4 * cells;
  const double dt = 4e-3 / steps;
  double drift = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double liner = 3.0 * std::numbers::pi * std::cos(std::numbers::pi * (k + 0.5) / steps);
    FilmStage stage = sliding(dt, 0.5 * liner);
    stage.profile_before = &profile;
    film.solve(film_cells, content, stage);
    content = film.fill() * film_cells.content;
    profile = film.profile();
    drift = std::max(drift, std::abs(content.sum() / first.sum() - 1.0));
    EXPECT_GE(content.minCoeff(), 0.0);
    EXPECT_LT(film.residual(), 1e-12);
  }
  *lost = drift;
  return (content - first).segment(cells / 6, cells / 2).abs().mean() / 5e-6;
}

TEST(OilLayer, AReversalKeepsTheVolumeToRoundingAndBringsTheLayerBack) {
  double lost = 0.0, last = 0.0;
  for (int cells : {60, 120, 240}) {
    const double error = error_after_reversal(cells, &lost);
    std::printf("    %d cells: volume lost %.1e, error of the layer %.2e (order %.2f)\n", cells,
                lost, error, order(last, error));
    EXPECT_LT(lost, 1e-13);
    last = error;
  }
  EXPECT_LT(last, 0.02);
}

TEST(OilLayer, VolumeAtRestDoesNotMoveAndASignFlipMirrorsIt) {
  const int cells = 40;
  const PadGrid grid = strip(-0.02, 0.02, cells);
  auto run = [&](double mirror, double speed) {
    Reynolds film(grid, strip_edges(Edge::supply(0.0, 1.0, kLayer), Edge::supply(0.0, 1.0, kLayer)),
                  true);
    const Eigen::ArrayXd gap = along(grid, [&](double x) { return 14e-6 + 3e-4 * mirror * x; });
    Eigen::ArrayXd content = Eigen::ArrayXd::Constant(cells, kLayer);
    for (int k = 0; k < 50; ++k) {
      film.solve(smooth(gap), content, sliding(1e-4, speed));
      content = film.fill() * gap;
    }
    return content;
  };
  EXPECT_LT((run(1.0, 0.0) - kLayer).abs().maxCoeff(), 1e-13 * kLayer);
  const Eigen::ArrayXd one = run(1.0, -3.0), other = run(-1.0, 3.0);
  EXPECT_LT((one - other.reverse()).abs().maxCoeff(), 1e-12 * kLayer);
  EXPECT_GT(one.maxCoeff(), 1.5 * kLayer);  // a full film is among them
}

TEST(OilLayer, SteadyFlowIsTheSameWhereverTheOilIs) {
  // Behind a rupture the flux is given: the parabolic slider of slider_test.cpp in time steps.
  const int cells = 100;
  const PadGrid grid = strip(0.0, 76.2e-3, cells);
  const Eigen::ArrayXd gap =
      along(grid, [](double x) { return 4e-6 + 4e-6 * std::pow(2.0 * x / 76.2e-3 - 1.0, 2); });
  Reynolds steady(grid, strip_edges(), true), marched(grid, strip_edges(), true);
  steady.solve(smooth(gap), {}, {1.0, 0.039, 0.0, 0.5 * 4.57, true});
  Eigen::ArrayXd content = gap;
  for (int k = 0; k < 400; ++k) {
    FilmStage stage{1e-3, 0.039, 0.0, 0.5 * 4.57};
    stage.cavity = Cavity::kLayer;
    marched.solve(smooth(gap), content, stage);
    content = marched.fill() * gap;
  }
  EXPECT_LT((steady.pressure() - marched.pressure()).abs().maxCoeff(),
            1e-9 * steady.pressure().maxCoeff());
  // Half of the striated content carries the same flux.
  EXPECT_NEAR(marched.fill()[cells - 1], 0.5 * steady.fill()[cells - 1], 1e-9);
}

}  // namespace
}  // namespace clatter::film
