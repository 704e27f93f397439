// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/given/load_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "tests/dynamics/motored_cycle.hpp"

namespace clatter::dynamics {
namespace {

std::filesystem::path write(const std::string& name, const std::string& text) {
  const std::filesystem::path path = ::testing::TempDir() + "clatter_" + name + ".csv";
  std::ofstream(path) << text;
  return path;
}

/// Rows every 10 deg from -360 to 360, each modified by `change`.
std::string table(const std::function<std::string(int, std::string)>& change) {
  std::string text = "# test\ncrank_angle [deg], pressure [bar]\n";
  for (int i = 0; i <= 72; ++i) {
    const double angle = -360.0 + 10.0 * i;
    text += change(i, std::to_string(angle) + ", " +
                          std::to_string(2.0 + std::cos(0.5 * angle * kDegree)) + "\n");
  }
  return text;
}

std::string refusal(const std::string& name, const std::string& text) {
  try {
    read_cycle_table(write(name, text), "pressure", "Pa", Spline::Kind::kMonotoneCubic);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CycleTable, IsReadInSiAndPeriodic) {
  const auto same = [](int, std::string row) { return row; };
  const Spline p =
      read_cycle_table(write("good", table(same)), "pressure", "Pa", Spline::Kind::kMonotoneCubic);
  EXPECT_NEAR(p(0.0), 3e5, 1e-3);
  EXPECT_NEAR(p(10.0 * kDegree + 4.0 * std::numbers::pi), p(10.0 * kDegree), 1e-6);
  EXPECT_NEAR(p(-360.0 * kDegree), 1e5, 1e-3);
}

TEST(CycleTable, BadRowsAreRefusedWithFileAndLine) {
  const auto replaced = [](int at, const std::string& by) {
    return table([=](int i, std::string row) { return i == at ? by : row; });
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const std::string nan = refusal("nan", replaced(30, "-60, nan\n"));
  EXPECT_TRUE(has(nan, "clatter_nan.csv:33: pressure: found \"nan\", expected a finite number"))
      << nan;
  const std::string cell = refusal("cell", replaced(30, "-60\n"));
  EXPECT_TRUE(has(cell, ":33: found 1 cells, expected 2")) << cell;
  const std::string order = refusal("order", replaced(30, "-90, 2\n"));
  EXPECT_TRUE(has(order, ":33: crank_angle: found -90")) << order;
  const std::string gap =
      refusal("gap", table([](int i, std::string row) { return i > 20 && i < 50 ? "" : row; }));
  EXPECT_TRUE(has(gap, ": a gap of 300 deg from -160 to 140 deg")) << gap;
  const std::string shorter =
      refusal("short", table([](int i, std::string row) { return i < 60 ? row : ""; }));
  EXPECT_TRUE(has(shorter, "before the cycle closes")) << shorter;
  const std::string open = refusal("open", replaced(72, "360, 2.5\n"));
  EXPECT_TRUE(has(open, "the last row closes the cycle with")) << open;
  EXPECT_TRUE(has(refusal("unit", "angle [grad], pressure [bar]\n1, 2\n"), "unit [grad]"));
  EXPECT_TRUE(
      has(refusal("newton", "angle [deg], pressure [N]\n1, 2\n"), "expected a unit of [Pa]"));
  EXPECT_TRUE(has(refusal("time", "time [s], pressure [bar]\n1, 2\n"),
                  "found time in [s] as the first column, expected crank_angle [deg]"));
  EXPECT_TRUE(has(refusal("column", "angle [deg], force [N]\n1, 2\n"), "no column \"pressure\""));
  EXPECT_TRUE(has(refusal("empty", ""), "found no rows"));
}

TEST(CycleTable, AColumnWithoutUnitIsToldHowToNameIt) {
  const std::string message = refusal("no_unit", "time, pressure [bar]\n0, 1\n1, 2\n");
  EXPECT_NE(message.find(
                ":1: found \"time\", expected a name with its unit in brackets, as \"time [s]\""),
            std::string::npos)
      << message;
}

TEST(Spline, MonotoneCubicKeepsExtremaAndReproducesALine) {
  const Spline step(Spline::Kind::kMonotoneCubic, {0, 1, 2, 3, 4}, {0, 0, 1, 1, 1});
  for (double x = 0.0; x < 4.0; x += 0.01) {
    EXPECT_GE(step(x), 0.0);
    EXPECT_LE(step(x), 1.0);
  }
  const Spline line(Spline::Kind::kMonotoneCubic, {0, 1, 3, 4}, {1, 3, 7, 9});
  for (double x = 0.0; x < 4.0; x += 0.1) EXPECT_NEAR(line(x), 1.0 + 2.0 * x, 1e-12);
}

TEST(MotoredTable, WrittenAndReadBackHasThePressureOfTheFormula) {
  const std::filesystem::path path = ::testing::TempDir() + "clatter_motored.csv";
  testing::MotoredCycle cycle;
  testing::write_motored_cycle(path, cycle, kDegree);
  const Spline p = read_cycle_table(path, "", "Pa", Spline::Kind::kMonotoneCubic);
  for (double angle = -350.0; angle < 350.0; angle += 3.3) {
    const double exact = testing::motored_pressure(cycle, angle * kDegree);
    EXPECT_NEAR(p(angle * kDegree), exact, 2e-4 * 44.5e5) << angle;  // 1 deg rows
  }
}

}  // namespace
}  // namespace clatter::dynamics
