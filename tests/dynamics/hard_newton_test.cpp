// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases N1, N2 and N14: what the iteration of a stage may accept.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/base/error.hpp"
#include "tests/dynamics/fixtures.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

using testing::point_mass;
using testing::push;
using testing::vector;
using testing::Wall;

constexpr double kPush = 50.0;  // force per mass: into the wall, from kTurn on away from it [m/s2]
constexpr double kTurn = 1e-3;  // [s]

/// A mass that rests on a linear wall and is then pulled off it.
struct Opening {
  double mass = 2.0, stiffness = 1e12, gap = 0.0;

  /// Time at which the wall lets go, and the velocity then: x = F/k (2 cos wt - 1) from kTurn on.
  double release() const { return kTurn + std::numbers::pi / 3.0 * std::sqrt(mass / stiffness); }
  double velocity(double time) const {
    return -std::sqrt(3.0 * mass / stiffness) * kPush - kPush * (time - release());
  }
  void build(System& system, std::unique_ptr<ForceElement> wall) const {
    system.coordinate(system.add_body(point_mass(mass)), 0);
    system.add_element(std::move(wall));
    push(system, [m = mass](double t) { return (t < kTurn ? kPush : -kPush) * m; });
  }
  std::unique_ptr<Wall> wall() const { return std::make_unique<Wall>(0, gap, stiffness, 0.0, 1.0); }
  Eigen::VectorXd rest() const {
    return vector((gap + mass * kPush / stiffness) * std::sqrt(mass));
  }
};

/// Difference of the velocity from the exact one, `after` seconds from the release.
double velocity_error(const Opening& opening, const StepOptions& options, double after) {
  System system;
  opening.build(system, opening.wall());
  Dirk method(system, options);
  method.start(0.0, opening.rest(), vector(0.0));
  const double end = opening.release() + after;
  while (method.state().time < end) method.step(end);
  return method.state().v_y(0) - opening.velocity(end);
}

TEST(HardN1_ContactThatOpens, ReleasesAnyMassFromAnyStiffness) {
  // One step may be off by 1e-4 m/s of 0.1. With the test of the increment alone 2 kg was 0.033 m/s
  // too slow at 1e12 N/m and never left the wall at 1e14.
  for (double stiffness = 1e6; stiffness < 2e20; stiffness *= 100.0) {
    for (const double mass : {1e-3, 2.0, 1e3}) {
      for (const double gap : {0.0, 1e-5}) {
        // Where rounding of the position is more than the force, a refusal is right as well.
        const double rounding = stiffness * gap * std::numeric_limits<double>::epsilon();
        try {
          const double error = velocity_error({mass, stiffness, gap}, {}, 2e-3);
          EXPECT_LT(std::abs(error), 3e-4) << stiffness << " N/m, " << mass << " kg, gap " << gap;
        } catch (const NumericsError& refusal) {
          EXPECT_GT(rounding, 0.1 * mass * kPush)
              << stiffness << " N/m, " << mass << " kg, gap " << gap << ": " << refusal.what();
          EXPECT_NE(std::string(refusal.what()).find("under wall"), std::string::npos);
        }
      }
    }
  }
}

TEST(HardN1_ContactThatOpens, ReleasesInSmallStepsToo) {
  // The force that opens it moves the mass by less than the tolerance of the iteration in a step.
  StepOptions options;
  options.largest = 1e-7;
  test::expect_at_most("error of the velocity in small steps",
                       std::abs(velocity_error({2.0, 1e14, 0.0}, options, 1e-4)), 1e-4);
}

/// A wall that keeps its last trial state.
class Probe : public Wall {
 public:
  using Wall::Wall;
  void evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                bool tangent, Response& response) override {
    Wall::evaluate(stage, y, v, tangent, response);
    last = y(0);
    force = response.force(0);
    kappa = stage.kappa;
  }
  double last = 0.0, force = 0.0, kappa = 0.0;
};

/// Largest differences, over all finished stages, of what the element was evaluated at and gave
/// from the motion that follows: over the limits of the error test.
class Compare : public StageObserver {
 public:
  Compare(const Probe& probe, double mass) : probe_(probe), mass_(mass) {}
  void stage(int, const StageState& state) override {
    const double load = (state.time < kTurn ? kPush : -kPush) * mass_;
    const double unbalanced = state.a(0) * std::sqrt(mass_) - load - probe_.force;
    displacement = std::max(displacement, std::abs(state.y(0) - probe_.last) / 1e-8);
    velocity = std::max(velocity, std::abs(unbalanced) * probe_.kappa / mass_ / 1e-4);
  }
  void accept(double) override {}
  double displacement = 0.0, velocity = 0.0;

 private:
  const Probe& probe_;
  double mass_;
};

TEST(HardN1_LastEvaluation, IsAtTheStateThatIsKept) {
  for (const double stiffness : {1e8, 1e12, 1e16}) {
    const Opening opening{2.0, stiffness, 0.0};
    auto owned = std::make_unique<Probe>(0, 0.0, stiffness, 0.0, 1.0);
    Compare compare(*owned, opening.mass);
    System system;
    opening.build(system, std::move(owned));
    Dirk method(system, {});
    method.set_observer(&compare);
    method.start(0.0, opening.rest(), vector(0.0));
    while (method.state().time < 3e-3) method.step(3e-3);
    EXPECT_LE(compare.displacement, 0.05);
    EXPECT_LE(compare.velocity, 0.1);  // residual and increment, 0.05 each
  }
}

/// What a run to 10 ms says when it fails.
std::string failure(System& system, bool fixed) {
  StepOptions options;
  options.fixed = fixed;
  Dirk method(system, options);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(system.modes());
  method.start(0.0, rest, rest);
  try {
    while (method.state().time < 1e-2) method.step(1e-2);
  } catch (const NumericsError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(HardN2_NotANumber, StopsABodyWithoutInterfaceRows) {
  // The error test took max(0, NaN, NaN) for 0, so the run went on to its end.
  for (const bool fixed : {false, true}) {
    System system;
    system.add_body(point_mass(1.0));
    push(system, [](double t) { return t < 5e-3 ? 1.0 : std::nan(""); });
    const std::string said = failure(system, fixed);
    EXPECT_NE(said.find("mass: the motion is not finite"), std::string::npos) << said;
  }
}

TEST(HardN2_NotANumber, IsTheLargestEntryWhereverItIs) {
  const double nan = std::nan("");
  for (int at = 0; at < 3; ++at) {
    Eigen::VectorXd x(3);
    x << 1.0, -5.0, 2.0;
    EXPECT_EQ(largest_entry(x).at, 1);
    x(at) = nan;
    EXPECT_TRUE(std::isnan(largest_entry(x).value));
    EXPECT_EQ(largest_entry(x).at, at);
  }
  EXPECT_EQ(largest_entry(Eigen::VectorXd()).at, -1);
}

/// A force that is no number from 5 ms on, on the first of two coordinates.
class Broken : public ForceElement {
 public:
  Broken() : ForceElement({0, 1}) {}
  std::string name() const override { return "broken"; }
  void evaluate(const Stage& stage, const Eigen::VectorXd&, const Eigen::VectorXd&, bool,
                Response& response) override {
    response.force = Eigen::Vector2d(stage.time < 5e-3 ? 0.0 : std::nan(""), 1.0);
    response.tangent = Eigen::MatrixXd::Zero(2, 2);
  }
  Power power(const Eigen::VectorXd&, const Eigen::VectorXd&) const override { return {}; }
};

TEST(HardN2_NotANumber, StopsAForceThatAFiniteOneFollows) {
  System system;
  for (int b = 0; b < 2; ++b) system.coordinate(system.add_body(point_mass(1.0)), 0);
  system.add_element(std::make_unique<Broken>());
  const std::string said = failure(system, false);
  EXPECT_NE(said.find("the forces are not finite"), std::string::npos) << said;
  EXPECT_NE(said.find("under broken"), std::string::npos) << said;
}

/// A mass of 1 kg one metre from the origin that rests on a wall of 1e8 N/m under its weight.
struct FarFromTheOrigin {
  System system;
  Eigen::VectorXd rest;

  FarFromTheOrigin() {
    const Opening opening{.mass = 1.0, .stiffness = 1e8, .gap = 1.0};
    system.coordinate(system.add_body(point_mass(opening.mass)), 0);
    system.add_element(opening.wall());
    push(system, [](double) { return kPush; });
    rest = opening.rest();
  }
};

TEST(HardN14_LimitsBelowRounding, ABodyAtRestStartsAndStaysWhateverTheLimits) {
  // A position of 1 m is given to 1e-16 m: over the first stage of 1e-7 s that is 1e-9 m/s.
  for (double scale = 1.0; scale > 1e-12; scale *= 0.01) {
    FarFromTheOrigin body;
    StepOptions options;
    options.accuracy.velocity_scale = scale;
    Dirk method(body.system, options);
    ASSERT_NO_THROW(method.start(0.0, body.rest, vector(0.0))) << scale;
    while (method.state().time < 1e-3) method.step(1e-3);
    EXPECT_LT(std::abs(method.state().v_y(0)), 1e-7) << scale;
    const std::vector<BodyError> errors = method.estimate().bodies(method.weights());
    EXPECT_TRUE(accuracy_warnings(errors, options.accuracy, method.estimate().steps()).empty())
        << scale;
  }
}

}  // namespace
}  // namespace clatter::dynamics
