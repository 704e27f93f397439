// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes whose rigid contacts close together: boxes, a stack, a table, a row of balls.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/units.hpp"
#include "tests/dynamics/scene_text.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics {
namespace {

class HardTD4_ImpactsTogether : public testing::SceneText {
 protected:
  HardTD4_ImpactsTogether() : SceneText("impacts") {}
  H5File recorded(const std::string& bodies, double end, double gravity = 9.81) {
    return SceneText::recorded(
        fmt::format("gravity_m_s2 = {}\n[time]\nend_s = {}\noutput_step_us = 500\n[accuracy]\n"
                    "tolerance = 1e-6\n{}",
                    gravity, end, bodies));
  }
};

std::string box(const std::string& name, double height_mm) {
  return fmt::format(
      "[[rigid_body]]\nname = \"{}\"\nmotion = \"zx\"\nmass_kg = 1.0\ninertia_kg_m2 = 0.02\n"
      "centre_mm = [0, 0, {}]\n",
      name, height_mm);
}

/// A contact of a point of `a` with a horizontal plane of `b`, or of the ground.
std::string stop(const std::string& name, const std::string& a, double x, double z,
                 const std::string& b, double plane, double restitution,
                 const std::string& more = "") {
  return fmt::format(
      "[[stop]]\nname = \"{}\"\na = {{ body = \"{}\", at_mm = [{}, 0, {}] }}\n"
      "b = {{ {}at_mm = [{}, 0, {}] }}\nnormal = [0, 0, 1]\nrestitution = {}\n{}",
      name, a, x, z, b.empty() ? "" : fmt::format("body = \"{}\", ", b), x, plane, restitution,
      more);
}

/// A box whose feet are 50 mm above the ground.
std::string flat_box(double e, bool swapped, const std::string& more = "") {
  const std::string left = stop("left", "box", -100, 50, "", 0, e, more),
                    right = stop("right", "box", 100, 50, "", 0, e, more);
  return box("box", 100) + (swapped ? right + left : left + right);
}

double largest(const std::vector<double>& values) {
  double found = 0.0;
  for (const double value : values) found = std::max(found, std::abs(value));
  return found;
}

TEST_F(HardTD4_ImpactsTogether, ABoxThatFallsFlatStaysFlatWhateverTheOrderOfItsTables) {
  for (const double e : {0.0, 0.5, 0.9}) {
    std::vector<double> first;
    for (const bool swapped : {false, true}) {
      const H5File file = recorded(flat_box(e, swapped), 0.6);
      const auto angle = file.read_doubles("history/box_angle"),
                 z = file.read_doubles("history/box_z");
      test::expect_at_most("angle of a box that fell flat [rad]", largest(angle), 1e-12);
      EXPECT_NEAR(file.read_doubles("history/stop_left_impulse").back(),
                  file.read_doubles("history/stop_right_impulse").back(), 1e-12);
      if (swapped)
        EXPECT_EQ(first, z);
      else
        first = z;
      EXPECT_LT(result_.energy_residue, 1e-6);
    }
  }
}

TEST_F(HardTD4_ImpactsTogether, AStackOfThreeBoxesComesToRestUpright) {
  std::string scene;
  for (int k = 0; k < 3; ++k) {
    const std::string name = fmt::format("box{}", k), below = fmt::format("box{}", k - 1);
    const double foot = 1.0 + 101.0 * k, plane = k == 0 ? 0.0 : 101.0 * k;
    scene += box(name, foot + 50.0);
    for (const double x : {-100.0, 100.0})
      scene += stop(fmt::format("{}{}", name, x < 0.0 ? "left" : "right"), name, x, foot,
                    k == 0 ? "" : below, plane, 0.3);
  }
  const H5File file = recorded(scene, 0.5);
  for (int k = 0; k < 3; ++k) {
    const auto z = file.read_doubles(fmt::format("history/box{}_z", k));
    EXPECT_LT(largest(file.read_doubles(fmt::format("history/box{}_angle", k))), 1e-9) << k;
    EXPECT_NEAR(z.back(), 0.05 + 0.1 * k, 2e-6) << k;
    EXPECT_NEAR(z.back() - z[z.size() - 2], 0.0, 1e-9) << k;
  }
  EXPECT_LT(result_.energy_residue, 1e-6);
}

TEST_F(HardTD4_ImpactsTogether, ATableOnFourLegsBouncesAsOneBall) {
  std::string scene =
      "[[rigid_body]]\nname = \"table\"\nmotion = \"space\"\nmass_kg = 4.0\n"
      "inertia_kg_m2 = [0.1, 0.1, 0.2]\ncentre_mm = [0, 0, 501]\n";
  int leg = 0;
  for (const double x : {-300.0, 300.0})
    for (const double y : {-200.0, 200.0})
      scene += fmt::format(
          "[[stop]]\nname = \"leg{}\"\na = {{ body = \"table\", at_mm = [{}, {}, 1] }}\n"
          "b = {{ at_mm = [0, 0, 0] }}\nnormal = [0, 0, 1]\nrestitution = 0.5\nfriction = 0.3\n",
          ++leg, x, y);
  const H5File file = recorded(scene, 0.1);
  // At rest after three times the time of the fall, as a ball.
  const double impulse = 4.0 * 9.81 * 3.0 * std::sqrt(2e-3 / 9.81);
  for (int k = 1; k <= leg; ++k) {
    EXPECT_NEAR(file.read_doubles(fmt::format("history/stop_leg{}_impulse", k)).back(),
                0.25 * impulse, 1e-5)
        << k;
    EXPECT_NEAR(file.read_doubles(fmt::format("history/stop_leg{}_force", k)).back(), 9.81, 1e-5);
  }
  EXPECT_LT(result_.energy_residue, 1e-6);
}

TEST_F(HardTD4_ImpactsTogether, ARowOfBallsSendsTheLastOneAway) {
  std::string scene;
  for (int k = 0; k < 4; ++k)
    scene += fmt::format(
        "[[rigid_body]]\nname = \"ball{}\"\nmotion = \"zx\"\nmass_kg = 0.2\n"
        "inertia_kg_m2 = 1e-5\ncentre_mm = [0, 0, {}]\n{}",
        k, 20.0 * k + (k > 0 ? 1.0 : 0.0), k == 0 ? "start_velocity_m_s = [0, 0, 0.5]\n" : "");
  for (int k = 1; k < 4; ++k)
    scene += stop(fmt::format("pair{}", k), fmt::format("ball{}", k), 0.0, 20.0 * k - 9.0,
                  fmt::format("ball{}", k - 1), 20.0 * k - (k == 1 ? 10.0 : 9.0), 1.0);
  const H5File file = recorded(scene, 0.01, 0.0);
  for (int k = 0; k < 4; ++k) {
    // 1 mm to the impact, at 2 ms.
    const double start = 0.02 * k + (k > 0 ? 1e-3 : 0.0), end = k == 0 ? 1e-3 : k == 3 ? 4e-3 : 0.0;
    EXPECT_NEAR(file.read_doubles(fmt::format("history/ball{}_z", k)).back() - start, end, 1e-9);
  }
}

TEST_F(HardTD4_ImpactsTogether, ARodBetweenWallAndFloorLeavesTheWallAtTwoThirdsOfItsHeight) {
  // A ladder of 1 m without friction, of m l^2 / 12, from 70 deg on.
  const double angle = 70.0 * kDegree, x = 1e3 * std::cos(angle), z = 1e3 * std::sin(angle);
  const std::string scene =
      fmt::format(
          "[[rigid_body]]\nname = \"rod\"\nmotion = \"zx\"\nmass_kg = 1.0\n"
          "inertia_kg_m2 = {}\ncentre_mm = [{}, 0, {}]\n",
          1.0 / 12.0, 0.5 * x, 0.5 * z) +
      stop("floor", "rod", x, 0.0, "", 0.0, 0.5) +
      fmt::format(
          "[[stop]]\nname = \"wall\"\na = {{ body = \"rod\", at_mm = [0, 0, {}] }}\n"
          "b = {{ at_mm = [0, 0, 0] }}\nnormal = [1, 0, 0]\nrestitution = 0.5\n",
          z);
  const H5File file = recorded(scene, 0.5);
  const auto force = file.read_doubles("history/stop_wall_force"),
             height = file.read_doubles("history/rod_z");
  const auto last = std::find_if(force.rbegin(), force.rend(), [](double f) { return f > 0.0; });
  const auto leaves = static_cast<size_t>(force.rend() - last);
  ASSERT_LT(leaves, height.size());
  EXPECT_NEAR(height[leaves] / height[0], 2.0 / 3.0, 2e-3);
  EXPECT_LT(result_.energy_residue, 1e-6);
}

TEST_F(HardTD4_ImpactsTogether, ABoxOnRigidFeetSlidesToAStopByFriction) {
  // It falls while it slides: each impact brakes by mu times its impulse, then friction at rest.
  const double mu = 0.2, v = 0.3, e = 0.3;
  std::string scene = flat_box(e, false, fmt::format("friction = {}\nslip_speed_m_s = 1e-6\n", mu));
  scene.replace(scene.find("centre_mm"), 9,
                fmt::format("start_velocity_m_s = [{}, 0, 0]\ncentre_mm", v));
  const H5File file = recorded(scene, 0.4);
  const auto x = file.read_doubles("history/box_x"), t = file.read_doubles("history/time");
  const size_t last = x.size() - 1;
  EXPECT_NEAR((x[last] - x[last - 1]) / (t[last] - t[last - 1]), 0.0, 2e-6);
  // The first impact takes mu (1 + e) of its speed, the second one would take more than is left.
  const double strikes = std::sqrt(2.0 * 9.81 * 0.05), left = v - mu * (1.0 + e) * strikes;
  EXPECT_NEAR(x[last], (v * strikes + left * 2.0 * e * strikes) / 9.81, 1e-6);
  EXPECT_LT(result_.energy_residue, 1e-6);
}

}  // namespace
}  // namespace clatter::dynamics
