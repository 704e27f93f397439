// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case N9: a skirt that leaves its liner. Before, film and contact went on beyond the ends.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

constexpr double kBottom = 0.115;

PistonLinerOptions cut_scene() {
  PistonLinerOptions options;
  options.cells_around = 6;
  options.cells_along = 14;  // rows of 5 mm
  options.clearance = 6e-6;
  options.ends.bottom = kBottom;
  return options;
}

std::unique_ptr<PistonLiner> at_height(const PistonLinerOptions& options,
                                       std::function<StrokeState(double)> stroke) {
  PistonLinerBodies bodies;
  bodies.stroke = std::move(stroke);
  return std::make_unique<PistonLiner>(options, bodies, std::vector<int>{0, 1, 2, 3, 4, 5});
}

Eigen::VectorXd leaning(double depth, double tilt = 0.0) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(6);
  y[1] = depth;
  y[3] = tilt;
  return y;
}

void start(PistonLiner& element, const Eigen::VectorXd& y, double time, dynamics::Response& found) {
  const dynamics::Stage first{time, 1e-10, 0, {}};
  element.begin_step(time);
  element.evaluate(first, y, Eigen::VectorXd::Zero(y.size()), true, found);
  element.finish_stage(first);
  element.accept_step(time);
}

void step(PistonLiner& element, const Eigen::VectorXd& y, double time, double dt,
          dynamics::Response& found) {
  element.begin_step(time - dt);
  const dynamics::Stage stage{time, dt, 1, {}};
  element.evaluate(stage, y, Eigen::VectorXd::Zero(y.size()), true, found);
  element.finish_stage(stage);
  element.accept_step(time);
}

double entry(const PistonLiner& element, const std::string& name) {
  dynamics::History history;
  element.record(history);
  for (const auto& one : history.entries())
    if (one.name == name) return one.value;
  ADD_FAILURE() << name;
  return NAN;
}

/// Contact force of a straight skirt pressed against the liner with its pin at `height`.
Eigen::VectorXd dry_force(double height, Eigen::MatrixXd* tangent = nullptr) {
  PistonLinerOptions options = cut_scene();
  options.effects = {false, true, true, false};
  const auto element = at_height(options, [=](double) { return StrokeState{height, 0.0}; });
  dynamics::Response found;
  start(*element, leaning(6.5e-6), 0.0, found);
  if (tangent != nullptr) *tangent = found.tangent;
  return found.force;
}

TEST(HardN9, ContactOverAnEndIsThatOfTheCoveredArea) {
  const double whole = dry_force(0.3)[1];
  double worst = 0.0;
  for (double out : {0.0026, 0.004, 0.0071, 0.01, 0.0333, 0.05, 0.0662}) {
    const double force = dry_force(kBottom + 0.045 - out)[1];
    worst = std::max(worst, std::abs(force / whole - (0.07 - out) / 0.07));
  }
  std::printf("    covered share of the force: largest error %.1e\n", worst);
  test::expect_at_most("error of the covered contact", worst, 1e-13);
  EXPECT_LT(whole, -1e3);
}

TEST(HardN9, ForceAndItsDerivativeAreContinuousThroughThePassage) {
  // The largest change of force and of its derivative by height from sample to sample falls with
  // their distance.
  double jumps[2][2] = {};
  const double distance[] = {1e-4, 2.5e-5};
  for (int k = 0; k < 2; ++k) {
    Eigen::MatrixXd tangent, before;
    Eigen::VectorXd force_before;
    for (double out = -0.005; out < 0.08; out += distance[k]) {
      const Eigen::VectorXd force = dry_force(kBottom + 0.045 - out, &tangent);
      if (before.size() > 0) {
        jumps[0][k] = std::max(jumps[0][k], (force - force_before).cwiseAbs().maxCoeff());
        jumps[1][k] = std::max(jumps[1][k], (tangent.col(2) - before.col(2)).cwiseAbs().maxCoeff());
      }
      force_before = force;
      before = tangent;
    }
  }
  std::printf("    largest steps of the force %.3g, %.3g N, of its derivative %.3g, %.3g N/m\n",
              jumps[0][0], jumps[0][1], jumps[1][0], jumps[1][1]);
  EXPECT_NEAR(jumps[0][0] / jumps[0][1], 4.0, 0.2);
  EXPECT_NEAR(jumps[1][0] / jumps[1][1], 4.0, 0.5);
}

TEST(HardN9, ASkirtThatHasLeftFeelsNothing) {
  for (bool film : {false, true}) {
    PistonLinerOptions options = cut_scene();
    options.effects.film = film;
    // 20 m/s down and out in 5 ms.
    const auto element = at_height(options, [](double t) {
      return StrokeState{0.18 - 20.0 * t, -20.0};
    });
    dynamics::Response found;
    const Eigen::VectorXd y = leaning(5e-6, 1e-5);
    start(*element, y, 0.0, found);
    EXPECT_GT(found.force.cwiseAbs().maxCoeff(), 1.0);
    double volume = INFINITY;
    for (int k = 1; k <= 500; ++k) {
      step(*element, y, 1e-5 * k, 1e-5, found);
      EXPECT_LT(element->film_residual(), 1e-10);
      volume = entry(*element, "film_fill");
    }
    EXPECT_EQ(found.force.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(found.tangent.cwiseAbs().maxCoeff(), 0.0);
    EXPECT_EQ(volume, 0.0);
    for (const PadSnapshot& pad : element->snapshot()) {
      EXPECT_EQ(pad.contact_pressure.cwiseAbs().maxCoeff(), 0.0);
      if (film) {
        EXPECT_EQ(pad.pressure.cwiseAbs().maxCoeff(), 0.0);
      }
    }
  }
}

/// The sample's stroke from 90 to 270 deg; the skirt leaves the liner by 15 mm around 180 deg.
struct Passage {
  double largest_step = 0.0, peak = 0.0;  // of the side force [N]
  double worst_residual = 0.0;
};

Passage pass_bottom(PistonLinerOptions options, int steps) {
  const auto element = at_height(options, crank_stroke);
  dynamics::Response found;
  const Eigen::VectorXd y = leaning(4e-6, 2e-5);
  const double begin = 7.5e-3, dt = 15e-3 / steps;
  start(*element, y, begin, found);
  Passage passage;
  double before = 0.0;
  for (int k = 1; k <= steps; ++k) {
    step(*element, y, begin + k * dt, dt, found);
    const double side = found.force[1];
    if (k > steps / 20)
      passage.largest_step = std::max(passage.largest_step, std::abs(side - before));
    before = side;
    passage.peak = std::max(passage.peak, std::abs(side));
    passage.worst_residual = std::max(passage.worst_residual, element->film_residual());
  }
  return passage;
}

TEST(HardN9, AFilmThatPassesTheEndChangesItsForceContinuously) {
  PistonLinerOptions options = cut_scene();
  options.clearance = 15e-6;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  options.effects.asperities = false;
  for (double layer : {HUGE_VAL, 12e-6}) {
    options.oil_thickness = layer;
    const Passage coarse = pass_bottom(options, 500), fine = pass_bottom(options, 2000);
    std::printf(
        "    layer %.0f um: side force to %.0f N, largest steps %.2f, %.2f N, residual %.0e\n",
        1e6 * layer, fine.peak, coarse.largest_step, fine.largest_step, fine.worst_residual);
    EXPECT_GT(coarse.largest_step / fine.largest_step, 2.5);  // 4 for a smooth force
    test::expect_at_most("residual of a film that passes the end", fine.worst_residual, 1e-10);
  }
}

TEST(HardN9, ALayerComesBackUnderTheLinerAsItLeft) {
  // Oil that clings to the liner stays on it: around the dead centre the covered part holds t.
  PistonLinerOptions options = cut_scene();
  options.clearance = 40e-6;
  options.oil_thickness = 6e-6;
  options.effects.asperities = false;
  double errors[2] = {};
  for (int fine : {0, 1}) {
    const int steps = fine ? 4000 : 2000;
    const auto element = at_height(options, crank_stroke);
    dynamics::Response found;
    const Eigen::VectorXd y = leaning(0.0);
    start(*element, y, 7.5e-3, found);
    for (int k = 1; k <= steps; ++k)
      step(*element, y, 7.5e-3 + k * 15e-3 / steps, 15e-3 / steps, found);
    const PadSnapshot pad = element->snapshot().front();
    const RowMatrix layer = pad.fill.cwiseProduct(pad.gap);
    errors[fine] = (layer.array() / 6e-6 - 1.0).abs().maxCoeff();
  }
  std::printf("    largest error of the layer %.1e, %.1e\n", errors[0], errors[1]);
  test::expect_at_most("error of a layer that comes back", errors[1], 2e-3);
}

TEST(HardN9, OilThatTheSkirtBringsBackIsBoundedByTheSupply) {
  PistonLinerOptions options = cut_scene();
  options.clearance = 20e-6;
  options.effects.asperities = false;
  for (double supply : {0.1e-6, 4e-6}) {
    options.oil_thickness = INFINITY;
    options.initial_fill = 1.0;
    options.supply_fill = supply / 20e-6;
    const auto element = at_height(options, crank_stroke);
    dynamics::Response found;
    const Eigen::VectorXd y = leaning(0.0);
    start(*element, y, 7.5e-3, found);
    for (int k = 1; k <= 2000; ++k) step(*element, y, 7.5e-3 + k * 7.5e-6, 7.5e-6, found);
    const PadSnapshot pad = element->snapshot().front();
    // On the liner at most half of the gap; on the skirt, what it brought.
    const double back = pad.fill.cwiseProduct(pad.gap).col(1).maxCoeff();
    std::printf("    supply %.1f um: %.2f um at the lower end afterwards\n", 1e6 * supply,
                1e6 * back);
    EXPECT_LT(back, 10e-6 + 1.05 * supply);
  }
}

// A skirt that is pressed out of the bore overlaps the liner's extension: there the mean gap of
// rough walls underflows to 0.
TEST(HardN9, WallsThatOverlapOutsideTheLinerAreNeverUsed) {
  const PadGrid grid = PadGrid::uniform(-0.2, 0.2, 3, -0.045, 0.025, 14, 0.0535);
  const CoverMap ends(LinerEnds{kBottom, 0.5}, grid);
  Cover cover;
  ends.at(kBottom + 0.02, cover);
  const Edge open = Edge::supply(2e4, 0.7, 5e-6);
  for (const double speed : {-3.0, 3.0}) {
    const auto solved = [&](double outside, RowMatrix& derivative) {
      Eigen::ArrayXd gap = Eigen::ArrayXd::Constant(grid.size(), 12e-6);
      for (int c = 0; c < grid.size(); ++c)
        if (cover.share[c % grid.n_axial()] == 0.0) gap[c] = outside;
      Reynolds film(grid, {open, open, open, open, open}, true);
      FilmStage stage{1e-5, 0.01, 0.0, speed, false, 2e8};
      stage.cavity = Cavity::kLayer;
      stage.cover = &cover;
      const Eigen::ArrayXd before = 11e-6 * cover.of_cells(grid.n_angle());
      film.solve(smooth(gap), before, stage);
      const Eigen::VectorXd height = Eigen::VectorXd::Ones(1);
      film.sensitivities(RowMatrix::Ones(grid.size(), 1), derivative, &height);
      return film;
    };
    RowMatrix expected, found;
    const Reynolds open_gap = solved(10e-6, expected);
    for (const double outside : {0.0, -50e-6}) {
      const Reynolds overlap = solved(outside, found);
      EXPECT_TRUE(overlap.flows().allFinite());
      EXPECT_EQ((overlap.flows() - open_gap.flows()).abs().maxCoeff(), 0.0);
      EXPECT_EQ((overlap.fill() - open_gap.fill()).abs().maxCoeff(), 0.0);
      EXPECT_TRUE(found.allFinite());
      EXPECT_EQ((found - expected).cwiseAbs().maxCoeff(), 0.0);
    }
    test::expect_at_most("smallest share of a cover", cover.share.minCoeff(), 1e-12);
  }
}

TEST(HardN9, MassIsKeptWhileRowsLeaveAndReturn) {
  const int cells = 20;
  const PadGrid grid = strip(-0.045, 0.025, cells);
  const CoverMap ends(LinerEnds{kBottom, 0.19}, grid);
  const Eigen::ArrayXd gap =
      along(grid, [](double z) { return 15e-6 + 8e-6 * std::sin(90.0 * z); });
  for (Cavity cavity : {Cavity::kLayer, Cavity::kStriated}) {
    const Edge open = Edge::supply(2e4, 0.7, 5e-6);
    Reynolds film(grid, {Edge::wall(), Edge::wall(), open, open, open}, true);
    Cover cover;
    const double dt = 2e-5, w = 200.0;
    const auto height = [&](double t) { return 0.15 + 0.04 * std::cos(w * t); };
    ends.at(height(0.0), cover);
    Eigen::ArrayXd content = 0.7 * gap * cover.of_cells(1), profile;
    double volume = (content * grid.area()).sum(), worst = 0.0;
    const double first = volume;
    double crossed = 0.0, least = INFINITY;
    for (int k = 1; k <= 2000; ++k) {
      ends.at(height(k * dt), cover);
      const Eigen::ArrayXd h = gap * (1.0 + 0.3 * std::sin(700.0 * k * dt));
      FilmStage stage{dt, 0.01, 0.0, 0.5 * 0.04 * w * std::sin(w * k * dt), false, 2e8};
      stage.cavity = cavity;
      stage.cover = &cover;
      if (k > 1) stage.profile_before = &profile;
      film.solve(smooth(h), content, stage);
      content = film.density() * h * cover.of_cells(1);
      profile = film.profile();
      crossed += film.outflow();
      volume = (content * grid.area()).sum();
      worst = std::max(worst, std::abs(volume + crossed - first) / first);
      least = std::min(least, cover.share.sum());
      EXPECT_GE(content.minCoeff(), 0.0);
      EXPECT_LT(film.residual(), 1e-10);
    }
    std::printf("    %s: largest volume error %.1e, fewest rows covered %.1f of %d\n",
                cavity == Cavity::kLayer ? "layer" : "striated", worst, least, cells);
    test::expect_at_most("oil that is lost while rows leave and return", worst,
                         1e-11);  // rounding of 2000 steps
    EXPECT_LT(least, 15.0);
  }
}

TEST(HardN9, ForcesOfBothSidesCancelAndPowerBalancesAtPartialCover) {
  PistonLinerOptions options = cut_scene();
  options.ends = {0.24, 0.285};  // the pin is at 0.268 m
  options.effects.friction = true;
  const auto element = make_element(options, true);
  dynamics::Response found;
  const Eigen::VectorXd y = pushed(*element, true, 6e-6, 2e-5);
  start(*element, y, 2e-3, found);
  const dynamics::Stage stage{2e-3 + 2e-6, 2e-6, 1, {0.0}};
  Eigen::VectorXd v(element->size());
  for (int k = 0; k < v.size(); ++k) v[k] = 1e-3 * std::cos(2.0 * k);
  element->begin_step(2e-3);
  element->evaluate(stage, y, v, false, found);
  const Eigen::VectorXd force = found.force;
  EXPECT_GT(entry(*element, "asperity_share"), 0.05);
  // Along the stroke: the piston's pin against the liner's mean.
  EXPECT_NEAR(force[kPin + 2], -force[kAxial], 1e-12 * std::abs(force[kPin + 2]));
  EXPECT_GT(std::abs(force[kPin + 2]), 1.0);
  // Sideways: a common displacement of all patches of both bodies, and so of their fits.
  double across = force[kSkirtFit + 1] + force[kLinerFit + 1], size = 0.0;
  const double turn = 2.0 * std::numbers::pi / 8.0;
  for (int i = 0; i < 8; ++i) {
    const double weight = std::cos(i * turn);
    for (int j = 0; j < 3; ++j) across += weight * force[i * 3 + j];
    for (int j = 0; j < 5; ++j) across += weight * force[kLiner + i * 5 + j];
    for (int j = 0; j < 3; ++j) size += std::abs(weight * force[i * 3 + j]);
  }
  EXPECT_LT(std::abs(across), 1e-10 * size);
  // f.v = input - lost - d(stored)/dt.
  const dynamics::Power power = element->power(y, v);
  const double dt = 1e-7;
  auto stored_at = [&](double shift) {
    dynamics::Response ignored;
    element->evaluate({stage.time + shift, 2e-6, 1, {0.0}}, y + shift * v, v, false, ignored);
    return element->power(y, v).stored;
  };
  const double rate = (stored_at(dt) - stored_at(-dt)) / (2.0 * dt);
  EXPECT_GT(std::abs(rate), 1e-3);
  EXPECT_NEAR(force.dot(v), power.input - power.lost - rate,
              1e-7 * (std::abs(power.lost) + std::abs(rate) + std::abs(power.input)));
}

}  // namespace
}  // namespace clatter::film
