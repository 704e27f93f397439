// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case TD13: valves that float.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/dynamics/valve/valve_fixture.hpp"
#include "tests/dynamics/valve/valve_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::of;
using testing::one_valve;
using testing::Valves;
using testing::ValveScene;

TEST_F(Valves, OracleHardTD13_AValveFloatsFromTheSpeedOfTheFormula) {
  // 6920 rpm of the crank by 150 + k y + m w^2 y'' = 0 with 80 g; 3460 of the cam.
  int lost[2];
  int k = 0;
  for (const double rpm : {3400.0, 3520.0}) {
    ValveScene with;
    with.rpm = rpm;
    with.turns = 4.0;
    with.tables = "[valve.lash_adjuster]\nmodel = \"rigid\"\n";
    const H5File file = recorded(one_valve(with));
    lost[k] = static_cast<int>(of(file, "intake_1_cam_losses").back());
    const auto gap = of(file, "intake_1_cam_gap"), force = of(file, "intake_1_cam_force");
    for (size_t i = 0; i < gap.size(); ++i) EXPECT_EQ(gap[i] > 1e-9 ? force[i] : 0.0, 0.0);
    std::printf("%.0f rpm of the crank: cam lost %d times, gap %.1f um at most\n", 2.0 * rpm,
                lost[k], 1e6 * *std::max_element(gap.begin(), gap.end()));
    if (k++ == 0) {
      EXPECT_TRUE(result_.warnings.empty()) << result_.warnings.front();
    } else {
      ASSERT_FALSE(result_.warnings.empty());
      test::expect_parts(result_.warnings.front(),
                         {"intake_1: the roller lost its cam", "cam at -", "found it again", "um"});
    }
  }
  EXPECT_EQ(lost[0], 0);
  EXPECT_GT(lost[1], 0);
}

TEST_F(Valves, HardTD13_FarAboveItTheCamIsLostAndFoundAndTheAdjusterPumpsUp) {
  ValveScene with;
  with.rpm = 5000.0;
  with.turns = 4.0;
  with.tolerance = 1e-4;
  const H5File file = recorded(one_valve(with));
  for (const double p : of(file, "intake_1_adjuster_pressure")) ASSERT_GT(p, 0.0);
  EXPECT_GT(of(file, "intake_1_cam_losses").back(), 3.0);
  EXPECT_GT(of(file, "intake_1_held_open").back(), 2.0);
  EXPECT_GT(of(file, "intake_1_adjuster_travel").back(), 0.1e-3);
  ASSERT_EQ(result_.warnings.size(), 2U);
  test::expect_parts(result_.warnings[0], {"lost its cam"});
  test::expect_parts(result_.warnings[1], {"did not close", "pumped up by"});
  EXPECT_LT(result_.energy_residue, 1e-4);
  for (const std::string& text : result_.warnings) std::printf("%s\n", text.c_str());
}

}  // namespace
}  // namespace clatter::dynamics
