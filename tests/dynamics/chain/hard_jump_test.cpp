// SPDX-License-Identifier: GPL-3.0-or-later
// Hard case TD2: a chain that jumps over teeth.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/dynamics/chain/running_drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

/// Two sprockets of 20 teeth, 240 mm apart, with two links more than 80. The chain is loose, and
/// the driven wheel is braked.
std::string loose_chain(double brake_n_m, double end_s) {
  return fmt::format(R"(
[time]
end_s = {}
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
                     end_s, brake_n_m);
}

TEST(HardTD2_ToothJump, Probe) {
  const double brake = getenv("BRAKE") ? atof(getenv("BRAKE")) : 20.0;
  const auto folder = testing::test_folder();
  const Scene scene = testing::scene_of(loose_chain(brake, 0.02), folder);
  RunResult result;
  const H5File file = testing::complete_file(scene, folder / "drive.run.h5", result);
  for (const auto& w : result.warnings) std::printf("warning: %s\n", w.c_str());
  const auto v = file.read_doubles("history/chain_jumps");
  for (size_t i = 0; i < v.size(); i += 50) std::printf("%g ", v[i]);
  std::printf("steps %d %s\n", (int)result.statistics.accepted, result.failure.c_str());
}

}  // namespace
}  // namespace clatter::dynamics
