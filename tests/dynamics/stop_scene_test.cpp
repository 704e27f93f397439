// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes with [[stop]]: bouncing, compliant impacts, refusals.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/dynamics/scene_text.hpp"

namespace clatter::dynamics {
namespace {

class Stops : public testing::SceneText {
 protected:
  Stops() : SceneText("stop") {}
};

std::string ball(const std::string& motion, double restitution) {
  return fmt::format(R"(
gravity_m_s2 = 9.81
[time]
end_s = 0.1
output_step_us = 500
[accuracy]
tolerance = 1e-6
[[rigid_body]]
name = "ball"
motion = "{}"
mass_kg = 2.0
inertia_kg_m2 = {}
centre_mm = [0, 0, 1]
[[stop]]
name = "table"
a = {{ body = "ball", at_mm = [0, 0, 1] }}
b = {{ at_mm = [0, 0, 0] }}
normal = [0, 0, 1]
restitution = {}
)",
                     motion, motion == "space" ? "[0.1, 0.1, 0.1]" : "0.1", restitution);
}

/// Times at which a recorded sum changes.
std::vector<double> changes(const std::vector<double>& time, const std::vector<double>& sum) {
  std::vector<double> found;
  for (size_t i = 1; i < sum.size(); ++i)
    if (sum[i] > sum[i - 1]) found.push_back(time[i]);
  return found;
}

TEST_F(Stops, OracleABallFallsBouncesAndComesToRest) {
  for (const char* motion : {"zx", "space"}) {
    const H5File file = recorded(ball(motion, 0.5));
    const auto time = file.read_doubles("history/time"),
               impulse = file.read_doubles("history/stop_table_impulse"),
               force = file.read_doubles("history/stop_table_force"),
               gap = file.read_doubles("history/stop_table_gap");
    const std::vector<double> impacts = changes(time, impulse);
    ASSERT_GT(impacts.size(), 8U);
    // sqrt(2 h / g), and three times that. The run starts by an implicit Euler stage of 1e-7 s.
    EXPECT_NEAR(impacts.front(), 14.27843e-3, 2e-7);
    EXPECT_NEAR(impacts.back(), 42.83529e-3, 1e-6);
    std::printf("%s: first impact %.5f ms, rest %.5f ms, %zu impacts\n", motion,
                1e3 * impacts.front(), 1e3 * impacts.back(), impacts.size());
    // All impulses together: what the weight gave until then.
    EXPECT_NEAR(impulse.back(), 2.0 * 9.81 * 42.83529e-3, 1e-5);
    EXPECT_NEAR(force.back(), 2.0 * 9.81, 1e-6);
    EXPECT_NEAR(gap.back(), -2.0 * 9.81 / 1e8, 1e-11);
    EXPECT_GT(*std::min_element(gap.begin(), gap.end()), -1.1 * 2.0 * 9.81 / 1e8);
    EXPECT_LT(result_.energy_residue, 1e-6);
  }
}

TEST_F(Stops, ADamperLosesAfterAnImpactWhatTheNewSpeedSays) {
  // A ball on a weak damped spring that strikes the table three times: impacts change its speed,
  // and with it what the damper loses, at once.
  const H5File file = recorded(R"(
gravity_m_s2 = 9.81
[time]
end_s = 0.1
[accuracy]
tolerance = 1e-6
[[rigid_body]]
name = "ball"
motion = "zx"
mass_kg = 2.0
inertia_kg_m2 = 0.1
centre_mm = [0, 0, 50]
[[bushing]]
name = "damper"
a = { body = "ball", at_mm = [0, 0, 50] }
b = { at_mm = [0, 0, 50] }
stiffness_n_m = 100
damping_n_s_m = 20
[[stop]]
name = "table"
a = { body = "ball", at_mm = [0, 0, 50] }
b = { at_mm = [0, 0, 45] }
normal = [0, 0, 1]
restitution = 0.5
)");
  const auto time = file.read_doubles("history/time"),
             impulse = file.read_doubles("history/stop_table_impulse");
  EXPECT_GE(changes(time, impulse).size(), 3U);
  std::printf("energy residue %.2e\n", result_.energy_residue);
  EXPECT_LT(result_.energy_residue, 5e-6);
}

TEST_F(Stops, WithoutRestitutionABallStaysWhereItFell) {
  const H5File file = recorded(ball("space", 0.0));
  const auto z = file.read_doubles("history/ball_z"), time = file.read_doubles("history/time");
  for (size_t i = 0; i < z.size(); ++i) {
    if (time[i] > 15e-3) {
      EXPECT_NEAR(z[i], 0.0, 1e-6) << time[i];
    }
  }
  EXPECT_NEAR(file.read_doubles("history/stop_table_force").back(), 2.0 * 9.81, 1e-6);
}

TEST_F(Stops, ABallThatIsPulledOffItsRestFliesAgain) {
  // At rest on the table; after 50 ms a load lifts it for 10 ms, and it falls back.
  std::ofstream(folder_ / "pull.csv")
      << "time [s], force [N]\n0, 0\n0.05, 0\n0.0501, 40\n0.06, 40\n0.0601, 0\n1, 0\n";
  const H5File file = recorded(
      ball("zx", 0.5) + "[[load]]\nbody = \"ball\"\ncomponent = \"z\"\ntable = \"pull.csv\"\n");
  const auto time = file.read_doubles("history/time"),
             impulse = file.read_doubles("history/stop_table_impulse"),
             gap = file.read_doubles("history/stop_table_gap");
  // 0.4 N s less the weight since the load exceeds it: 1.0336 mm. The contact that holds the ball
  // is a spring that follows within 0.1 ms and adds a hundredth.
  EXPECT_NEAR(*std::max_element(gap.begin() + static_cast<long>(gap.size()) / 2, gap.end()),
              1.0336e-3, 0.01 * 1.0336e-3);
  EXPECT_GT(changes(time, impulse).back(), 0.07);
  EXPECT_LT(result_.energy_residue, 1e-5);
}

/// A mass that meets a compliant plane with `speed`, without weight.
std::string impact(double mass, double speed, const std::string& contact) {
  return fmt::format(R"(
[time]
end_s = 3e-4
output_step_us = 10
largest_step_us = 1
[accuracy]
tolerance = 1e-7
[[rigid_body]]
name = "link"
motion = "zx"
mass_kg = {}
inertia_kg_m2 = 1e-7
centre_mm = [0, 0, 0.001]
start_velocity_m_s = [0, 0, {}]
[[stop]]
a = {{ body = "link", at_mm = [0, 0, 0.001] }}
b = {{ at_mm = [0, 0, 0] }}
normal = [0, 0, 1]
{}
)",
                     mass, -speed, contact);
}

/// The two times at which a recorded gap passes zero, between its samples.
std::pair<double, double> contact_times(const std::vector<double>& time,
                                        const std::vector<double>& gap) {
  std::vector<double> found;
  for (size_t i = 1; i < gap.size(); ++i)
    if ((gap[i] > 0.0) != (gap[i - 1] > 0.0))
      found.push_back(time[i - 1] + (time[i] - time[i - 1]) * gap[i - 1] / (gap[i - 1] - gap[i]));
  EXPECT_EQ(found.size(), 2U);
  return {found.at(0), found.at(1)};
}

TEST_F(Stops, OracleACompliantImpactHasTheForceDepthAndTimeOfHertz) {
  // 2.2 g at 0.5 m/s on C d^1.5.
  struct Case {
    double C, force, time;
  };
  for (const Case& at : {Case{2.168461e9, 68.6790, 58.9263e-6}}) {
    const H5File file =
        recorded(impact(2.2e-3, 0.5, fmt::format("stiffness_n_m = {}\nexponent = 1.5\n", at.C)));
    const auto force = file.read_doubles("history/stop_1_force"),
               gap = file.read_doubles("history/stop_1_gap");
    const auto [begin, end] = contact_times(file.read_doubles("history/time"), gap);
    const double depth = -*std::min_element(gap.begin(), gap.end()),
                 most = *std::max_element(force.begin(), force.end());
    std::printf("%.6g um, %.6g N, %.6g us\n", 1e6 * depth, most, 1e6 * (end - begin));
    // Samples at most 0.3 us apart miss the peak by (w t)^2 / 2, 3e-5.
    EXPECT_NEAR(depth, 10.0103e-6, 5e-5 * 10e-6);
    EXPECT_NEAR(most, at.force, 1e-4 * at.force);
    EXPECT_NEAR(end - begin, at.time, 2e-4 * at.time);
    EXPECT_LT(result_.energy_residue, 1e-5);
  }
}

TEST_F(Stops, OracleADampedImpactHasTheRestitutionOfHuntAndCrossley) {
  // chi v - ln(1 + chi v) = -chi e v - ln(1 - chi e v), chi = 0.5, for any exponent.
  const double speed[] = {0.5, 1.0, 2.0}, restitution[] = {0.856851, 0.748435, 0.593624};
  for (const double exponent : {1.0, 1.5})
    for (int k = 0; k < 3; ++k) {
      const double C = exponent == 1.0 ? 1e7 : 2.168461e9;
      const H5File file = recorded(
          impact(2.2e-3, speed[k],
                 fmt::format("stiffness_n_m = {}\nexponent = {}\nchi_s_m = 0.5\n", C, exponent)));
      const auto z = file.read_doubles("history/link_z"), time = file.read_doubles("history/time");
      const size_t n = z.size() - 1, m = n - 5;
      const double after = (z[n] - z[m]) / (time[n] - time[m]);
      std::printf("exponent %g, %g m/s: e %.6f\n", exponent, speed[k], after / speed[k]);
      EXPECT_NEAR(after / speed[k], restitution[k], 2e-5) << exponent;
    }
}

TEST_F(Stops, AreNamedWithTheEffects) {
  const auto model = build_model(scene(ball("zx", 0.5)), {});
  const auto lines = model->effects.lines(false);
  EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](const std::string& line) {
    return line.find("stops") != std::string::npos &&
           line.find("1 rigid with impacts, 0 compliant") != std::string::npos;
  }));
}

TEST_F(Stops, AreRefusedByKeyAndPlace) {
  const std::string body =
      "[time]\nend_s = 0.1\n[[rigid_body]]\nname = \"ball\"\nmotion = \"zx\"\nmass_kg = 1\n"
      "inertia_kg_m2 = 1\n[[stop]]\n";
  const std::string points = "a = { body = \"ball\", at_mm = [0, 0, 0] }\nb = {}\n";
  const std::string up = "normal = [0, 0, 1]\n";
  const auto expect = [&](const std::string& text, const std::string& said) {
    EXPECT_NE(refusal(body + text).find(said), std::string::npos) << refusal(body + text);
  };
  EXPECT_EQ(refusal(body + points + up + "restitution = 0.5\n"), "accepted");
  EXPECT_EQ(refusal(body + points + up + "stiffness_n_m = 1e6\n"), "accepted");
  expect(points + up, "stop[0].stiffness_n_m: give stiffness_n_m or restitution");
  expect(points + "normal = [0, 0, 0]\nrestitution = 1\n",
         "stop.run.toml:11: stop[0].normal: found length 0, expected a direction");
  expect(points + up + "restitution = 1.5\n", "stop[0].restitution: found 1.5, expected");
  expect(points + up + "restitution = 1\nstiffness_n_m = 1e6\n",
         "stop.run.toml:12: stop[0].restitution: stiffness_n_m and restitution exclude each other");
  expect(points + up + "restitution = 1\nexponent = 1.5\n",
         "stop[0].exponent: needs stiffness_n_m: a rigid contact has no depth");
  expect(points + up + "stiffness_n_m = 1e6\nrest_stiffness_n_m = 1e6\n",
         "stop[0].rest_stiffness_n_m: needs restitution");
  expect(points + up + "stiffness_n_m = 1e6\nexponent = 0.5\n", "stop[0].exponent: found 0.5");
  expect(points + up + "stiffness_n_m = 1e6\nstatic_friction = 0.5\n",
         "stop[0].static_friction: needs friction");
  expect(points + up + "stiffness_n_m = 1e6\nfriction = 0.5\nstatic_friction = 0.4\n",
         "stop[0].static_friction: found 0.4, expected at least friction, 0.5");
  expect(points + up +
             "stiffness_n_m = 1e6\nfriction = 0.5\nslip_speed_m_s = 1e-3\n"
             "stick_damping_us = 10\n",
         "stop[0].slip_speed_m_s: slip_speed_m_s and stick_damping_us exclude each other");
  expect("a = { body = \"ball\", at_mm = [0, 0, -2] }\nb = { at_mm = [0, 0, 0] }\n" + up +
             "restitution = 1\n",
         "stop.run.toml:9: stop[0].a: found 2 mm behind the plane at the start");
  expect("a = { at_mm = [0, 0, 1] }\nb = {}\n" + up + "restitution = 1\n",
         "stop.run.toml:8: a and b: found no body that can move");
  expect("a = { body = \"bal\", at_mm = [0, 0, 1] }\nb = {}\n" + up + "restitution = 1\n",
         "stop[0].a.body: no body \"bal\" in the scene");
}

}  // namespace
}  // namespace clatter::dynamics
