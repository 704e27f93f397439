// SPDX-License-Identifier: GPL-3.0-or-later
// Shafts that turn by a table of speed or angle.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "dynamics/given/drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

/// Largest difference of speed and acceleration from central differences of the angle and the
/// speed, relative to the largest values.
double inconsistency(const TurnTable& table, double begin, double end) {
  const double h = 1e-5;
  double worst = 0.0, speed = 0.0, acceleration = 0.0;
  for (double t = begin + h; t < end - h; t += 7.3e-3) {
    const auto low = table.at(t - h), at = table.at(t), high = table.at(t + h);
    speed = std::max(speed, std::abs(at.velocity));
    acceleration = std::max(acceleration, std::abs(at.acceleration));
    worst = std::max(
        {worst, std::abs((high.position - low.position) / (2 * h) - at.velocity) / speed,
         std::abs((high.velocity - low.velocity) / (2 * h) - at.acceleration) / acceleration});
  }
  return worst;
}

TEST(TurnTable, OfSpeedGoesThroughItsRowsAndIsTheDerivativeOfItsAngle) {
  const std::vector<double> time{0.0, 0.1, 0.25, 0.3, 0.6, 1.0},
      speed{0.0, 20.0, 90.0, 95.0, 95.0, 60.0};
  const TurnTable table = TurnTable::of_speed(time, speed);
  double angle = 0.0;
  for (size_t i = 0; i < time.size(); ++i) {
    EXPECT_NEAR(table.at(time[i]).velocity, speed[i], 1e-12 * 95.0);
    EXPECT_NEAR(table.at(time[i]).position, angle, 1e-12 * 70.0);
    if (i + 1 == time.size()) break;
    // Simpson's rule is exact for a cubic.
    const double h = time[i + 1] - time[i], middle = table.at(time[i] + 0.5 * h).velocity;
    angle += h / 6.0 * (speed[i] + 4.0 * middle + speed[i + 1]);
    EXPECT_GE(middle, std::min(speed[i], speed[i + 1]));
    EXPECT_LE(middle, std::max(speed[i], speed[i + 1]));
    if (i == 0) continue;
    // No jump of the acceleration at a row.
    EXPECT_NEAR(table.at(time[i] - 1e-9).acceleration, table.at(time[i] + 1e-9).acceleration, 1e-4);
  }
  // Differences over 1e-5 s: their error is (1e-5)^2 / 6 of the third derivative, and rounding.
  EXPECT_LT(inconsistency(table, 0.0, 1.0), 1e-4);
  // Beyond the last row the speed stays.
  EXPECT_NEAR(table.at(1.5).position, angle + 0.5 * 60.0, 1e-10);
  EXPECT_EQ(table.at(1.5).acceleration, 0.0);
}

TEST(TurnTable, OfAngleTendsToTheMotionThatItSamples) {
  // sin(3 t) from 0 to pi / 3: its second derivative is zero at both ends, as the spline's.
  const auto errors = [](int rows) {
    std::vector<double> time, angle;
    for (int i = 0; i <= rows; ++i) {
      time.push_back(std::numbers::pi / 3.0 * i / rows);
      angle.push_back(std::sin(3.0 * time.back()));
    }
    const TurnTable table = TurnTable::of_angle(time, angle);
    EXPECT_LT(inconsistency(table, 0.0, time.back()), 1e-4);
    Motion<double> worst{0.0, 0.0, 0.0};
    for (double t = 0.0; t < time.back(); t += 1e-3) {
      const Motion<double> at = table.at(t);
      worst.position = std::max(worst.position, std::abs(at.position - std::sin(3 * t)));
      worst.velocity = std::max(worst.velocity, std::abs(at.velocity - 3 * std::cos(3 * t)));
      worst.acceleration =
          std::max(worst.acceleration, std::abs(at.acceleration + 9 * std::sin(3 * t)));
    }
    return worst;
  };
  const Motion<double> coarse = errors(10), fine = errors(20);
  // Orders 4, 3 and 2.
  EXPECT_NEAR(std::log2(coarse.position / fine.position), 4.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.velocity / fine.velocity), 3.0, 0.3);
  EXPECT_NEAR(std::log2(coarse.acceleration / fine.acceleration), 2.0, 0.3);
}

TEST(TurnTable, TheMotionOfADriveByATableNeverRepeats) {
  const Drive drive(TurnTable::of_speed({0.0, 1.0}, {10.0, 10.0}), 0.5);
  EXPECT_FALSE(drive.repeats(2.0 * std::numbers::pi / 10.0));
  EXPECT_DOUBLE_EQ(drive.at(0.25).position, 3.0);
}

class DriveTables : public ::testing::Test {
 protected:
  /// A mass on a spring from a point of the shaft.
  Scene scene(const std::string& drive) {
    std::ofstream(folder_ / "drive.run.toml")
        << "[time]\nend_s = 0.5\noutput_step_us = 1000\n[[drive]]\nname = \"motor\"\naxis = \"z\"\n"
        << drive
        << "[[rigid_body]]\nname = \"mass\"\nmotion = \"space\"\nmass_kg = 1\n"
           "inertia_kg_m2 = [1, 1, 1]\ncentre_mm = [100, 0, 0]\n[[bushing]]\n"
           "a = { body = \"mass\", at_mm = [100, 0, 0] }\nb = { body = \"motor\" }\n"
           "stiffness_n_m = 1e4\ndamping_n_s_m = 50\n";
    return read_scene(folder_ / "drive.run.toml");
  }
  double last_y(const std::string& drive) {
    RunResult result;
    const H5File file = testing::complete_file(scene(drive), folder_ / "drive.run.h5", result);
    EXPECT_LT(result.energy_residue, 1e-4);
    return file.read_doubles("history/mass_y").back();
  }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
  }
  std::filesystem::path folder_ = testing::test_folder();
};

TEST_F(DriveTables, OfASteadySpeedAndOfItsAngleTurnLikeTheSpeedItself) {
  write("speed.csv", "time [s], speed [rpm]\n0, 90\n0.2, 90\n1, 90\n");
  write("angle.csv", "time [s], other [m], angle [deg]\n0, 1, 0\n0.4, 1, 216\n1, 1, 540\n");
  const double expected = last_y("speed_rpm = 90\n");
  EXPECT_GT(std::abs(expected), 0.01);
  EXPECT_NEAR(last_y("table = \"speed.csv\"\n"), expected, 1e-9);
  EXPECT_NEAR(last_y("table = \"angle.csv\"\ncolumn = \"angle\"\n"), expected, 1e-9);
}

TEST_F(DriveTables, OrdersOfATorqueAreTheSpeedThatItMakesOfTheInertia) {
  // J speed' = T cos(1.5 turns + 0.3): T = 4 N m on 0.2 kg m2 at 1200 rpm.
  const double mean = 40.0 * std::numbers::pi, phase = 0.3;
  std::string rows = "time [s], speed [rad/s]\n";
  for (int i = 0; i <= 20000; ++i) {
    const double t = i * 5e-5;
    rows += fmt::format("{:.17g}, {:.17g}\n", t,
                        mean + 4.0 / (0.2 * 1.5 * mean) * std::sin(1.5 * mean * t + phase));
  }
  write("speed.csv", rows);
  const double expected = last_y("table = \"speed.csv\"\n");
  const std::string start =
      "speed_rpm = 1200\ninertia_kg_m2 = 0.2\n[[drive.order]]\norder = 1.5\n"
      "phase_deg = 17.188733853924695\n";
  EXPECT_NEAR(last_y(start + "torque_n_m = 4\n"), expected, 1e-8);
  EXPECT_GT(std::abs(last_y(start + "torque_n_m = 1\n") - expected), 1e-6);
  // Torques of masses grow with the square of the speed.
  EXPECT_NEAR(last_y(start + "torque_n_m = 1\nat_speed_rpm = 600\n"), expected, 1e-8);
}

TEST_F(DriveTables, AnglesThatBeginAnewAreRefusedOrGoOnInWholeTurns) {
  for (const double period : {360.0, 720.0}) {
    std::string wrapped = "time [s], angle [deg]\n", steady = wrapped;
    for (int i = 0; i <= 40; ++i) {
      const double angle = 540.0 - 54.0 * i;  // backwards, over several wraps
      wrapped +=
          fmt::format("{}, {:.12g}\n", 0.025 * i, angle - period * std::floor(angle / period));
      steady += fmt::format("{}, {:.12g}\n", 0.025 * i, angle);
    }
    write("wrapped.csv", wrapped);
    write("steady.csv", steady);
    test::expect_parts(
        test::refusal_of([&] { build_model(scene("table = \"wrapped.csv\"\n"), {}); }),
        {"wrapped.csv:", "an angle that begins anew throws the shaft back", "unwrap = true"});
    EXPECT_NEAR(last_y("table = \"wrapped.csv\"\nunwrap = true\n"),
                last_y("table = \"steady.csv\"\n"), 1e-9);
  }
}

TEST_F(DriveTables, AreRefusedByPlace) {
  write("speed.csv", "time [s], speed [rpm]\n0, 90\n0.2, 90\n1, 90\n");
  write("short.csv", "time [s], speed [rpm]\n0, 90\n0.2, 90\n");
  write("force.csv", "time [s], force [N]\n0, 90\n1, 90\n");
  write("turn.csv", "angle [deg], speed [rpm]\n0, 90\n1, 90\n");
  write("one.csv", "time [s], speed [rpm]\n0, 90\n");
  write("twice.csv", "time [s], speed [rpm], speed [rpm]\n0, 90, 80\n1, 90, 80\n");
  const auto expect = [&](const std::string& drive, const std::string& said) {
    const std::string found = test::refusal_of([&] { build_model(scene(drive), {}); });
    EXPECT_NE(found.find(said), std::string::npos) << found;
  };
  expect("table = \"speed.csv\"\n", "accepted");
  expect("table = \"speed.csv\"\nspeed_rpm = 90\n",
         "drive.run.toml:7: drive[0].table: speed_rpm and table exclude each other");
  expect("speed_rpm = 90\ncolumn = \"speed\"\n", "drive[0].column: needs table");
  expect("table = \"short.csv\"\n",
         "short.csv:3: the table covers 0 to 0.2 s, expected 0 to 0.5 s");
  expect("table = \"force.csv\"\n",
         "force.csv:1: force: found [N], expected a speed in [rpm] or [rad/s], or an angle");
  expect("table = \"turn.csv\"\n", "turn.csv:1: angle: found [rad], expected a time");
  expect("table = \"one.csv\"\n", "one.csv:2: found one row, expected at least two");
  expect("table = \"twice.csv\"\n",
         "twice.csv:1: columns 2 and 3 are both \"speed\", expected different names");
  expect("", "drive[0].speed_rpm: ");
  const std::string torque = "[[drive.order]]\norder = 1\ntorque_n_m = 1\n";
  expect("speed_rpm = 90\n" + torque, "drive[0].inertia_kg_m2: is missing");
  expect("speed_rpm = 0\ninertia_kg_m2 = 1\n" + torque,
         "drive[0].speed_rpm: found 0 with orders of a torque");
  expect("speed_rpm = 90\ninertia_kg_m2 = 1\n" + torque + "amplitude_rpm = 1\n",
         "drive[0].order[0].torque_n_m: amplitude_rpm and torque_n_m exclude each other");
}

}  // namespace
}  // namespace clatter::dynamics
