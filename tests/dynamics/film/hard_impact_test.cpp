// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case R1: a piston thrown at the wall.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dynamics/film/flow_factors.hpp"
#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/observed.hpp"

namespace clatter::film {
namespace {

struct Throw {
  const char* name;
  double speed, fill, viscosity;
  ContactEffects effects;
};
void PrintTo(const Throw& shot, std::ostream* out) { *out << shot.name; }

class Impact : public ::testing::TestWithParam<Throw> {};

TEST_P(Impact, HardR1_FilmStaysPositiveAndImpulseBalances) {
  const Throw& shot = GetParam();
  PistonLinerOptions options;
  options.bulk_modulus = 0.0;  // the hardest case: incompressible oil
  options.clearance = 50e-6;
  options.cells_around = 10;
  options.cells_along = 12;
  options.initial_fill = shot.fill;
  options.viscosity = shot.viscosity;
  options.effects = shot.effects;
  if (!shot.effects.asperities) options.roughness = {0.0, 0.0, 1.0, false};
  const auto element = make_element(options, false);
  Eigen::VectorXd mass(6);
  mass << 2.0, 2.0, 2.0, 4e-3, 4e-3, 4e-3;
  Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
  v[1] = shot.speed;
  Flight flight(*element, mass, Eigen::VectorXd::Zero(6), v);
  flight.start();
  double impulse = 0.0, dt = 1e-7, lowest = 1.0, peak = 0.0, spent = 0.0;
  double power_before = 0.0;
  int steps = 0;
  while (flight.time < 1.5e-4) {
    const Flight before = flight;
    const std::vector<double> content = element->save();
    // The trapezoidal sum of the recorded force must resolve its rise: at most .3 % of the speed a
    // step.
    while (!flight.step(dt) || std::abs(flight.v[1] - before.v[1]) > 3e-3 * shot.speed) {
      const int refused = flight.refused;
      flight.restore(before);
      flight.refused = refused;
      element->restore(content);
      dt *= 0.5;
      ASSERT_GT(dt, 1e-14);
    }
    const double force_before = before.force[1];
    ++steps;
    impulse += 0.5 * dt * (force_before + flight.force[1]);
    const dynamics::Power power = element->power(flight.y, flight.v);
    spent += 0.5 * dt * (power_before + power.lost - power.input);
    power_before = power.lost - power.input;
    peak = std::max(peak, std::abs(flight.force[1]));
    ASSERT_TRUE(flight.y.allFinite() && flight.v.allFinite());
    for (const PadSnapshot& pad : element->snapshot()) {
      ASSERT_TRUE(pad.gap.allFinite());
      lowest = std::min(lowest, pad.gap.minCoeff());
    }
    if (std::abs(flight.v[1] - before.v[1]) < 1e-3 * shot.speed) dt = std::min(1.4 * dt, 5e-7);
  }
  const double gained = mass[1] * (flight.v[1] - shot.speed);
  const double stored = element->power(flight.y, flight.v).stored;
  const double kinetic = 0.5 * mass.dot(flight.v.cwiseAbs2()),
               start = 0.5 * mass[1] * shot.speed * shot.speed;
  std::printf(
      "R1 %-20s %4.1f m/s: %4d steps, %3d refused, min gap %.3g um, peak %.3g kN, rebound %.3f "
      "m/s, impulse defect %.1e, energy defect %.1e\n",
      shot.name, shot.speed, steps, flight.refused, lowest * 1e6, peak * 1e-3, flight.v[1],
      impulse / gained - 1.0, (kinetic + stored + spent - start) / start);
  test::expect_at_most("error of the impulse balance", std::abs(impulse / gained - 1.0),
                       0.01);  // required
  EXPECT_NEAR((kinetic + stored + spent) / start, 1.0,
              0.02);  // trapezoidal sum of the recorded power
  if (shot.effects.asperities) {
    // Rough walls: the mean gap h_T of the film must stay positive.
    EXPECT_GT(mean_gap(lowest, std::hypot(options.roughness.piston, options.roughness.liner)).value,
              0.0);
  } else {
    EXPECT_GT(lowest, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Shots, Impact,
    ::testing::Values(Throw{"flooded smooth", 5.0, 1.0, 0.01, {true, true, false, true}},
                      Throw{"starved smooth", 5.0, 0.05, 0.005, {true, true, false, true}},
                      Throw{"starved rough", 5.0, 0.02, 0.005, {true, true, true, true}},
                      Throw{"thin oil mixed", 5.0, 1.0, 1e-4, {true, true, true, true}},
                      Throw{"dry", 5.0, 0.0, 0.01, {false, true, true, true}}),
    [](const auto& info) {
      std::string name = info.param.name;
      std::erase(name, ' ');
      return name;
    });

}  // namespace
}  // namespace clatter::film
