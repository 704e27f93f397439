// SPDX-License-Identifier: GPL-3.0-or-later
// Damping of the asperity contact: its law, and a ball that bounces on a rough wall.
#include "dynamics/film/contact_damping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "film_march.hpp"
#include "piston_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

constexpr double kMass = 0.02;  // of the ball [kg]

double amplitude(const ContactDampingOptions& damping) {
  return 0.5 * std::numbers::pi * damping.loss_factor;
}

/// w of contact_damping.hpp at the speed u.
double saturation(double u, double v_0) { return u / std::sqrt(u * u + v_0 * v_0); }

TEST(ContactDamping, ItsRatioIsSmoothAndNeverPulls) {
  for (const double eta : {0.0, 0.01, 0.05, 0.6}) {
    const ContactDampingOptions options{eta, 1e-2};
    const ContactDamping law(options);
    const double a = amplitude(options);
    EXPECT_EQ(law.at(0.0).value, 1.0);
    EXPECT_DOUBLE_EQ(law.at(0.0).slope, -a / options.speed);  // chi of Hunt and Crossley
    for (double rate = -10.0; rate < 10.0; rate += 0.0137) {
      const ContactDamping::Ratio ratio = law.at(rate);
      EXPECT_GT(ratio.value, 0.0);
      EXPECT_NEAR(ratio.value + law.at(-rate).value, 2.0, 1e-15);  // rounding
      EXPECT_GE((1.0 - ratio.value) * rate, 0.0);                  // the loss over p_a
      EXPECT_LE(std::abs(1.0 - ratio.value), a);
    }
    for (double rate = -3e-2; rate < 3e-2; rate += 1.37e-3) {
      const double d = 1e-5;  // 1e-3 of v_0: 1e-6 of the largest slope
      const double slope = (law.at(rate + d).value - law.at(rate - d).value) / (2.0 * d);
      EXPECT_NEAR(law.at(rate).slope, slope, 2e-6 * a / options.speed) << rate;
    }
  }
  test::expect_parts(test::refusal_of([] {
                       ContactDamping({0.7, 1e-2});
                     }),
                     {"contact damping: found loss factor 0.7, speed 0.01 m/s, expected 0 to 0.6 "
                      "and > 0"});
}

/// A wall so narrow and low that the piston meets it like a ball; the gap at y = 0 is `reach`.
PistonLinerOptions rough_wall(AsperityOptions::Law law, const ContactDampingOptions& damping) {
  PistonLinerOptions options;
  options.effects = {false, true, true, false};
  options.cells_around = options.cells_along = 2;
  options.pad_span = std::numbers::pi / 180.0;
  options.skirt_bottom = -10e-3;
  options.skirt_top = 10e-3;
  options.asperity.law = law;
  options.damping = damping;
  options.clearance = Asperity(options.asperity).reach();
  return options;
}

struct Bounce {
  double restitution = 0.0, depth = 0.0;  // depth: largest y [m]
  double largest_rise = 0.0;  // of the energy in one step, over the energy at the start [1]
  double imbalance = 0.0;     // energy at the end plus losses, over that at the start, less 1
};

Bounce bounce(const PistonLinerOptions& options, double speed) {
  const auto element = make_element(options, false);
  Eigen::VectorXd mass = Eigen::VectorXd::Constant(6, kMass), v = Eigen::VectorXd::Zero(6);
  v[1] = speed;
  Flight ball(*element, mass, Eigen::VectorXd::Zero(6), v);
  ball.start();
  const double start = 0.5 * kMass * speed * speed, dt = 2e-9 / speed;  // at most 2 nm a step
  double energy = start, spent = 0.0, lost = element->power(ball.y, ball.v).lost;
  Bounce result;
  for (int k = 0; k < 200000 && ball.y[1] >= 0.0; ++k) {
    EXPECT_TRUE(ball.step(dt));
    const dynamics::Power power = element->power(ball.y, ball.v);
    EXPECT_GE(power.lost, 0.0);
    if (ball.y[1] >= 0.0) {
      EXPECT_LE(ball.force[1], 0.0);  // the wall never pulls
    }
    const double now = 0.5 * mass.dot(ball.v.cwiseAbs2()) + power.stored;
    result.largest_rise = std::max(result.largest_rise, (now - energy) / start);
    result.depth = std::max(result.depth, ball.y[1]);
    energy = now;
    spent += 0.5 * dt * (lost + power.lost);
    lost = power.lost;
  }
  result.restitution = -ball.v[1] / speed;
  result.imbalance = (energy + spent) / start - 1.0;
  return result;
}

/// int_0^v u du / (1 + a w(u)) by Simpson's rule; a < 0 for the way out.
double work_integral(double v, double a, double v_0) {
  const int n = 4000;
  double sum = 0.0;
  for (int k = 0; k <= n; ++k) {
    const double u = v * k / n;
    sum += (k == 0 || k == n ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * u / (1.0 + a * saturation(u, v_0));
  }
  return sum * v / (3.0 * n);
}

/// The zero of a function that rises, in [0, 1].
double zero_of(const std::function<double(double)>& rising) {
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (rising(middle) > 0.0 ? high : low) = middle;
  }
  return low;
}

TEST(ContactDamping, RestitutionIsThatOfTheIntegralWhateverThePressuresLaw) {
  for (const auto law : {AsperityOptions::Law::kFit, AsperityOptions::Law::kExact})
    for (const double eta : {0.01, 0.05, 0.2})
      for (const double speed : {2e-3, 1e-2, 0.1, 1.0}) {
        const ContactDampingOptions damping{eta, 1e-2};
        const double a = amplitude(damping), in = work_integral(speed, a, damping.speed);
        const double exact =
            zero_of([&](double e) { return work_integral(e * speed, -a, damping.speed) - in; });
        const Bounce found = bounce(rough_wall(law, damping), speed);
        EXPECT_NEAR(found.restitution, exact, 1e-4) << eta << " " << speed;  // of the time steps
        if (speed == 1.0) {
          EXPECT_NEAR(exact, std::sqrt((1.0 - a) / (1.0 + a)), 1e-3);
        }
        if (law == AsperityOptions::Law::kFit)
          std::printf("    loss factor %.2f, %5.3f m/s: restitution %.5f, integral %.5f\n", eta,
                      speed, found.restitution, exact);
      }
  // Elastic, as without the damping's key: the ball leaves as fast as it came.
  EXPECT_NEAR(bounce(rough_wall(AsperityOptions::Law::kFit, {0.0, 1e-2}), 0.1).restitution, 1.0,
              1e-5);
}

TEST(ContactDamping, SlowBouncesAreThoseOfHuntAndCrossley) {
  // chi v - ln(1 + chi v) = -chi e v - ln(1 - chi e v), from p = p_a (1 - chi h'); to first order
  // e = 1 - 2 chi v / 3.
  const ContactDampingOptions damping{0.5, 1.0};
  const double chi = amplitude(damping) / damping.speed;
  for (const double speed : {0.02, 0.05}) {
    const double s = chi * speed;
    const double exact =
        zero_of([&](double e) { return -e * s - std::log(1.0 - e * s) - (s - std::log(1.0 + s)); });
    const Bounce found = bounce(rough_wall(AsperityOptions::Law::kFit, damping), speed);
    // w differs from h' / v_0 by half the square of it: 1.3e-3 of the loss at the higher speed.
    EXPECT_NEAR(1.0 - found.restitution, 1.0 - exact, 2e-3 * (1.0 - exact) + 1e-5);
    EXPECT_NEAR(exact, 1.0 - 2.0 * s / 3.0, 0.5 * s * s);
  }
}

TEST(ContactDamping, ABounceFollowsTheEquationOfMotionIntegratedApart) {
  const ContactDampingOptions damping{0.1, 1e-2};
  const PistonLinerOptions options = rough_wall(AsperityOptions::Law::kFit, damping);
  const double speed = 0.2, a = amplitude(damping), sigma = options.asperity.roughness;
  const double area = options.bore_radius * options.pad_span * 20e-3;
  const auto acceleration = [&](double y, double v) {
    const double depth = std::max(y, 0.0) / sigma;  // 4 - h / sigma, because the gap is 4 sigma - y
    const double pressure = 1e-3 * 53.3e9 * 4.4086e-5 * std::pow(depth, 6.804);
    return -area * pressure * (1.0 + a * saturation(v, damping.speed)) / kMass;
  };
  // The classical Runge-Kutta method, 0.1 nm a step.
  const double h = 1e-10 / speed;
  double y = 0.0, v = speed, depth = 0.0;
  while (y >= 0.0) {
    const double a1 = acceleration(y, v), v2 = v + 0.5 * h * a1;
    const double a2 = acceleration(y + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
    const double a3 = acceleration(y + 0.5 * h * v2, v3), v4 = v + h * a3;
    const double a4 = acceleration(y + h * v3, v4);
    y += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
    v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    depth = std::max(depth, y);
  }
  const Bounce found = bounce(options, speed);
  EXPECT_NEAR(found.restitution, -v / speed, 1e-4);
  EXPECT_NEAR(found.depth, depth, 1e-4 * depth);  // the pad's cells lie 1e-5 off its middle
}

TEST(ContactDamping, TheEnergyOfABounceNeverGrowsAndItsLossesBalance) {
  for (const double speed : {5e-3, 0.25}) {
    const Bounce found = bounce(rough_wall(AsperityOptions::Law::kFit, {0.05, 1e-2}), speed);
    std::printf("    %.3f m/s: largest rise in a step %.1e, imbalance %.1e of the energy\n", speed,
                found.largest_rise, found.imbalance);
    EXPECT_LT(found.largest_rise, 1e-9);
    EXPECT_LT(std::abs(found.imbalance), 1e-5);  // trapezoidal sum of the losses
  }
}

TEST(ContactDamping, AMirroredThrowGivesTheMirroredFlight) {
  PistonLinerOptions options;
  options.effects.film = false;
  options.cells_around = 8;
  options.cells_along = 9;
  options.clearance = 6e-6;
  options.skirt.barrel_top = 15e-6;
  options.skirt.barrel_bottom = 10e-6;
  Eigen::VectorXd mass(6), at[2], speed[2];
  mass << 2.0, 2.0, 2.0, 4e-3, 4e-3, 4e-3;
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1.0 : -1.0;
    const auto element = make_element(options, false);
    Eigen::VectorXd v = Eigen::VectorXd::Zero(6);
    v[1] = 0.2 * sign;
    v[3] = -1.5 * sign;
    Flight flight(*element, mass, Eigen::VectorXd::Zero(6), v);
    flight.start();
    for (int k = 0; k < 400; ++k) ASSERT_TRUE(flight.step(2e-7));
    at[side] = flight.y;
    speed[side] = flight.v;
    for (const int k : {1, 3}) {
      at[side][k] *= sign;
      speed[side][k] *= sign;
    }
  }
  EXPECT_LT(speed[0][1], 0.0);  // it has bounced
  EXPECT_LT((at[0] - at[1]).norm(), 1e-12 * at[0].norm());
  EXPECT_LT((speed[0] - speed[1]).norm(), 1e-12 * speed[0].norm());
}

}  // namespace
}  // namespace clatter::film
