// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Scenes with the valves of the timing drive's reference.
#include <fmt/format.h>

#include <string>

namespace clatter::dynamics::testing {

struct ValveScene {
  double rpm = 1000.0;      // of the cam
  double turns = 1.0;       // of the cam
  double tolerance = 1e-3;  // displacements 10 um, velocities 0.1 m/s
  double output_us = 50.0;
  double start_deg = -120.0;  // of the cam; full lift at 0
  std::string valve;          // more keys of [[valve]]
  std::string tables;         // sub-tables [valve.spring] and the like
  bool mirrored = false;
};

/// One valve on a cam that turns as prescribed.
inline std::string one_valve(const ValveScene& scene) {
  const double side = scene.mirrored ? -1.0 : 1.0;
  return fmt::format(R"(
[time]
end_s = {}
output_step_us = {}
[accuracy]
tolerance = {}
[[drive]]
name = "cam"
speed_rpm = {}
axis = "z"
start_deg = {}
[[valve]]
name = "intake"
lift_mm = 7.5
half_angle_deg = 70
lobe = [{{ body = "cam", at_mm = [0, 0, 0], deg = 0 }}]
mirrored = {}
{}
{}
)",
                     scene.turns * 60.0 / scene.rpm, scene.output_us, scene.tolerance,
                     side * scene.rpm, side * scene.start_deg, scene.mirrored, scene.valve,
                     scene.tables);
}

}  // namespace clatter::dynamics::testing
