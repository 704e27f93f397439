// SPDX-License-Identifier: GPL-3.0-or-later
// State events: roots, impacts, accumulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"

namespace clatter::dynamics {
namespace {

using testing::Floor;
using testing::point_mass;
using testing::push;
using testing::vector;

/// Counts the roots of y - level without any force.
class Gate : public ForceElement {
 public:
  Gate(int coordinate, double level) : ForceElement({coordinate}), level_(level) {}
  std::string name() const override { return "gate"; }
  void evaluate(const Stage&, const Eigen::VectorXd&, const Eigen::VectorXd&, bool with_tangent,
                Response& response) override {
    response.force.setZero(1);
    if (with_tangent) response.tangent.setZero(1, 1);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }
  int events() const override { return 1; }
  double event_function(int, double, const Eigen::VectorXd& y,
                        const Eigen::VectorXd&) const override {
    return level_ - y(0);
  }
  void at_event(int, double time) override { times.push_back(time); }
  std::vector<double> times;

 private:
  double level_;
};

template <typename Element, typename... Arguments>
Element* add(System& system, Arguments... arguments) {
  auto element = std::make_unique<Element>(arguments...);
  Element* kept = element.get();
  system.add_element(std::move(element));
  return kept;
}

StepOptions free_fall_options() {
  StepOptions options;
  options.largest = 1e-2;
  options.first = 1e-9;
  options.accuracy = {1e-6, 1e-3, 0.1, 0.05};
  return options;
}

TEST(Events, BallBouncesAtTheTimesOfTheoryAndComesToRest) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  Floor* floor = add<Floor>(system, y, 0.5);
  push(system, [](double) { return -9.81; });
  EnergyBalance energy(system);
  Dirk method(system, free_fall_options());
  method.set_observer(&energy);
  method.start(0.0, vector(1e-3), vector(0.0));
  while (method.state().time < 0.1) method.step(0.1);
  // Impacts at t1 (1 + 2 e + 2 e^2 + ...), t1 = sqrt(2 h / g); rest at 3 t1 for e = 1/2.
  const double first = std::sqrt(2e-3 / 9.81);
  ASSERT_GT(floor->impacts.size(), 8U);
  double expected = first, flight = first;
  for (size_t k = 0; k < 8; ++k) {
    EXPECT_NEAR(floor->impacts[k], expected, 1e-7) << k;
    expected += flight;  // 2 e times the last half flight
    flight *= 0.5;
  }
  EXPECT_NEAR(floor->impacts.front(), 14.27843e-3, 1e-7);  // reference/timing-drive.md
  EXPECT_NEAR(floor->impacts.back(), 42.83529e-3, 1e-6);
  EXPECT_NEAR(method.state().y(y), -9.81 / 1e8, 1e-10);
  EXPECT_LT(method.statistics().accepted, 2000);
  // What the impacts take is what was there: m g h.
  const auto& terms = energy.terms();
  const auto events = std::find(terms.begin(), terms.end(), "events") - terms.begin();
  EXPECT_NEAR(energy.now().terms.at(events), -9.81e-3, 1e-6);
}

TEST(Events, ImpactsThatAccumulateWithoutAModeForItEndTheRun) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  add<Floor>(system, y, 0.5, false);
  push(system, [](double) { return -9.81; });
  Dirk method(system, free_fall_options());
  method.start(0.0, vector(1e-3), vector(0.0));
  try {
    while (method.state().time < 0.1) method.step(0.1);
    FAIL() << "expected a NumericsError";
  } catch (const NumericsError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("events of floor follow each other without end"), std::string::npos)
        << said;
    EXPECT_NE(said.find("time 0.0428"), std::string::npos) << said;
  }
}

TEST(Events, TwoInOneStepAreBothTakenInTheirOrder) {
  // Two masses that fall from heights of which the second is reached 1e-6 s, or 0 s, after the
  // first.
  for (const double delay : {1e-6, 0.0}) {
    System system;
    Floor* floors[2];
    for (int k = 0; k < 2; ++k) {
      const int body = system.add_body(point_mass(1.0));
      floors[k] = add<Floor>(system, system.coordinate(body, 0), 1.0);
      system.add_load({"weight", body, vector(1.0), [](double) { return -9.81; }});
    }
    const double t1 = 0.02, t2 = t1 + delay;
    Dirk method(system, free_fall_options());
    Eigen::VectorXd heights(2);
    heights << 0.5 * 9.81 * t1 * t1, 0.5 * 9.81 * t2 * t2;
    method.start(0.0, heights, Eigen::VectorXd::Zero(2));
    while (method.state().time < 0.05) method.step(0.05);
    for (int k = 0; k < 2; ++k) ASSERT_EQ(floors[k]->impacts.size(), 1U) << k;
    EXPECT_NEAR(floors[0]->impacts[0], t1, 1e-8);
    EXPECT_NEAR(floors[1]->impacts[0], t2, 1e-8);
    // Elastic: at the end both move as free flight says.
    EXPECT_NEAR(method.state().v_y(0), 9.81 * (2.0 * t1 - 0.05), 1e-5);
    EXPECT_NEAR(method.state().v_y(1), 9.81 * (2.0 * t2 - 0.05), 1e-5);
  }
}

TEST(Events, OneAtTheEndOfAStepIsTakenOnce) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  Gate* gate = add<Gate>(system, y, 0.5);
  StepOptions options;
  options.largest = 0.125;
  options.first = 1e-12;
  options.fixed = true;
  Dirk method(system, options);
  method.start(-options.first, vector(0.0), vector(1.0));  // y = t
  while (method.state().time < 1.0) method.step(1.0);
  ASSERT_EQ(gate->times.size(), 1U);
  EXPECT_NEAR(gate->times[0], 0.5, 1e-9);
}

TEST(HardT6_RootsOfEvenMultiplicity, AGrazingMotionPassesTheGateTwiceOrNotAtAll) {
  // y = sin t: it reaches above 1 - d for 2 sqrt(2 d) around pi / 2, far less than a step.
  for (const double d : {1e-6, -1e-6}) {
    System system;
    const int y = system.coordinate(system.add_body(point_mass(1.0, 1.0)), 0);
    Gate* gate = add<Gate>(system, y, 1.0 - d);
    StepOptions options;
    options.largest = 0.05;
    options.first = 1e-9;
    options.accuracy = {1e-10, 1.0, 1.0, 1.0};
    Dirk method(system, options);
    method.start(-options.first, vector(0.0), vector(1.0));
    while (method.state().time < 3.0) method.step(3.0);
    EXPECT_EQ(gate->times.size(), d > 0.0 ? 2U : 0U) << d;
    for (const double time : gate->times)
      EXPECT_NEAR(std::abs(time - std::numbers::pi / 2), std::sqrt(2.0 * d), 1e-4);
  }
}

}  // namespace
}  // namespace clatter::dynamics
