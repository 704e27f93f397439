// SPDX-License-Identifier: GPL-3.0-or-later
// Lift laws of cams, periodic splines, and torques over angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/given/cam_law.hpp"
#include "dynamics/shaft/turn_torque.hpp"
#include "tests/dynamics/mechanisms.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kPi = std::numbers::pi;

/// The train of the reference: 7.5 mm over +-70 deg, 150 N and 22214.3 N/m.
CamTrain train(double mass) {
  return {CamLaw::polynomial(7.5e-3, 70.0 * kDegree), {0.3}, 2.0, 150.0, 22214.28, mass};
}

double unit(double) { return 1.0; }

double moment(TurnTorque& torque, double angle, double speed) {
  Response response;
  torque.evaluate({0.0, 1e-5, 1, {}}, Eigen::VectorXd::Constant(1, angle),
                  Eigen::VectorXd::Constant(1, speed), false, response);
  return response.force(0);
}

TEST(CamLaw, OracleOfThePolynomialLaw) {
  const CamLaw law = CamLaw::polynomial(7.5e-3, 70.0 * kDegree);
  const SplinePoint before = law.at(-30.0 * kDegree), after = law.at(30.0 * kDegree + 4.0 * kPi);
  EXPECT_NEAR(before.value, 4.079933e-3, 1e-9);  // the reference's digits
  EXPECT_NEAR(before.first, 10.519332e-3, 1e-9);
  EXPECT_NEAR(after.value, 4.079933e-3, 1e-9);
  EXPECT_NEAR(after.first, -10.519332e-3, 1e-9);
  EXPECT_NEAR(law.at(0.0).value, 7.5e-3, 1e-18);
  EXPECT_EQ(law.at(71.0 * kDegree).value, 0.0);
}

/// Derivatives of a law against central differences of the ones before.
template <class Law>
void expect_derivatives(const Law& law, double from, double to) {
  const double h = 1e-5;
  for (double x = from; x < to; x += 0.037) {
    const SplinePoint at = law(x), low = law(x - h), high = law(x + h);
    EXPECT_NEAR((high.value - low.value) / (2 * h), at.first, 1e-7) << x;
    EXPECT_NEAR((high.first - low.first) / (2 * h), at.second, 1e-7) << x;
    EXPECT_NEAR((high.second - low.second) / (2 * h), at.third, 2e-5) << x;
  }
}

TEST(CamLaw, DerivativesAreThoseOfTheLift) {
  const CamLaw law = CamLaw::polynomial(7.5e-3, 70.0 * kDegree);
  expect_derivatives([&](double x) { return law.at(x); }, -1.2, 1.2);
}

TEST(PeriodicSpline, InterpolatesAndConvergesWithItsDegree) {
  const auto wave = [](double x) { return std::exp(std::sin(x)); };
  for (const int degree : {3, 5}) {
    double before = 0.0;
    for (const int n : {20, 40, 80}) {
      std::vector<double> x, y;
      for (int i = 0; i < n; ++i) {
        // Not equidistant.
        const double t = 2.0 * kPi * i / n;
        x.push_back(t + 0.2 * std::sin(t));
        y.push_back(wave(x.back()));
      }
      const PeriodicSpline spline(degree, x, y, 2.0 * kPi);
      double error = 0.0;
      for (int i = 0; i < 997; ++i) {
        const double t = -20.0 + 0.043 * i;
        error = std::max(error, std::abs(spline.at(t).value - wave(t)));
      }
      for (size_t i = 0; i < x.size(); ++i)
        EXPECT_NEAR(spline.at(x[i] - 4.0 * kPi).value, y[i], 1e-13);
      if (before != 0.0) {
        // Of order degree + 1: 16 or 64 times smaller.
        EXPECT_GT(before / error, degree == 3 ? 12.0 : 45.0) << degree << " " << n;
      }
      before = error;
    }
    EXPECT_LT(before, degree == 3 ? 1e-5 : 1e-7);
  }
}

TEST(PeriodicSpline, DerivativesAreContinuousToItsDegreeLessOne) {
  std::vector<double> x, y;
  const Eigen::VectorXd values = testing::arbitrary(9, 3);
  for (int i = 0; i < 9; ++i) {
    x.push_back(0.6 * i + 0.1 * values(8 - i));
    y.push_back(values(i));
  }
  for (const int degree : {3, 5}) {
    const PeriodicSpline spline(degree, x, y, 6.0);
    for (const double knot : x) {
      const SplinePoint low = spline.at(knot - 1e-9), high = spline.at(knot + 1e-9);
      EXPECT_NEAR(low.first, high.first, 1e-6);
      EXPECT_NEAR(low.second, high.second, 1e-5);
      if (degree == 5) {
        EXPECT_NEAR(low.third, high.third, 1e-4);
      }
    }
  }
}

TEST(CamLaw, ATableOfThePolynomialIsThePolynomial) {
  const auto folder = testing::test_folder();
  const CamLaw law = CamLaw::polynomial(7.5e-3, 70.0 * kDegree);
  std::ofstream file(folder / "lift.csv");
  file << "cam_angle [deg], lift [mm]\n";
  for (int i = -180; i <= 180; ++i)
    file << i << ", " << fmt::format("{:.12g}", 1e3 * law.at(i * kDegree).value) << "\n";
  file.close();
  for (const int degree : {3, 5}) {
    const CamLaw table = read_cam_table(folder / "lift.csv", "", degree);
    for (double x = -3.0; x < 3.0; x += 0.0137) {
      // The third derivative jumps where the lift begins: 6 h/half^3 * 8 by half a degree there.
      EXPECT_NEAR(table.at(x).value, law.at(x).value, 2e-8);
      EXPECT_NEAR(table.at(x).first, law.at(x).first, 1e-5);
    }
  }
}

TEST(CamLaw, TablesAreRefusedByLine) {
  const auto folder = testing::test_folder();
  const auto refused = [&](const std::string& text) {
    std::ofstream(folder / "lift.csv") << text;
    return test::refusal_of([&] { read_cam_table(folder / "lift.csv", "", 5); });
  };
  const std::string header = "cam_angle [deg], lift [mm]\n";
  test::expect_parts(refused(header + "0,0\n90,1\n180,-2\n270,0\n"),
                     {"lift.csv:4: lift: found -2 mm, expected a lift of at least 0"});
  test::expect_parts(refused(header + "0,0\n90,1\n180,2\n270,0\n360,1\n"),
                     {"lift.csv:6: the last row closes the period with 0.001 m, expected"});
  test::expect_parts(refused(header + "0,0\n90,1\n180,2\n370,0\n"),
                     {"lift.csv:5: the table spans 370 deg, expected one period of 360 deg"});
  test::expect_parts(refused(header + "0,0\n10,1\n20,2\n30,0\n"),
                     {"lift.csv:5: the table ends 330 deg before the period of 360 deg"});
  test::expect_parts(refused(header + "0,0\n180,1\n"),
                     {"found 2 rows, expected a complete period"});
  test::expect_parts(refused("time [s], lift [mm]\n0,0\n"),
                     {"lift.csv:1: time is in [s], expected [deg] or [rad]"});
  test::expect_parts(refused("cam_angle [deg], lift [N]\n0,0\n"),
                     {"lift.csv:1: lift is in [N], expected a unit of [m]"});
}

TEST(CamTorque, IsTheSpringsForceTimesTheSlopeOfTheLift) {
  CamTorque torque("cam", 0, std::nullopt, train(0.0), unit);
  const double y = 4.079933e-3, slope = 10.519332e-3, force = 150.0 + 22214.28 * y;
  // On opening it brakes, on closing it drives; two valves.
  EXPECT_NEAR(moment(torque, 0.3 - 30.0 * kDegree, 178.0), -2.0 * force * slope, 1e-6);
  EXPECT_NEAR(moment(torque, 0.3 + 30.0 * kDegree, 178.0), 2.0 * force * slope, 1e-6);
  // With inertia: F + m w^2 y''.
  CamTorque heavy("cam", 0, std::nullopt, train(0.08), unit);
  const double second = train(0.0).law.at(30.0 * kDegree).second;
  EXPECT_NEAR(moment(heavy, 0.3 + 30.0 * kDegree, 178.0),
              2.0 * (force + 0.08 * 178.0 * 178.0 * second) * slope, 1e-6);
}

TEST(CamTorque, WithoutMassItsWorkOverATurnIsZero) {
  CamTorque torque("cam", 0, std::nullopt, train(0.0), unit);
  // The rectangle rule on a periodic function.
  const int n = 20000;
  double work = 0.0, size = 0.0;
  for (int i = 0; i < n; ++i) {
    const double now = moment(torque, 2.0 * kPi * i / n, 178.0) * 2.0 * kPi / n;
    work += now;
    size += std::abs(now);
  }
  EXPECT_LT(std::abs(work), 1e-10 * size);  // of the rule where the lift begins
  // To full lift it is the springs' energy.
  double lifted = 0.0;
  const int m = 100000;
  for (int i = 0; i < m; ++i) {
    const double from = 0.3 - 70.0 * kDegree;
    lifted -= moment(torque, from + 70.0 * kDegree * (i + 0.5) / m, 178.0) * 70.0 * kDegree / m;
  }
  EXPECT_NEAR(lifted, 2.0 * (150.0 * 7.5e-3 + 0.5 * 22214.28 * 7.5e-3 * 7.5e-3), 1e-8);
}

TEST(CamTorque, AValveThatFloatsPullsNothing) {
  CamTorque torque("cam", 0, std::nullopt, train(0.08), unit);
  // m w^2 6 h/half^2, half = 1.22 rad, is 5430 N at full lift, where the springs press with 317 N.
  for (double x = -0.3; x < 0.3; x += 0.05) EXPECT_EQ(moment(torque, 0.3 + x, 1500.0), 0.0) << x;
  for (const double speed : {100.0, 300.0, 420.0, 1500.0})
    for (double angle = -1.3; angle < 1.9; angle += 0.11) {
      CamTorque same("cam", 0, 1, train(0.08), unit);
      Eigen::Vector2d y(angle + 0.4, 0.4), v(speed + 3.0, 3.0);
      Response response;
      same.evaluate({0.0, 1e-5, 1, {}}, y, v, false, response);
      EXPECT_NEAR(response.force(0), moment(torque, angle, speed), 1e-9);
      EXPECT_EQ(response.force(1), -response.force(0));
    }
}

TEST(TurnTorque, TangentsAreDifferenceQuotients) {
  for (const double angle : {-0.7, -0.2, 0.4, 1.2}) {
    CamTorque cam("cam", 0, 1, train(5e3), unit);  // its speed is near 1 rad/s
    EXPECT_LT(testing::tangent_error(cam, Eigen::Vector2d(angle, 0.1), Eigen::Vector2d(0.9, 0.2)),
              1e-6);
  }
  TorqueTable table;
  table.constant = 3.0;
  table.orders = {{1.5, 2.0, 0.3}, {3.0, 1.0, 0.7}};
  table.table = PeriodicSpline(5, {0.0, 1.0, 2.5, 4.0, 5.0}, {1.0, -2.0, 0.5, 2.0, 0.3}, 2.0 * kPi);
  table.zero = 0.2;
  table.speed = 0.8;
  table.drag = 0.6;
  table.drag_speed = 0.5;
  table.viscous = 0.3;
  TableTorque torque("t", 0, 1, table, unit);
  EXPECT_LT(testing::tangent_error(torque, Eigen::Vector2d(0.5, 0.1), Eigen::Vector2d(0.9, 0.2)),
            1e-7);
}

TEST(TurnTorque, IsTheSumOfItsTermsBySpeed) {
  TorqueTable table;
  table.constant = 5.0;
  table.orders = {{3.0, 79.3, -0.5}};
  table.zero = 0.1;
  table.speed = 356.0;
  table.drag = 0.6;
  TableTorque torque("t", 0, std::nullopt, table, unit);
  // A quarter at half the speed, less the drag.
  EXPECT_NEAR(moment(torque, 0.4, 178.0), 0.25 * (5.0 + 79.3 * std::cos(0.9 - 0.5)) - 0.6, 1e-6);
  EXPECT_NEAR(moment(torque, 0.4, -178.0), 0.25 * (5.0 + 79.3 * std::cos(0.9 - 0.5)) + 0.6, 1e-6);
}

}  // namespace
}  // namespace clatter::dynamics
