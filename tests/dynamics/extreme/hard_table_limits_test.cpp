// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases S2, S3, S4, S6, S7 and S16: tables and names that mislead.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/given/spline.hpp"
#include "tests/dynamics/extreme/extreme_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::joint;
using testing::slider;
using testing::span;
using HardS2 = testing::ExtremeScenes;
using HardS3 = testing::ExtremeScenes;
using HardS4 = testing::ExtremeScenes;
using HardS6 = testing::ExtremeScenes;
using HardS7 = testing::ExtremeScenes;
using HardS16 = testing::ExtremeScenes;

const char* const kTableLoad =
    "[[load]]\nbody = \"b\"\ncomponent = \"z\"\ntable = \"load.csv\"\ncolumn = \"force\"\n";

/// A load of 0.5 N s on 1 kg, at rest until 50.3 ms.
std::string pulse(double width) {
  return fmt::format("time [s], force [N]\n0, 0\n0.0503, 0\n{:.17g}, {}\n{:.17g}, 0\n0.1, 0\n",
                     0.0503 + 0.5 * width, 1.0 / width, 0.0503 + width);
}

// Between stages of steps of 1 ms: v = 0.5 m/s from then on.
TEST_F(HardS2, APulseBetweenTwoStepsGivesItsImpulse) {
  for (const char* method : {"tr-bdf2", "sdirk2", "predictor-corrector"}) {
    for (const double width : {1e-5, 1e-7}) {
      write("load.csv", pulse(width));
      const H5File file = recorded(span(0.1, 1e-3, fmt::format("method = \"{}\"\n", method)) +
                                   slider("b", 1.0) + kTableLoad);
      const double expected = 0.5 * (0.1 - 0.0503 - 0.5 * width);
      test::expect_at_most(fmt::format("{}, {:g} s: error of the way", method, width),
                           std::abs(last(file, "b_travel") / expected - 1.0), 5e-3);
    }
  }
}

// Steps above the floor of 0.1 ns cannot resolve it: the run ends and names the load.
TEST_F(HardS2, APulseOfANanosecondEndsTheRunWithItsName) {
  write("load.csv", pulse(1e-9));
  const Scene short_pulse = scene(span(0.1) + slider("b", 1.0) + kTableLoad);
  RunControl control;
  control.output = folder_ / "failed.run.h5";
  const std::string said = simulate(short_pulse, {}, control).failure;
  test::observed("ended: " + said);
  test::expect_parts(said, {"time 0.0502", "below the floor", "load 1 on b"});
}

// Rows that are much closer than the steps need, of a load that the steps resolve.
TEST_F(HardS2, DenseRowsOfASmoothLoadCostNoSteps) {
  const auto steps = [&](int rows) {
    std::string text = "time [s], force [N]\n";
    for (int i = 0; i <= rows; ++i)
      text += fmt::format("{:.17g}, {:.17g}\n", 0.1 * i / rows, std::sin(6.28 * i / rows));
    write("load.csv", text);
    recorded(span(0.1) + slider("b", 1.0) + kTableLoad);
    return static_cast<double>(result_.statistics.accepted);
  };
  const double sparse = steps(100);
  test::expect_at_most("steps with 20000 rows over those with 100", steps(20000) / sparse, 1.1);
}

TEST_F(HardS2, TheNextPointOfATableIsAboveAnyAbscissa) {
  const Spline open(Spline::Kind::kLinear, {0.0, 0.5, 1.0}, {0.0, 1.0, 0.0});
  EXPECT_EQ(open.next_point(-1.0), 0.0);
  EXPECT_EQ(open.next_point(0.5), 1.0);
  EXPECT_EQ(open.next_point(1.0), std::numeric_limits<double>::infinity());
  const Spline periodic(Spline::Kind::kLinear, {0.1, 0.4}, {0.0, 1.0}, 0.7);
  double at = -50.0;
  int count = 0;
  for (; at < 50.0; ++count) {
    const double next = periodic.next_point(at);
    ASSERT_GT(next, at);
    at = next;
  }
  test::expect_at_most("points of 100 / 0.7 periods too many or too few",
                       std::abs(count - 2.0 * 100.0 / 0.7), 2.0);
}

// Histories, energies and the state at the end are found by the element's name.
TEST_F(HardS3, TwoElementsOfOneNameAreRefused) {
  const std::string body = span(0.1) + testing::block();
  const auto stop = [](double height, const std::string& name) {
    return testing::floor_at(height, "restitution = 1", name);
  };
  EXPECT_EQ(refusal(body + stop(-1, "s") + stop(-2, "t")), "accepted");
  test::expect_parts(refusal(body + stop(-1, "s") + stop(-2, "s")),
                     {"extreme.run.toml:", "stop[1].name: found \"s\" after a stop \"s\""});
  test::expect_parts(refusal(body + stop(-1, "a b") + stop(-2, "a_b")),
                     {"stop[1].name: found \"a_b\" after a stop \"a b\""});
  // The first one without a name is number 1.
  const std::string bushing = joint("b", "", 1.0);
  EXPECT_EQ(refusal(body + bushing + bushing), "accepted");
  test::expect_parts(refusal(body + bushing + bushing + "name = \"1\"\n"),
                     {"bushing[1].name: found \"1\" after a bushing \"1\""});
}

// A spline through a flank of a millionth of its neighbours swings by a million times its height.
TEST_F(HardS4, ASmoothCurveThatSwingsBesideAFlankIsRefused) {
  const std::string shaft =
      span(0.1) +
      "[[rigid_body]]\nname = \"b\"\nmotion = \"xy\"\nmass_kg = 1\ninertia_kg_m2 = 0.01\n";
  const std::string torque =
      "[[torque]]\nbody = \"b\"\ntable = \"torque.csv\"\ncolumn = \"torque\"\nspline = ";
  const auto rows = [&](const char* flank) {
    write("torque.csv", fmt::format("angle [deg], torque [N m]\n0, 0\n90, 0\n{}, 1\n180, "
                                    "1\n270, 0\n",
                                    flank));
  };
  rows("135");
  for (const char* spline : {"\"cubic\"\n", "\"quintic\"\n"})
    EXPECT_EQ(refusal(shaft + torque + spline), "accepted");
  rows("90.0001");
  for (const char* spline : {"\"cubic\"\n", "\"quintic\"\n"})
    test::expect_parts(refusal(shaft + torque + spline),
                       {"torque.csv:", "torque: the smooth curve leaves the rows by ",
                        "more than the largest step from row to row, 1,"});
  const std::string drive =
      joint("b", "d", 1.0) + "[[drive]]\nname = \"d\"\naxis = \"z\"\ntable = \"angle.csv\"\n";
  write("angle.csv", "time [s], angle [deg]\n0, 0\n0.05, 0\n0.0501, 360\n0.2, 360\n");
  test::expect_parts(refusal(shaft + drive), {"angle.csv:4: angle: the smooth curve leaves the "
                                              "rows by ",
                                              "or a table of the speed"});
  // The same flank of a speed has no swing: its curve is monotone.
  write("angle.csv", "time [s], speed [rpm]\n0, 0\n0.05, 0\n0.0501, 360\n0.2, 360\n");
  EXPECT_EQ(refusal(shaft + drive), "accepted");
}

TEST_F(HardS6, AJointWithinOneBodyOrWithinTheGroundIsRefused) {
  const std::string body = span(0.1) + slider("b", 1.0);
  test::expect_parts(refusal(body + joint("b", "b", 1.0)),
                     {"bushing[0].b: is a point of \"b\" as a is"});
  test::expect_parts(
      refusal(body + "[[spring]]\na = { body = \"b\", at_mm = [0, 0, 0] }\nb = { body = \"b\", "
                     "at_mm = [0, 0, 9] }\nstiffness_n_m = 1\nlength_mm = 9\n"),
      {"spring[0].b: is ", "\"b\""});
  test::expect_parts(
      refusal(body + "[[bushing]]\na = { at_mm = [0, 0, 0] }\nb = {}\nstiffness_n_m = 1\n"),
      {"bushing[0].b: is a point of the ground as a is"});
}

TEST_F(HardS7, ATableWithANumberThatNoMachineHasIsRefused) {
  for (const char* value : {"1e300", "-1e21", "nan", "inf", "1e999", ""}) {
    write("load.csv", fmt::format("time [s], force [N]\n0, 0\n0.05, {}\n0.1, 0\n", value));
    test::expect_parts(refusal(span(0.1) + slider("b", 1.0) + kTableLoad),
                       {"load.csv:3: force: found \"", "expected a "});
  }
}

/// A rotor of 0.01 kg m2 on the angle 0 with a speed [rad/s].
std::string rotor(const char* name, double speed) {
  return fmt::format(
      "[[rigid_body]]\nname = \"{}\"\nmotion = \"xy\"\nmass_kg = 1\ninertia_kg_m2 = 0.01\n"
      "start_spin_rad_s = {}\n",
      name, speed);
}

/// A table over one turn in rows of 0.25 deg: at 203 deg a spike with the work of 2 J.
std::string spike() {
  std::string text = "angle [deg], torque [N m]\n";
  for (int i = 0; i < 1440; ++i)
    text += fmt::format("{}, {}\n", 0.25 * i, i == 812 ? 2.0 / (0.25 * std::numbers::pi / 180) : 0);
  return text;
}

const char* const kSpike =
    "[[torque]]\nbody = \"b\"\ntable = \"torque.csv\"\ncolumn = \"torque\"\n";

// The angle of the table is that of the motion. Steps of 1 ms pass 5.7 deg; the work of the spike
// decides the speed afterwards, in either direction.
TEST_F(HardS16, ASpikeOfATorqueBetweenTwoStepsGivesItsWork) {
  write("torque.csv", spike());
  constexpr double kEnd = 0.06, kTurn = std::numbers::pi / 180.0;
  for (const char* method : {"tr-bdf2", "sdirk2", "predictor-corrector"}) {
    for (const double speed : {100.0, -100.0}) {
      const H5File file = recorded(span(kEnd, 1e-3, fmt::format("method = \"{}\"\n", method)) +
                                   rotor("b", speed) + kSpike);
      const double sign = speed > 0.0 ? 1.0 : -1.0;
      const double before = (speed > 0.0 ? 203.0 : 157.0) * kTurn / 100.0;
      const double after = std::sqrt(1e4 + sign * 2.0 * 2.0 / 0.01);
      const double gained = last(file, "b_angle") - speed * kEnd;
      test::expect_at_most(fmt::format("{}, {:g} rad/s: error of the angle gained", method, speed),
                           std::abs(gained / (sign * (after - 100.0) * (kEnd - before)) - 1.0),
                           2e-2);
    }
  }
}

// Between two rotors the reaction has the same impulse: their mean angle does not know of it.
TEST_F(HardS16, TheReactionOfASpikeHasItsImpulseAsWell) {
  write("torque.csv", spike());
  const H5File file =
      recorded(span(0.06) + rotor("b", 100.0) + rotor("c", 0.0) + kSpike + "reaction = \"c\"\n");
  const double b = last(file, "b_angle"), c = last(file, "c_angle");
  test::expect_at_least("angle that the spike turns the other rotor [rad]", -c, 1e-3);
  test::expect_at_most("change of the mean angle [rad]", std::abs(0.5 * (b + c) - 3.0), 1e-9);
}

// The same rows many times per step, of a torque that the steps resolve.
TEST_F(HardS16, DenseRowsOfASmoothTorqueCostNoSteps) {
  const auto steps = [&](int rows) {
    std::string text = "angle [deg], torque [N m]\n";
    for (int i = 0; i < rows; ++i)
      text += fmt::format("{:.17g}, {:.17g}\n", 360.0 * i / rows,
                          std::sin(2.0 * std::numbers::pi * i / rows));
    write("torque.csv", text);
    recorded(span(0.1) + rotor("b", 100.0) + kSpike);
    return static_cast<double>(result_.statistics.accepted);
  };
  const double sparse = steps(72);
  test::expect_at_most("steps with 7200 rows over those with 72", steps(7200) / sparse, 1.1);
}

}  // namespace
}  // namespace clatter::dynamics
