// SPDX-License-Identifier: GPL-3.0-or-later
// Clocks by a table of the speed.
#include "dynamics/given/speed_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kPi = std::numbers::pi, kMean = 200.0;  // [rad/s]

/// A table of `rows` intervals of one cycle, whose columns are given by a share from 0 to 1.
std::filesystem::path table(const std::string& header, int rows,
                            const std::function<std::string(double)>& row) {
  const std::filesystem::path path = testing::test_folder() / "speed.csv";
  std::ofstream file(path);
  file << header << "\n";
  for (int i = 0; i <= rows; ++i) file << row(static_cast<double>(i) / rows) << "\n";
  return path;
}

TEST(SpeedTable, OverTimeIsTheClockOfItsOrders) {
  // 200 + 6 cos(2 * 200 t) rad/s, orders as a clock of its own.
  const CrankClock known{kMean, {{2.0, 6.0, 0.0}}};
  const double cycle = known.cycle();
  double error[2];
  for (int k = 0; k < 2; ++k) {
    const CrankClock clock =
        read_speed_table(table("time [s], speed [rad/s]", 240 << k,
                               [&](double share) {
                                 return fmt::format("{:.15g}, {:.15g}", share * cycle,
                                                    known.turn(share * cycle).velocity);
                               }),
                         "");
    EXPECT_NEAR(clock.speed, kMean, 1e-4 * kMean);
    error[k] = 0.0;
    for (double t = -1.3 * cycle; t < 2.0 * cycle; t += 0.0137 * cycle) {
      const Motion<double> found = clock.turn(t), expected = known.turn(t);
      error[k] = std::max(error[k], std::abs(found.position - expected.position));
      EXPECT_NEAR(found.velocity, expected.velocity, 0.02);
      const double h = 1e-6;
      EXPECT_NEAR((clock.turn(t + h).velocity - clock.turn(t - h).velocity) / (2.0 * h),
                  found.acceleration, 1.0);  // of 2400 rad/s2; its slope jumps at nodes
      EXPECT_NEAR(clock.time(found.position), t, 1e-12);
    }
    std::printf("%d rows: %.1e rad\n", 240 << k, error[k]);
    EXPECT_NEAR(clock.turn(0.3 * cycle).position + 4.0 * kPi,
                clock.turn(0.3 * cycle + clock.cycle()).position, 1e-12);
  }
  EXPECT_LT(error[1], 1e-4);
  EXPECT_LT(error[1], 0.5 * error[0]);
}

TEST(SpeedTable, OverTheAngleTakesTheTimeOfItsIntegral) {
  // w = a / (1 + b cos 2 theta): t = (theta + b/2 sin 2 theta) / a, so the mean speed is a.
  const double a = kMean, b = 0.05;
  const CrankClock clock = read_speed_table(
      table("angle [deg], speed [rpm]", 720,
            [&](double share) {
              return fmt::format("{:.15g}, {:.15g}", 720.0 * share,
                                 a / (1.0 + b * std::cos(8.0 * kPi * share)) * 30.0 / kPi);
            }),
      "speed");
  EXPECT_NEAR(clock.speed, a, 1e-5 * a);
  for (double theta = -3.0; theta < 15.0; theta += 0.17)
    // The table's monotone cubic between its rows.
    EXPECT_NEAR(clock.turn((theta + 0.5 * b * std::sin(2.0 * theta)) / a).position, theta, 1e-4);
}

TEST(SpeedTable, IsRefusedWithTheRowThatIsWrong) {
  const auto refusal = [](const std::string& header, int rows,
                          const std::function<std::string(double)>& row) {
    return test::refusal_of([&] { read_speed_table(table(header, rows, row), ""); });
  };
  const auto uniform = [](double length) {
    return [length](double share) { return fmt::format("{}, 1900", share * length); };
  };
  test::expect_parts(refusal("time [s], p [bar]", 9, uniform(1.0)),
                     {"speed.csv:1: p: found [Pa], expected a speed in [rpm] or [rad/s]"});
  test::expect_parts(refusal("time [s], n [rpm]", 9, uniform(0.01)),
                     {"speed.csv:11: the table turns the crank by 114 deg, expected at least 720"});
  test::expect_parts(
      refusal("time [s], n [rpm]", 9,
              [](double share) { return fmt::format("{}, {}", share, share - 0.5); }),
      {"speed.csv:2: n: found -0.0523599 rad/s, expected above 0"});
  test::expect_parts(
      refusal("time [s], n [rpm]", 9,
              [](double share) { return fmt::format("{}, {}", share, 1000 + 1000 * share); }),
      {"after 720 deg the speed is", "expected that of the first row, 104.72, within 1 %"});
  test::expect_parts(refusal("angle [deg], n [rpm]", 9, uniform(300.0)), {"expected 720 deg"});
}

using SpeedTableScenes = testing::SlapScenes;

TEST_F(SpeedTableScenes, AnEngineTurnsByItsTable) {
  const double cycle = 4.0 * kPi / (2000.0 * kPi / 30.0);
  std::ofstream file(folder_ / "speed.csv");
  file << "angle [deg], speed [rpm]\n";
  for (int i = 0; i <= 360; ++i)
    file << fmt::format("{}, {:.12g}\n", 2 * i, 2000.0 + 60.0 * std::cos(8.0 * kPi * i / 360.0));
  file.close();
  std::ofstream(folder_ / "table.run.toml") << R"(
[engine]
speed_table = "speed.csv"
stroke_mm = 130.0
[rod]
length_mm = 210.0
mass_kg = 2.2
inertia_kg_m2 = 0.02
centre_mm = 70.0
[time]
cycles = 1
[piston]
rom = "piston.rom.h5"
model = "rigid"
[gas]
table = "motored.csv"
[contact]
bore_mm = 107.0
clearance_um = 20.0
lubrication = "none"
)";
  const Scene described = read_scene(folder_ / "table.run.toml");
  EXPECT_EQ(std::count(described.inputs.begin(), described.inputs.end(), folder_ / "speed.csv"), 1);
  const H5File done = recorded(described, "table");
  const auto angle = done.read_doubles("output/crank_angle_deg");
  EXPECT_NEAR(angle.back() - angle.front(), 720.0, 1e-9);
  // The mean of 1 / speed: 2000 sqrt(1 - (60/2000)^2) rpm.
  EXPECT_NEAR(described.clock->cycle(), cycle / std::sqrt(1.0 - 9e-4), 1e-6 * cycle);
  EXPECT_NE(refusal("[engine]\nspeed_rpm = 900\nspeed_table = \"speed.csv\"\n")
                .find("speed_rpm and speed_table exclude each other"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::dynamics
