// SPDX-License-Identifier: GPL-3.0-or-later
// Grooves and windows: exact land flows, shorter skirts, oil and energy balances, mirrors.
#include "dynamics/film/recess.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/integrate/tableau.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

Recess groove(double bottom, double top, double pressure = 0.0, double fill = 1.0) {
  Recess one;
  one.bottom = bottom;
  one.top = top;
  one.pressure = pressure;
  one.fill = fill;
  return one;
}

Recess window(double bottom, double top) {
  Recess one = groove(bottom, top);
  one.kind = Recess::Kind::kWindow;
  return one;
}

/// Sum of the flows into grooves [m3/s].
double into_grooves(const Reynolds& film) { return film.flows().tail(film.grid().size()).sum(); }

TEST(Recess, AGrooveUnderPressureFeedsTheLandsBesideItExactly) {
  // Hand-checkable: 1 m wide, h^3/(12 mu) = 1 m3/(Pa s), lands of 3 and 5 m, 1 Pa: 1/3 + 1/5.
  const PadGrid grid = strip(0.0, 10.0, 10);
  Reynolds film(grid, strip_edges(), true, true);
  RecessCells cells;
  RecessMap({groove(3.0, 5.0, 1.0)}, grid).at(0.0, cells);
  FilmStage stage{1.0, 1.0 / 12.0, 0.0, 0.0, true};
  stage.recesses = &cells;
  film.solve(smooth(Eigen::ArrayXd::Ones(10)), {}, stage);
  EXPECT_NEAR(into_grooves(film), -(1.0 / 3.0 + 1.0 / 5.0), 1e-14);
  for (int j = 0; j < 10; ++j) {
    const double z = grid.axial(j);
    EXPECT_NEAR(film.pressure()[j], z < 3.0 ? z / 3.0 : z < 5.0 ? 1.0 : (10.0 - z) / 5.0, 1e-14);
  }
  EXPECT_LT(film.residual(), 1e-14);
}

TEST(Recess, AGrooveOfTheLinerIsExactWhereverItsEdgesAre) {
  // The lands grow and shrink continuously while the edges pass rows of cells.
  const PadGrid grid = strip(0.0, 10.0, 10);
  Recess one = groove(3.0, 5.5, 1.0);
  one.on_liner = true;
  const RecessMap map({one}, grid);
  Reynolds film(grid, strip_edges(), true, true);
  RecessCells cells;
  double last_load = 0.0;
  for (int k = 0; k <= 400; ++k) {
    const double height = -2.0 + 0.01 * k;  // of the pad: the groove is as far below
    map.at(height, cells);
    FilmStage stage{1.0, 1.0 / 12.0, 0.0, 0.0, true};
    stage.recesses = &cells;
    film.solve(smooth(Eigen::ArrayXd::Ones(10)), {}, stage);
    const double below = 3.0 - height, above = 10.0 - (5.5 - height);
    EXPECT_NEAR(into_grooves(film) / -(1.0 / below + 1.0 / above), 1.0, 1e-5);  // the sliver 1e-6
    const double force = load(film);
    // Half of each land, all of the groove; a cell counts entirely: its part in the groove by p^2.
    EXPECT_NEAR(force, 0.5 * below + 2.5 + 0.5 * above, 0.3);
    if (k > 0) {
      EXPECT_LT(std::abs(force - last_load), 0.05);  // no jump; 0.15 is a cell's
    }
    last_load = force;
  }
}

TEST(Recess, TheRowsOfAGrooveAreSharedByOverlapAndItsColumnsByTheirCentres) {
  const PadGrid grid = PadGrid::uniform(0.0, 2.0 * std::numbers::pi, 8, 0.0, 4.0, 4, 1.0, true);
  Recess one = groove(10.5, 12.25);
  one.on_liner = true;
  one.angle_begin = -0.5 * std::numbers::pi;
  one.angle_span = std::numbers::pi;
  RecessCells cells;
  RecessMap({one}, grid).at(10.0, cells);
  for (int i = 0; i < 8; ++i) {
    const bool inside = i < 2 || i > 5;
    for (int j = 0; j < 4; ++j) {
      const double share[] = {0.5, 1.0, 0.25, 0.0}, slope[] = {1.0, 0.0, -1.0, 0.0};
      EXPECT_NEAR(cells.share[grid.cell(i, j)], inside ? share[j] : 0.0, 1e-12);
      EXPECT_NEAR(cells.share_slope[grid.cell(i, j)], inside ? slope[j] : 0.0, 1e-12);
    }
  }
}

PistonLinerOptions scene() {
  PistonLinerOptions options;
  options.span = SkirtSpan::kWhole;
  options.cells_around = 16;
  options.cells_along = 14;
  options.clearance = 12e-6;
  options.skirt.barrel_top = 20e-6;
  options.skirt.barrel_bottom = 15e-6;
  options.oil_thickness = 7e-6;
  return options;
}

/// A skirt that follows the crank and rocks a little across.
struct Driven {
  explicit Driven(const PistonLinerOptions& options) : element(make_element(options, false)) {}
  void run(double begin, double end, int steps, double lateral) {
    const dynamics::Tableau& A = dynamics::tr_bdf2();
    stages({{begin + 1e-9, 1e-9, 0, {}}}, begin, begin + 1e-9, lateral);
    for (int k = 0; k < steps; ++k) {
      const double dt = (end - begin) / steps, t = begin + k * dt, kappa = A.d * dt;
      stages({{t + A.c_1 * dt, kappa, 1, {A.a_10 * dt}},
              {t + dt, kappa, 2, {A.a_20 * dt, A.a_21 * dt}}},
             t, t + dt, lateral);
    }
  }
  void stages(const std::vector<dynamics::Stage>& all, double begin, double end, double lateral) {
    element->begin_step(begin);
    for (const dynamics::Stage& stage : all) {
      y.setZero(6);
      v.setZero(6);
      y[1] = lateral * std::cos(400.0 * stage.time);
      v[1] = -400.0 * lateral * std::sin(400.0 * stage.time);
      y[3] = 3.0 * lateral;
      element->evaluate(stage, y, v, false, response);
      element->finish_stage(stage);
    }
    element->accept_step(end);
  }
  std::unique_ptr<PistonLiner> element;
  Eigen::VectorXd y, v;
  dynamics::Response response;
};

TEST(Recess, ASkirtThatIsCutAwayAtItsEndsIsAShorterSkirt) {
  // The layer on the liner passes the windows unchanged; rows of 5 mm, two and three cut away.
  PistonLinerOptions options = scene();
  options.skirt = {};
  options.skirt.table_height = {-0.045, 0.0, 0.025};
  options.skirt.table_relief = {15e-6, 0.0, 20e-6};
  options.recesses = {window(-0.046, -0.035), window(0.010, 0.026)};
  Driven cut(options);
  options.recesses.clear();
  options.skirt_bottom = -0.035;
  options.skirt_top = 0.010;
  options.cells_along = 9;
  Driven shorter(options);
  for (Driven* one : {&cut, &shorter}) one->run(2e-3, 7e-3, 200, 5e-6);
  EXPECT_GT(shorter.response.force.norm(), 10.0);
  EXPECT_LT(
      (cut.response.force - shorter.response.force).norm(),
      1e-7 * shorter.response.force.norm());  // the flux over the edge of a window follows the fill
  const PadSnapshot one = cut.element->snapshot().front(),
                    other = shorter.element->snapshot().front();
  EXPECT_LT((one.pressure.middleCols(2, 9) - other.pressure).cwiseAbs().maxCoeff(),
            1e-8 * other.pressure.maxCoeff());
  EXPECT_EQ(one.pressure.leftCols(2).maxCoeff(), 0.0);
  EXPECT_EQ(one.contact_pressure.rightCols(3).maxCoeff(), 0.0);
}

TEST(Recess, AnEntireSkirtOfGrooveCarriesOnlyItsPressureWhichBalances) {
  PistonLinerOptions options = scene();
  options.recesses = {groove(-0.1, 0.1, 5e5)};
  Driven piston(options);
  piston.run(2e-3, 3e-3, 20, 5e-6);
  EXPECT_NEAR(piston.element->snapshot().front().pressure.minCoeff(), 5e5, 1e-9 * 5e5);
  // Rounding of 5e5 Pa times the skirt's area.
  EXPECT_LT(piston.response.force.head<2>().cwiseAbs().maxCoeff(), 1e-7);
}

PistonLinerOptions busy_recess() {
  PistonLinerOptions options = scene();
  options.liner_layer.emplace();
  options.liner_layer->splash = 2e-3;
  options.liner_layer->splash_thickness = 9e-6;
  options.liner_layer->bottom = 0.08;
  options.liner_layer->top = 0.32;
  Recess cut = window(-0.035, 0.0);  // beside the pin
  cut.angle_begin = 70.0 * std::numbers::pi / 180.0;
  cut.angle_span = 40.0 * std::numbers::pi / 180.0;
  Recess other = cut;
  other.angle_begin += std::numbers::pi;
  Recess supplied = groove(0.012, 0.018, 2e5);
  supplied.angle_begin = -45.0 * std::numbers::pi / 180.0;
  supplied.angle_span = 90.0 * std::numbers::pi / 180.0;
  Recess port = groove(0.19, 0.2, 0.0, 0.2);  // of the liner
  port.on_liner = true;
  options.recesses = {cut, other, supplied, port};
  return options;
}

TEST(Recess, NoOilIsMissingWhereGroovesSupplyAndTakeIt) {
  Driven piston(busy_recess());
  piston.run(6.2e-3, 6.2e-3 + 0.031, 500, 5e-6);
  const OilBalance oil = *piston.element->oil_balance();
  std::printf("    oil [mm3]: first %.2f, into grooves %.2f, moved %.2f, missing %.1e of it\n",
              1e9 * oil.first, 1e9 * oil.grooves, 1e9 * oil.moved, oil.residue());
  EXPECT_LT(oil.residue(), 1e-10);
  EXPECT_GT(std::abs(oil.grooves), 1e-2 * oil.first);
  EXPECT_EQ(oil.sides, 0.0);
  const std::vector<double> saved = piston.element->save();
  Driven restored(busy_recess());
  restored.element->restore(saved);
  EXPECT_EQ(restored.element->save(), saved);
  EXPECT_EQ(restored.element->oil_balance()->missing(), oil.missing());
}

TEST(Recess, MirroredRecessesMirrorTheResult) {
  const auto run = [](double sign) {
    PistonLinerOptions options = busy_recess();
    if (sign < 0.0)  // y to -y: angle f to 180 deg - f
      for (Recess& one : options.recesses)
        one.angle_begin = std::numbers::pi - one.angle_begin - one.angle_span + 1e-9;
    Driven piston(options);
    piston.run(2e-3, 9e-3, 150, sign * 5e-6);
    return piston.response.force;
  };
  const Eigen::VectorXd one = run(1.0), other = run(-1.0);
  EXPECT_GT(std::abs(one[1]), 10.0);
  const Eigen::VectorXd flip = (Eigen::VectorXd(6) << 1, -1, 1, -1, 1, 1).finished();
  EXPECT_LT((flip.cwiseProduct(other) - one).norm(), 1e-8 * one.norm());
}

TEST(Recess, PowerBalancesWhileAGrooveOfTheLinerPassesAContact) {
  PistonLinerOptions options = scene();
  options.clearance = 4e-6;
  options.recesses = busy_recess().recesses;
  options.recesses.back().bottom = 0.243;  // the skirt is from 0.223 to 0.293 m
  options.recesses.back().top = 0.2571;
  const auto element = make_element(options, false);
  dynamics::Response response;
  Eigen::VectorXd y(6), v(6);
  y << 1e-6, 5e-6, 0.0, 2e-5, 0.0, 0.0;
  v << 1e-3, 4e-3, 0.0, 0.1, 0.0, 0.0;
  const dynamics::Stage first{2e-3, 1e-10, 0, {}};
  element->begin_step(first.time);
  element->evaluate(first, y, v, true, response);
  element->finish_stage(first);
  element->accept_step(first.time);
  const dynamics::Power power = element->power(y, v);
  const double work = response.force.dot(v), dt = 1e-8;
  const auto stored_at = [&](double shift) {
    dynamics::Response ignored;
    element->evaluate({2e-3 + shift, 1e-7, 1, {0.0}}, y + shift * v, v, false, ignored);
    return element->power(y, v).stored;
  };
  const double rate = (stored_at(dt) - stored_at(-dt)) / (2.0 * dt);
  EXPECT_GT(std::abs(rate), 1e-3);
  EXPECT_NEAR(work, power.input - power.lost - rate,
              1e-7 * (std::abs(power.lost) + std::abs(rate)));  // of the difference over 2e-8 s
  options.recesses.pop_back();
  const auto without = make_element(options, false);
  without->begin_step(first.time);
  without->evaluate(first, y, v, false, response);
  EXPECT_GT(std::abs(without->power(y, v).stored - power.stored), 1e-3 * power.stored);
}

TEST(Recess, WhatMakesNoSenseIsRefused) {
  const auto refused = [](Recess one) {
    PistonLinerOptions options = scene();
    options.recesses = {one};
    return test::refusal_of([&] { make_element(options, false); });
  };
  const std::string name = "piston_liner: recess 1: ";
  EXPECT_EQ(refused(groove(0.1, 0.2)), name +
                                           "the recess covers no cell: it is smaller than a cell "
                                           "or outside the pads");
  EXPECT_EQ(refused(groove(0.0, 0.01, 1e5, 0.5)),
            name + "found a fill of 0.5 under pressure, expected 1");
  EXPECT_EQ(refused(groove(0.0, 0.01, -1.0)), name + "found -1 Pa, expected >= 0");
  EXPECT_EQ(refused(groove(0.0, 0.01, 0.0, 1.5)), name + "found a fill of 1.5, expected 0 to 1");
  Recess port = groove(0.2, 0.202);
  port.on_liner = true;
  EXPECT_EQ(refused(port),
            name + "found a height of 0.002 m, expected at least a row of cells, 0.005 m");
  port = window(0.2, 0.21);
  port.on_liner = true;
  EXPECT_EQ(refused(port),
            name + "found a window of the liner, expected a groove: with fill 0 for a port");
}

TEST(Recess, NoneAllocatesNothing) {
  PistonLinerOptions options = busy_recess();
  const size_t with = make_element(options, false)->save().size();
  options.recesses.clear();
  EXPECT_LT(make_element(options, false)->save().size(), with);
}

}  // namespace
}  // namespace clatter::film
