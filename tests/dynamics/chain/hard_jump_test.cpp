// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case TD2: a chain that jumps over teeth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/dynamics/chain/running_drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/observed.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

/// Two sprockets of 20 teeth, 240 mm apart, with two links more than 80. The chain is loose, and
/// the driven wheel is braked.
std::string loose_chain(double brake_n_m) {
  return fmt::format(R"(
[time]
end_s = 0.02
output_step_us = 20
largest_step_us = 20
[accuracy]
tolerance = 1e-3
[[drive]]
name = "crank"
speed_rpm = -1000
axis = "z"
[[rigid_body]]
name = "wheel"
motion = "xy"
mass_kg = 1.0
inertia_kg_m2 = 1e-3
centre_mm = [240, 0, 0]
start_spin_rad_s = -104.72
[[bushing]]
name = "wheel"
a = {{ body = "wheel", at_mm = [240, 0, 0] }}
b = {{ }}
stiffness_n_m = 1e9
damping_n_s_m = 1e4
[[torque]]
name = "brake"
body = "wheel"
drag_n_m = {}
drag_speed_rad_s = 1
[[chain]]
name = "chain"
plane = "xy"
links = 82
first = "inner"
pitch_mm = 8
bush_mm = 5.0
plate_half_height_mm = 3.6
inner = {{ mass_kg = 2.2e-3, inertia_kg_m2 = 4.0e-8 }}
outer = {{ mass_kg = 2.6e-3, inertia_kg_m2 = 4.8e-8 }}
joint = {{ stiffness_n_m = 1e7, damping_n_s_m = 200 }}
[[chain.over]]
sprocket = "crank"
on = {{ body = "crank", at_mm = [0, 0, 0] }}
turn = "clockwise"
teeth = 20
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5 }}
[[chain.over]]
sprocket = "wheel"
on = {{ body = "wheel", at_mm = [240, 0, 0] }}
turn = "clockwise"
teeth = 20
contact = {{ bed_n_m3 = 5e12, width_mm = 4.6, damping_s_m = 0.5 }}
)",
                     brake_n_m);
}

class HardTD2_ToothJump : public ::testing::Test {
 protected:
  H5File run(double brake_n_m) {
    const Scene scene = testing::scene_of(loose_chain(brake_n_m), folder_);
    return testing::complete_file(scene, folder_ / "drive.run.h5", result_);
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

TEST_F(HardTD2_ToothJump, IsReportedWithSprocketAndTimeAndTheRunGoesOn) {
  const H5File file = run(20.0);
  ASSERT_EQ(result_.warnings.size(), 1u);
  const std::string& said = result_.warnings[0];
  test::expect_parts(said, {"chain \"chain\" jumped on sprocket \"wheel\" at 0.0",
                            " teeth in all; at the end it is 1 ahead of where it was"});
  // The time is that of the first link; the history has the jump when all have followed.
  const std::vector<double> times = file.read_doubles("history/time"),
                            jumps = file.read_doubles("history/chain_jumps");
  const auto jump = std::upper_bound(jumps.begin(), jumps.end(), 0.0);
  ASSERT_NE(jump, jumps.end());
  // On its way it may fall back into its gap and leave it again.
  test::expect_at_least("links of a jump", jumps.back(), 1.0);
  const double all = times[jump - jumps.begin()],
               first = std::stod(said.substr(said.find(" at ") + 4));
  EXPECT_LT(first, all);
  EXPECT_GT(first, all - 2e-3);
  EXPECT_NEAR(times.back(), 0.02, 1e-12);
}

TEST_F(HardTD2_ToothJump, IsNotSeenWhereALooseChainOnlyRidesUp) {
  const H5File file = run(2.0);
  EXPECT_EQ(result_.warnings.size(), 0u);
  EXPECT_EQ(file.read_doubles("history/chain_jumps").back(), 0.0);
}

}  // namespace
}  // namespace clatter::dynamics
