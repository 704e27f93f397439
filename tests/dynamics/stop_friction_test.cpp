// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes in which stops and discs rub: stick and slip, rest, rolling.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dynamics/scene_text.hpp"

namespace clatter::dynamics {
namespace {

class StopFriction : public testing::SceneText {
 protected:
  StopFriction() : SceneText("stop") {}
};

/// 1 kg on a spring of 1e4 N/m, pressed with 100 N on a belt of 10 mm/s; friction 20 and 15 N.
std::string stick_slip(const std::string& law) {
  return fmt::format(R"(
[time]
end_s = 0.65
output_step_us = 100
[accuracy]
tolerance = 1e-4
[[rigid_body]]
name = "mass"
motion = "zx"
mass_kg = 1.0
inertia_kg_m2 = 1.0
centre_mm = [0, 0, -0.01]
[[rigid_body]]
name = "belt"
motion = "zx"
mass_kg = 1e9
inertia_kg_m2 = 1e9
start_velocity_m_s = [0.01, 0, 0]
[[load]]
body = "mass"
component = "z"
value = -100.0
[[spring]]
a = {{ body = "mass", at_mm = [0, 0, -0.01] }}
b = {{ at_mm = [-1000, 0, -0.01] }}
stiffness_n_m = 1e4
length_mm = 1000
[[stop]]
name = "belt"
a = {{ body = "mass", at_mm = [0, 0, -0.01] }}
b = {{ body = "belt", at_mm = [0, 0, 0] }}
normal = [0, 0, 1]
stiffness_n_m = 1e7
chi_s_m = 1.0
friction = 0.15
static_friction = 0.2
{})",
                     law);
}

TEST_F(StopFriction, OracleStickAndSlipAlternateWithTheTimesOfCoulombFriction) {
  double previous = 1.0;
  for (const double slip_speed : {1e-4, 1e-5}) {
    const H5File file = recorded(stick_slip(fmt::format("slip_speed_m_s = {}\n", slip_speed)));
    const auto time = file.read_doubles("history/time"),
               slip = file.read_doubles("history/stop_belt_slip");
    std::vector<double> begins, ends;
    for (size_t i = 1; i < time.size(); ++i) {
      if (slip[i] > slip_speed && slip[i - 1] <= slip_speed) begins.push_back(time[i]);
      if (slip[i] <= slip_speed && slip[i - 1] > slip_speed) ends.push_back(time[i]);
    }
    ASSERT_GE(begins.size(), 4U);
    // The first slip starts from rest; take the last but one.
    const size_t k = begins.size() - 2;
    const auto end = *std::upper_bound(ends.begin(), ends.end(), begins[k]);
    const double slips = end - begins[k], sticks = begins[k + 1] - end;
    const double error = std::max(std::abs(slips / 0.0353638 - 1.0), std::abs(sticks / 0.1 - 1.0));
    std::printf("slip speed %g m/s: slip %.7f s, stick %.7f s\n", slip_speed, slips, sticks);
    // Creep takes a time of the order of its part of the belt's speed.
    EXPECT_LT(error, 5.0 * slip_speed / 0.01);
    EXPECT_LT(error, 0.5 * previous);
    previous = error;
    EXPECT_LT(result_.energy_residue, 1e-3);
  }
}

TEST_F(StopFriction, OracleABodyThatSticksAndSlipsHasThePeriodOfCoulombFriction) {
  const H5File file = recorded(stick_slip("stick_stiffness_n_m = 1e9\n"));
  const auto time = file.read_doubles("history/time"),
             slip = file.read_doubles("history/stop_belt_slip");
  // At half of the largest speed: where it sticks the mass swings on the contact.
  const double half = 0.5 * *std::max_element(slip.begin(), slip.end());
  std::vector<double> begins;
  for (size_t i = 1; i < time.size(); ++i)
    if (slip[i] > half && slip[i - 1] <= half)
      begins.push_back(time[i - 1] +
                       (time[i] - time[i - 1]) * (half - slip[i - 1]) / (slip[i] - slip[i - 1]));
  ASSERT_GE(begins.size(), 4U);
  const double period = begins.back() - begins[begins.size() - 2];
  std::printf("period %.7f s, largest slip %.7f m/s\n", period, 2.0 * half);
  EXPECT_NEAR(period, 0.1353638, 3e-5);
  // v + sqrt(v^2 + (dF)^2 / (k m)) of the belt's speed v and the drop of friction, 5 N.
  EXPECT_NEAR(2.0 * half, 0.01 + std::hypot(0.01, 5.0 / 100.0), 1e-5);
  EXPECT_LT(result_.energy_residue, 1e-3);
}

/// 1 kg pressed with 10 N on the ground, friction 1 N, held by a spring that pulls with 0.5 N.
std::string shoe(const std::string& law,
                 const std::string& spring = "stiffness_n_m = 1e4\nlength_mm = 999.95\n") {
  return R"(
[time]
end_s = 1.0
output_step_us = 1000
[[rigid_body]]
name = "shoe"
motion = "zx"
mass_kg = 1.0
inertia_kg_m2 = 1.0
[[load]]
body = "shoe"
component = "z"
value = -10.0
[[spring]]
a = { body = "shoe", at_mm = [0, 0, 0] }
b = { at_mm = [-1000, 0, 0] }
)" + spring +
         R"([[stop]]
name = "ground"
a = { body = "shoe", at_mm = [0, 0, 0] }
b = { at_mm = [0, 0, 0] }
normal = [0, 0, 1]
stiffness_n_m = 1e7
chi_s_m = 100.0
friction = 0.1
)" + law;
}

TEST_F(StopFriction, AShoeThatSticksRestsWhereItIsAndOneThatCreepsSaysSo) {
  const auto last = [&](const std::string& law) {
    return recorded(shoe(law)).read_doubles("history/shoe_x").back();
  };
  const double sticks = last("");
  EXPECT_FALSE(result_.creep.has_value());
  const double creeps = last("slip_speed_m_s = 1e-3\n");
  std::printf("after a second: sticks at %.3e m, crept to %.3e m\n", sticks, creeps);
  // The spring of the contact, 8e6 N/m, yields by 0.06 um; the load was not there before.
  EXPECT_NEAR(sticks, -0.5 / 8e6, 1e-8);
  EXPECT_LT(creeps, -4e-5);
  // All but the way before the shoe was slow: 0.05 mm, the spring is slack then.
  EXPECT_NEAR(result_.creep.value(), std::abs(creeps), 0.05 * std::abs(creeps));
  for (const std::string& warning : result_.warnings)
    EXPECT_EQ(warning.find("crept"), std::string::npos) << warning;
  // One that pulls with as much over a longer way.
  const H5File far =
      recorded(shoe("slip_speed_m_s = 1e-3\n", "stiffness_n_m = 1e3\nlength_mm = 999.5\n"));
  const double went = std::abs(far.read_doubles("history/shoe_x").back());
  EXPECT_NEAR(result_.creep.value(), went, 0.05 * went);
  EXPECT_GT(result_.creep.value(), kLongestCreep);
  ASSERT_FALSE(result_.warnings.empty());
  EXPECT_NE(result_.warnings.back().find("stop ground: it crept by"), std::string::npos)
      << result_.warnings.back();
}

std::string hoop(const std::string& more) {
  return R"(
gravity_m_s2 = 9.81
[time]
end_s = 0.5
output_step_us = 1000
[accuracy]
tolerance = 1e-5
[[rigid_body]]
name = "hoop"
motion = "space"
mass_kg = 1.5
inertia_kg_m2 = [0.03, 0.06, 0.03]
centre_mm = [0, 0, 200]
)" + more;
}

TEST_F(StopFriction, OracleAHoopThatSlidesRollsAfterTheTimeOfCoulombFriction) {
  // J = m r^2: it slides at first, -mu g; it rolls from half of its speed on, v / (2 mu g) later.
  const H5File file = recorded(hoop(R"(start_velocity_m_s = [1, 0, 0]
[[rolling_disc]]
body = "hoop"
axis = [0, 1, 0]
radius_mm = 200
stiffness_n_m = 1e6
chi_s_m = 1
friction = 0.2
)"));
  const double time = 1.0 / (2.0 * 0.2 * 9.81);
  const double way = time - 0.5 * 0.2 * 9.81 * time * time + 0.5 * (0.5 - time);
  EXPECT_NEAR(file.read_doubles("history/hoop_x").back(), way, 2e-4 * way);
  EXPECT_LT(result_.energy_residue, 1e-4);
}

TEST_F(StopFriction, RollingDiscsAreRefusedByKeyAndPlace) {
  const std::string disc = "[[rolling_disc]]\nradius_mm = 200\nstiffness_n_m = 1e6\n";
  EXPECT_NE(
      refusal(hoop(disc + "body = \"hop\"\naxis = [0, 1, 0]\n"))
          .find("stop.run.toml:14: body: found \"hop\", expected a [[rigid_body]] with motion"),
      std::string::npos);
  EXPECT_NE(refusal(hoop(disc + "body = \"hoop\"\naxis = [0, 0, 1]\n"))
                .find("stop.run.toml:14: axis: found that of the normal"),
            std::string::npos);
}

}  // namespace
}  // namespace clatter::dynamics
