// SPDX-License-Identifier: GPL-3.0-or-later
// Fluid, leak gap, check valve and relief valve of hydraulic elements. Figures with many digits are
// those of the timing drive's reference, computed apart from this code.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/dynamics/hydraulic_rig.hpp"

namespace clatter::dynamics {
namespace {

using testing::kBar;

double difference(const std::function<double(double)>& f, double at, double step) {
  return (f(at + step) - f(at - step)) / (2.0 * step);
}

TEST(ChamberFluid, OracleModuliOfAeratedOil) {
  const ChamberFluid oil = ChamberFluid::oil({});
  const double reference[][2] = {{1.0, 4.7907}, {3.5, 40.0228}, {10.0, 212.306}, {30.0, 766.665}};
  // Half of the last digit given.
  for (const auto& [bar, mpa] : reference)
    EXPECT_NEAR(oil.modulus(bar * kBar) / 1e6, mpa, mpa < 100.0 ? 5e-5 : 5e-4) << bar;
}

TEST(ChamberFluid, PressureIsTheInverseOfTheDensityFromVacuumToAThousandBar) {
  for (const double free_air : {1e-5, 0.03, 0.5}) {
    OilSpec spec;
    spec.free_air = free_air;
    for (const ChamberFluid& fluid : {ChamberFluid::oil(spec), ChamberFluid::air(dry_air(1.4))})
      for (double p = 2e2; p < 1e8; p *= 1.3) {
        // Rounding of ln(rho), 1e-16, times the modulus.
        const double rounding = 1e-13 + 1e-14 * fluid.modulus(p) / p;
        EXPECT_NEAR(fluid.pressure(fluid.density(p)) / p, 1.0, rounding) << free_air << " " << p;
      }
  }
}

TEST(ChamberFluid, PressureOfAnyContentIsPositive) {
  const ChamberFluid oil = ChamberFluid::oil({});
  double last = 1e9;
  for (double density = 1000.0; density > 1e-3; density *= 0.8) {
    const double p = oil.pressure(density);
    EXPECT_GT(p, 0.0) << density;
    EXPECT_LT(p, last) << density;
    last = p;
  }
}

TEST(ChamberFluid, ModulusAndEnthalpyBelongToItsDensity) {
  for (const ChamberFluid& fluid : {ChamberFluid::oil({}), ChamberFluid::air(dry_air(1.4))})
    for (double p = 1e3; p < 1e8; p *= 3.0) {
      const double slope = difference([&](double q) { return fluid.density(q); }, p, 1e-4 * p);
      EXPECT_NEAR(fluid.density(p) / slope / fluid.modulus(p), 1.0, 1e-6) << p;
      // Central differences of 1e-4: 1e-8 times third derivatives.
      const double volume = difference([&](double q) { return fluid.enthalpy(q); }, p, 1e-4 * p);
      EXPECT_NEAR(volume * fluid.density(p), 1.0, 1e-6) << p;
    }
}

TEST(ChamberFluid, AirAloneHasTheModulusKappaP) {
  const ChamberFluid air = ChamberFluid::air(dry_air(1.4));
  for (const double p : {1e3, 1e5, 1e7}) EXPECT_DOUBLE_EQ(air.modulus(p), 1.4 * p);
}

TEST(LeakGap, OracleOfTensionerAndLashAdjuster) {
  const ChamberSpec tensioner;
  const double G = leak_conductance(tensioner.leak, tensioner.diameter, tensioner.oil.viscosity);
  EXPECT_NEAR(G, 1.218557e-11, 5e-18);
  const double A = tensioner.area(), c = A * A / G;
  EXPECT_NEAR(c, 506.214, 5e-4);
  const double K = A * A * ChamberFluid::oil({}).modulus(3.5e5) / tensioner.volume;
  EXPECT_NEAR(K, 98752.37, 5e-3);
  EXPECT_NEAR(c / K, 5.126091e-3, 5e-10);
  LeakGap gap{7e-6, 12e-3, 0.0, false};
  const double area = 0.25 * std::numbers::pi * 81e-6;
  EXPECT_NEAR(area * area / leak_conductance(gap, 9e-3, 10e-3), 6.00933e5, 0.5);
  EXPECT_NEAR(222.4 * leak_conductance(gap, 9e-3, 10e-3) / (area * area), 0.370091e-3, 5e-10);
  EXPECT_NEAR(1e-3 * area * area / (222.4 * leak_conductance(gap, 9e-3, 10e-3)), 2.70204, 5e-6);
  gap.eccentricity = 1.0;
  EXPECT_NEAR(1e-3 * area * area / (222.4 * leak_conductance(gap, 9e-3, 10e-3)), 1.08081, 1e-5);
}

TEST(CheckValve, OracleOfItsFlow) {
  const CheckValve valve({}, 850.0);
  // The flow is laminar near 0: 2.5e-7 below the orifice's at 1 bar.
  EXPECT_NEAR(valve.flow(1e5, 0.0).value * 1e6, 42.5034, 6e-5);
  EXPECT_NEAR(valve.flow(3.5e5, 0.0).value / ChamberSpec().area(), 1.01244, 5e-6);
  EXPECT_EQ(valve.flow(-1e5, 0.0).value, 0.0);
}

TEST(CheckValve, OpensSmoothlyAndMonotonically) {
  CheckValveSpec spec;
  spec.opening = 1e3;
  const CheckValve valve(spec, 850.0);
  double last = 0.0;
  for (double p = -500.0; p < 3000.0; p += 10.0) {
    EXPECT_GE(valve.flow(p, 0.0).value, last) << p;
    last = valve.flow(p, 0.0).value;
    const double slope = difference([&](double q) { return valve.flow(q, 0.0).value; }, p, 1e-2);
    EXPECT_NEAR(valve.flow(p, 0.0).by_pressure, slope, 1e-12) << p;
  }
  EXPECT_EQ(valve.lift(2e3, 0.0), spec.lift);
  EXPECT_EQ(valve.lift(1e3, 0.0), 0.0);
}

TEST(CheckValve, ForcesOnTheBallHaveTheirDerivativesAndNeverPull) {
  CheckValveSpec spec;
  spec.ball = CheckValveSpec::Ball::kMoving;
  spec.spring_force = 0.1;
  spec.spring_rate = 50.0;
  const CheckValve valve(spec, 850.0);
  for (const double lift : {-1e-6, 2e-4, 0.421e-3})
    for (const double speed : {-3.0, -0.5, 0.5, 3.0}) {
      const BallForce at = valve.ball(lift, speed);
      const double k = difference([&](double x) { return valve.ball(x, speed).value; }, lift, 1e-9);
      const double c = difference([&](double v) { return valve.ball(lift, v).value; }, speed, 1e-4);
      EXPECT_NEAR(at.by_lift, k, 1e-6 * spec.contact_stiffness) << lift << " " << speed;
      EXPECT_NEAR(at.by_speed, c, 1e-6 * std::abs(c) + 1e-9) << lift << " " << speed;
      EXPECT_GE(at.lost, 0.0);
      const double contact =
          at.value + spec.spring_force + spec.spring_rate * lift + spec.drag * speed;
      EXPECT_GE(lift < 0.0 ? contact : -contact, -1e-12);
    }
}

TEST(ReliefValve, OpensAtItsPressureWithItsGradient) {
  const ReliefSpec relief{20.0 * kBar, 1e-10};
  EXPECT_EQ(relief_flow(relief, 20.0 * kBar).value, 0.0);
  EXPECT_NEAR(relief_flow(relief, 30.0 * kBar).value, 1e-10 * 9.5 * kBar, 1e-18);
  for (double p = 19.0 * kBar; p < 22.0 * kBar; p += 0.093 * kBar) {
    const double slope = difference([&](double q) { return relief_flow(relief, q).value; }, p, 1.0);
    EXPECT_NEAR(relief_flow(relief, p).by_pressure, slope, 1e-15) << p;
  }
  EXPECT_EQ(relief_flow({}, 1e9).value, 0.0);
}

TEST(Chamber, DerivativesAreThoseOfPressureAndInflow) {
  for (const auto ball : {CheckValveSpec::Ball::kQuasiStatic, CheckValveSpec::Ball::kMoving,
                          CheckValveSpec::Ball::kStuckOpen, CheckValveSpec::Ball::kStuckShut}) {
    ChamberSpec spec;
    spec.valve.ball = ball;
    spec.relief = {5.0 * kBar, 1e-10};
    const Chamber chamber(spec, [](double) { return 3.5e5; });
    for (const double p : {0.2 * kBar, 3.4905 * kBar, 9.0 * kBar}) {
      const double s = 2e-4, x = 1e-4, m = chamber.content(s, p);
      const auto at = [&](double travel, double content, double lift) {
        ChamberState state;
        chamber.move(0.0, travel, content, lift, state);
        return state;
      };
      const ChamberState here = at(s, m, x);
      const auto expect = [&](const auto& value, const ByMotion& by) {
        const auto near = [&](double found, double exact) {
          EXPECT_NEAR(found, exact, 1e-5 * std::abs(exact) + 1e-30) << p;
        };
        near(by.by_travel, difference([&](double d) { return value(at(d, m, x)); }, s, 1e-9));
        near(by.by_content, difference([&](double d) { return value(at(s, d, x)); }, m, 1e-7 * m));
        near(by.by_lift, difference([&](double d) { return value(at(s, m, d)); }, x, 1e-9));
      };
      expect([](const ChamberState& state) { return state.pressure.value; }, here.pressure);
      expect([](const ChamberState& state) { return state.inflow.value; }, here.inflow);
      EXPECT_GE(chamber.lost(here), 0.0);
    }
  }
}

TEST(Chamber, WithoutVolumeOrContentIsRefused) {
  const Chamber chamber({}, [](double) { return 3.5e5; });
  ChamberState state;
  EXPECT_THROW(chamber.move(0.0, -40e-3, 1e-3, 0.0, state), StepRefused);
  EXPECT_THROW(chamber.move(0.0, 0.0, 0.0, 0.0, state), StepRefused);
  EXPECT_THROW(chamber.move(0.0, 0.0, std::nan(""), 0.0, state), StepRefused);
}

}  // namespace
}  // namespace clatter::dynamics
