// SPDX-License-Identifier: GPL-3.0-or-later
// `cavitation = false`: full Sommerfeld, every cell is full.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "film_march.hpp"
#include "piston_scene.hpp"

namespace clatter::film {
namespace {

PistonLinerOptions plain_reynolds() {
  PistonLinerOptions options;
  options.cells_around = 6;
  options.cells_along = 16;
  options.clearance = 30e-6;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  options.effects.cavitation = false;
  return options;
}

/// Mean pressures of the pads [Pa] after the start and after each of three steps of a piston that
/// slides down and moves to the thrust side.
std::vector<double> pressures(const PistonLinerOptions& options) {
  const auto element = make_element(options, false);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
  dynamics::Response response;
  std::vector<double> found;
  for (int k = 0; k <= 3; ++k) {
    const double kappa = k == 0 ? 1e-7 : 1e-5;
    const dynamics::Stage stage{1e-3 + k * 1e-5, kappa, k == 0 ? 0 : 1, {}};
    Eigen::VectorXd y = rest, v = rest;
    v[1] = 0.01;
    y[1] = v[1] * k * 1e-5;
    element->begin_step(stage.time - kappa);
    element->evaluate(stage, y, v, false, response);
    element->finish_stage(stage);
    element->accept_step(stage.time);
    for (const PadSnapshot& pad : element->snapshot()) {
      EXPECT_EQ(pad.fill.minCoeff(), 1.0);
      found.push_back(pad.pressure.mean());
    }
  }
  return found;
}

// Cells that count as full but hold a third of their volume pulled with a mean of -6.9e8 Pa.
TEST(FullSommerfeld, OilLayerAndFillsHaveNoEffect) {
  PistonLinerOptions thin = plain_reynolds();
  thin.oil_thickness = 6e-6;
  thin.initial_fill = 0.3;
  thin.supply_fill = 0.2;
  EXPECT_EQ(pressures(thin), pressures(plain_reynolds()));
}

// A skirt of 10 mm whose relief makes a wedge of 2:1, on a pad so wide that its sides do not
// matter: the converging wedge carries W* = 6 ln 2 - 4, the diverging one pulls as much.
TEST(FullSommerfeld, AWedgePullsInOneDirectionWhatItCarriesInTheOther) {
  PistonLinerOptions options = plain_reynolds();
  const double length = 10e-3, thinnest = 20e-6, speed = 5.0;
  options.bore_radius = 10.0;
  options.pad_span = 1.0;
  options.cells_around = 3;
  options.cells_along = 100;
  options.skirt_bottom = 0.0;
  options.skirt_top = length;
  options.clearance = thinnest;
  options.skirt = {};
  options.skirt.table_height = {0.0, length};
  options.skirt.table_relief = {0.0, thinnest};
  options.oil_thickness = 6e-6;
  options.effects.asperities = options.effects.friction = false;
  options.roughness = {0.0, 0.0, 1.0, false};
  const double unit = options.viscosity * speed * length * length / (thinnest * thinnest);
  for (const double direction : {1.0, -1.0}) {
    PistonLinerBodies bodies;
    bodies.stroke = [=](double time) {
      return StrokeState{direction * speed * time, direction * speed};
    };
    PistonLiner element(options, bodies, {0, 1, 2, 3, 4, 5});
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(6);
    dynamics::Response response;
    for (int k = 0; k < 3; ++k) {
      const dynamics::Stage stage{1e-3 * (k + 1), 1e-3, k == 0 ? 0 : 1, {}};
      element.begin_step(stage.time - 1e-3);
      element.evaluate(stage, rest, rest, false, response);
      element.finish_stage(stage);
      element.accept_step(stage.time);
    }
    const double load = element.snapshot().front().pressure.row(1).mean() * length / unit;
    const double exact = direction * (6.0 * std::log(2.0) - 4.0);
    std::printf("full Sommerfeld wedge, U = %+.0f m/s: W* = %+.6f (%+.1e)\n", direction * speed,
                load, load / exact - 1.0);
    EXPECT_NEAR(load / exact, 1.0, 1e-3);  // discretisation, and p / B of the oil
  }
}

}  // namespace
}  // namespace clatter::film
