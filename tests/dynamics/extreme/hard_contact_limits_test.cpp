// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases S5, S11, S12 and S14: stops at their limits.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/dynamics/extreme/extreme_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::block;
using testing::floor_at;
using testing::span;
using HardS5 = testing::ExtremeScenes;
using HardS11 = testing::ExtremeScenes;
using HardS12 = testing::ExtremeScenes;
using HardS14 = testing::ExtremeScenes;

// A ceiling 1 nm above a body on its floor: at 1 m/s impacts follow each other within 2 ns.
TEST_F(HardS5, AGapOfANanometreBetweenRigidStopsIsReported) {
  const std::string ceiling =
      "[[stop]]\nname = \"t\"\na = { body = \"b\", at_mm = [0, 0, 0] }\nb = { at_mm = [0, 0, 1e-6] "
      "}\nnormal = [0, 0, -1]\nrestitution = 1\n";
  const auto run = [&](const std::string& law) {
    recorded(span(1e-4) + block("[0, 0, -1]") + floor_at(-1e-6, "restitution = 1\n" + law) +
             ceiling + law);
    double depth = 0.0;
    for (const std::string& line : result_.warnings) {
      const size_t at = line.find("let it sink ");
      if (at != std::string::npos) depth = std::stod(line.substr(at + 12));
    }
    return depth;
  };
  // Critically damped: v / (e w) = 36.8 um of 1 kg at 1 m/s on 1e8 N/m.
  const double depth = run("");
  test::expect_at_most("error of the reported depth [um]",
                       std::abs(depth - 1e6 / (std::numbers::e * 1e4)), 0.5);
  test::expect_at_most("depth reported with 1e14 N/m [um]", run("rest_stiffness_n_m = 1e14\n"),
                       0.0);
}

TEST_F(HardS5, ABallThatComesToRestIsNotReported) {
  recorded("gravity_m_s2 = 9.81\n" + span(0.1, 1e-6) + block() +
           floor_at(-1.0, "restitution = 0.5"));
  test::expect_at_most("warnings", static_cast<double>(result_.warnings.size()), 0.0);
}

TEST_F(HardS11, ImpactsAtTheStartAndAtTheEndOfARun) {
  const std::string law = "restitution = 1";
  // On the floor at the start, downward: it leaves at once.
  H5File file =
      recorded("gravity_m_s2 = 9.81\n" + span(0.1) + block("[0, 0, -1]") + floor_at(0.0, law));
  test::expect_at_most("error after an impact at the start [m]",
                       std::abs(last(file, "b_z") - (0.1 - 0.5 * 9.81 * 0.01)), 1e-6);
  // It arrives exactly when the run ends, or 0.1 ns before.
  for (const double early : {0.0, 1e-10}) {
    file = recorded(span(0.1) + block("[0, 0, -1]") + floor_at(-100.0 + 1e3 * early, law));
    test::expect_at_most("error of an impact at the end [m]",
                         std::abs(last(file, "b_z") - (-0.1 + 2.0 * early)), 1e-12);
    const double impulse = last(file, "stop_s_impulse");
    EXPECT_NEAR(impulse, early > 0.0 ? 2.0 : 0.0, 1e-12);
  }
}

TEST_F(HardS11, RestitutionsAtTheirLimitsTendToThem) {
  const auto rest = [&](const char* restitution) {
    const H5File file = recorded("gravity_m_s2 = 9.81\n" + span(0.3) + block() +
                                 floor_at(-1.0, fmt::format("restitution = {}", restitution)));
    return last(file, "b_z");
  };
  test::expect_at_most("difference of 0 and 1e-12 [m]", std::abs(rest("0") - rest("1e-12")), 1e-12);
  // Nine bounces from 1 mm: at 0.3 s by the times of theory.
  const double fall = std::sqrt(2e-3 / 9.81), phase = std::fmod(0.3 - fall, 2.0 * fall) - fall;
  test::expect_at_most("error after all bounces without loss [m]",
                       std::abs(rest("1") + 0.5 * 9.81 * phase * phase), 1e-6);
}

// A slope of 45 deg: normal and tangential weight are equal. The body starts where the normal force
// carries it, 6.94 um deep.
TEST_F(HardS12, FrictionAboveOneHoldsOrCreepsAsItsLawSays) {
  const auto way = [&](double friction, const char* law) {
    const H5File file =
        recorded("gravity_m_s2 = 9.81\n" + span(0.1, 1e-4) + block() +
                 fmt::format("[[stop]]\nname = \"s\"\na = {{ body = \"b\", at_mm = [0, 0, 0] }}\n"
                             "b = {{ at_mm = [0, 4.905e-3, 4.905e-3] }}\nnormal = [0, 1, "
                             "1]\nstiffness_n_m = 1e6\nchi_s_m = 1\n"
                             "friction = {}\n{}",
                             friction, law));
    const auto y = file.read_doubles("history/b_y"), z = file.read_doubles("history/b_z");
    const auto along = [&](size_t i) { return (y[i] - z[i]) / std::numbers::sqrt2; };
    EXPECT_TRUE(std::isfinite(along(y.size() - 1)));
    return along(y.size() - 1);
  };
  // It sticks: the contact yields by m g sin / (0.8 k), with damping, and swings once that far.
  test::expect_at_most("way of a body with friction 10 that sticks [m]", way(10.0, ""),
                       2.0 * 9.81 / std::numbers::sqrt2 / 0.8e6);
  // mu (3 x - x^3) / 2 = 1 of x = slip / 1 mm/s.
  double x = 0.1;
  for (int i = 0; i < 50; ++i) x = (0.2 + x * x * x) / 3.0;
  test::expect_at_most("error of the creep with friction 10",
                       std::abs(way(10.0, "slip_speed_m_s = 1e-3\n") / (x * 1e-3 * 0.1) - 1.0),
                       0.02);
  // Without enough friction it slides with g (sin - mu cos).
  const double slide = 0.5 * 9.81 / std::numbers::sqrt2 * 0.5 * 0.01;
  test::expect_at_most("error of the slide with friction 0.5",
                       std::abs(way(0.5, "stick_stiffness_n_m = 1e8\n") / slide - 1.0), 0.01);
}

// A body that starts 1 m deep in a contact of 1e6 N/m leaves it with sqrt(k / m) times the depth.
TEST_F(HardS14, ARunThatBeginsDeepInAContactThrowsTheBodyOut) {
  const H5File file =
      recorded(span(0.01, 1e-5) + block() + floor_at(1000.0, "stiffness_n_m = 1e6"));
  // sqrt(k / m) = 1000 / s: a quarter of a period, then 1000 m/s.
  const double out = 0.5 * std::numbers::pi * 1e-3;
  test::expect_at_most("error of the way",
                       std::abs(last(file, "b_z") / (1.0 + 1e3 * (0.01 - out)) - 1.0), 1e-6);
  test::expect_at_most("energy residue", result_.energy_residue, 1e-6);
}

}  // namespace
}  // namespace clatter::dynamics
