// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases T: time integration with stiff contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "dynamics/law/radial_law.hpp"
#include "dynamics/run/energy.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using testing::point_mass;
using testing::push;
using testing::vector;
using testing::Wall;

/// Rejects its trial states, or returns a wrong tangent, between two counts of evaluations.
class Saboteur : public ForceElement {
 public:
  enum class Kind { kRefuse, kNonsense };
  Saboteur(int coordinate, Kind kind, int from, int to)
      : ForceElement({coordinate}), kind_(kind), from_(from), to_(to) {}
  std::string name() const override { return "saboteur"; }
  void evaluate(const Stage&, const Eigen::VectorXd& y, const Eigen::VectorXd&, bool,
                Response& response) override {
    ++count_;
    const bool active = count_ >= from_ && count_ < to_;
    if (active && kind_ == Kind::kRefuse) throw StepRefused("sabotage", std::to_string(count_));
    response.force = vector(active ? 1e6 * (count_ % 2 ? 1.0 : -1.0) : -10.0 * y(0));
    response.tangent = Eigen::MatrixXd::Constant(1, 1, -10.0);
  }
  Power power(const Eigen::VectorXd& y, const Eigen::VectorXd&) const override {
    return {5.0 * y(0) * y(0), 0.0, 0.0};
  }

 private:
  Kind kind_;
  int from_, to_, count_ = 0;
};

TEST(HardT1_UndampedStiffContact, EnergyNeverRisesOverTenThousandImpacts) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  system.add_element(std::make_unique<Wall>(y, 0.0, 1e9, 0.0, 1.0));
  push(system, [](double) { return 50.0; });
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-3;
  // The energy error of an impact follows the tolerance; this one is tight enough for the claim.
  options.accuracy = {3e-7, 1e-4, 0.1, 0.05};
  Dirk method(system, options);
  method.set_observer(&energy);
  method.start(0.0, vector(-1e-4), vector(0.0));
  const double potential_start = -50.0 * -1e-4;
  const double start = energy.now().stored() + potential_start;
  long long impacts = 0;
  double v_before = 0.0;
  while (impacts < 10000) {
    method.step(1e9);
    const double v = method.state().v_y(y);
    if (v_before > 0.0 && v <= 0.0) ++impacts;
    v_before = v;
    if (method.state().y(y) > 0.0) continue;  // between impacts, where the energy is settled
    const double total = energy.now().stored() - 50.0 * method.state().y(y);
    ASSERT_LE(total, start * (1.0 + 1e-6 * static_cast<double>(impacts + 1))) << impacts;
  }
  // L-stability costs some energy: 5e-5 of it after so many impacts.
  test::expect_at_least("share of the energy that is left",
                        (energy.now().stored() - 50.0 * method.state().y(y)) / start, 1.0 - 5e-4);
}

TEST(HardT3_NewtonFailure, IsRejectedAndCounted) {
  for (const auto kind : {Saboteur::Kind::kRefuse, Saboteur::Kind::kNonsense}) {
    System system;
    const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
    // Ten evaluations: ten refused attempts, or an iteration that cannot converge.
    system.add_element(std::make_unique<Saboteur>(y, kind, 40, 50));
    push(system, [](double t) { return std::sin(30.0 * t); });
    StepOptions options;
    options.accuracy = {1e-3, 1e-3, 0.1, 0.05};
    options.largest = 1e-2;
    Dirk method(system, options);
    method.start(0.0, vector(0.0), vector(0.0));
    while (method.state().time < 1.0) method.step(1.0);
    const auto& count = method.statistics();
    if (kind == Saboteur::Kind::kRefuse) {
      EXPECT_EQ(count.rejected_refused, 10);
      // One entry, although each refusal has another detail.
      ASSERT_EQ(count.refusals.size(), 1U);
      EXPECT_EQ(count.refusals.at("sabotage").count, 10);
      EXPECT_EQ(count.refusals.at("sabotage").last, "49");
    } else {
      test::expect_at_least("rejected steps",
                            static_cast<double>(count.rejected_newton + count.rejected_error), 1);
    }
    // m x'' = sin(30 t) - 10 x from rest: the motion must not be affected by the sabotage.
    const double w = std::sqrt(10.0), t = 1.0;
    const double exact = (std::sin(30.0 * t) - 30.0 / w * std::sin(w * t)) / (10.0 - 900.0);
    EXPECT_NEAR(method.state().y(y), exact, 1e-4);
  }
}

TEST(HardT4_ImpossiblePenalty, EndsAtTheFloorNamingTheContact) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  system.add_element(std::make_unique<Wall>(y, 1e-5, 1e20, 0.0, 1.0));
  push(system, [](double) { return 1000.0; });
  StepOptions options;
  Dirk method(system, options);
  method.start(0.0, vector(0.0), vector(0.0));
  try {
    while (method.state().time < 1.0) method.step(1.0);
    FAIL() << "expected a NumericsError";
  } catch (const NumericsError& error) {
    EXPECT_NE(std::string(error.what()).find("wall"), std::string::npos) << error.what();
    EXPECT_EQ(error.code(), ExitCode::kNumerics);
  }
  // Ends promptly: counted in steps, not in seconds.
  test::expect_at_most("steps before it ends", static_cast<double>(method.statistics().accepted),
                       1999);
}

TEST(HardT5_BouncingBall, ComesToRestOnTheWall) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  const double weight = 9.81;
  // Hunt and Crossley: about e = 1 - (2/3) (c/k) v; c chosen for e near 0.7 at the first impact.
  const double drop = 0.05, v = std::sqrt(2.0 * 9.81 * drop), k = 1e8;
  system.add_element(std::make_unique<Wall>(y, 0.0, k, 0.7 * k / v, 1.0));
  push(system, [=](double) { return weight; });
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-3, 1e-3, 1.0, 0.05};
  Dirk method(system, options);
  method.start(0.0, vector(-drop), vector(0.0));
  while (method.state().time < 5.0) method.step(5.0);
  // It loses a part 0.47 v of its velocity at each impact, so impacts at some mm/s last for long,
  // unless a long step ends them: both are within the tolerance of 1 mm/s a step.
  test::expect_at_most("distance from the position of rest [m]",
                       std::abs(method.state().y(y) - weight / k), 1e-5);
  EXPECT_LT(std::abs(method.state().v_y(y)), 1e-2);
  EXPECT_LT(method.statistics().accepted, 30000);
}

double deepest_penetration(double dt, double& lost) {
  System system;
  const int y = system.coordinate(system.add_body(point_mass(1.0)), 0);
  system.add_element(std::make_unique<Wall>(y, 0.0, 1e9, 1e8));
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = dt;
  options.first = 1e-9;
  options.fixed = true;
  Dirk method(system, options);
  method.set_observer(&energy);
  method.start(0.0, vector(-1e-5), vector(0.1));
  double deepest = 0.0;
  while (method.state().time < 4e-3) {
    method.step(4e-3);
    deepest = std::max(deepest, method.state().y(y));
  }
  lost = energy.now().lost;
  return deepest;
}

TEST(HardT8_HalvingTheStep, ConvergesPenetrationAndLoss) {
  double lost[3];
  const double depth[3] = {deepest_penetration(2e-5, lost[0]), deepest_penetration(1e-5, lost[1]),
                           deepest_penetration(5e-6, lost[2])};
  // Errors shrink by about four a halving; the 1.5-power contact is C1, so a factor of two is safe.
  EXPECT_LT(std::abs(depth[2] - depth[1]), 0.5 * std::abs(depth[1] - depth[0]) + 1e-5 * depth[2]);
  EXPECT_LT(std::abs(lost[2] - lost[1]), 0.5 * std::abs(lost[1] - lost[0]) + 1e-6 * lost[2]);
  test::expect_at_most("change of the penetration by the last halving",
                       std::abs(depth[1] - depth[2]) / depth[2], 4e-4);  // 4e-5 is reached
}

TEST(HardT9_FreeRun, EnergyDoesNotRiseInTenSeconds) {
  System system;
  system.coordinate(system.add_body(point_mass(1.0, 4e4)), 0);  // 32 Hz, undamped
  EnergyBalance energy(system);
  StepOptions options;
  options.largest = 1e-3;
  options.accuracy = {1e-3, 1e-3, 0.2, 0.05};
  Dirk method(system, options);
  method.set_observer(&energy);
  method.start(0.0, vector(1e-3), vector(0.0));
  double last = energy.now().stored();
  const double start = last;
  while (method.state().time < 10.0) {
    method.step(10.0);
    // Rounding of one step is all that may be added.
    ASSERT_LE(energy.now().stored(), last + 1e-12 * start);
    last = energy.now().stored();
  }
  test::expect_at_least("energy after ten seconds, of that at the start", last / start,
                        0.85);  // and the integrator hardly damps 320 periods
}

}  // namespace
}  // namespace clatter::dynamics
