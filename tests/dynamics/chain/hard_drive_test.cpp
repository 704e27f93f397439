// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases of the timing drive.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "dynamics/run/start_state.hpp"
#include "tests/dynamics/chain/running_drive.hpp"
#include "tests/dynamics/slap_scene.hpp"
#include "tests/refusal.hpp"

namespace clatter::dynamics {
namespace {

using testing::RunningDrive;
using testing::TimingDrive;

class HardDrive : public ::testing::Test {
 protected:
  Scene scene(const TimingDrive& drive) {
    std::ofstream(folder_ / "drive.run.toml") << drive.scene();
    return read_scene(folder_ / "drive.run.toml");
  }
  H5File recorded(const TimingDrive& drive) {
    const Scene read = scene(drive);
    return testing::complete_file(read, folder_ / "drive.run.h5", result_);
  }
  std::filesystem::path folder_ = testing::test_folder();
  RunResult result_;
};

TEST_F(HardDrive, Probe) {
  TimingDrive drive;
  const char* rpm = getenv("RPM");
  drive.rpm = rpm ? atof(rpm) : 3400;
  drive.friction = getenv("MU") ? atof(getenv("MU")) : 0.08;
  drive.end_s = getenv("END") ? atof(getenv("END")) : 2e-3;
  drive.exhaust_spin = getenv("SPIN") ? atof(getenv("SPIN")) : 0;
  drive.start_turns = getenv("TURNS") ? atof(getenv("TURNS")) : 0;
  drive.plunger_back_mm = getenv("BACK") ? atof(getenv("BACK")) : 0;
  drive.joint_clearance_um = getenv("CLEAR") ? atof(getenv("CLEAR")) : 0;
  drive.links = getenv("LINKS") ? atoi(getenv("LINKS")) : 130;
  drive.output_us = 1;
  if (getenv("PLUNGER")) drive.plunger_n_m = atof(getenv("PLUNGER"));
  if (getenv("MORE")) drive.more = getenv("MORE");
  RunningDrive run(drive);
  run.start();
  const double until = drive.end_s;
  for (int i = 0; i <= 12; ++i) {
    if (i > 0) run.run(until * i / 12);
    std::printf("%.5f", run.method->state().time);
    for (const char* name :
         {"chain_tension_min", "chain_tension_max", "chain_jumps", "chain_guide_contacts",
          "chain_arm_contacts", "chain_guide_force_x", "chain_arm_force_x", "chain_crank_contacts",
          "chain_exhaust_contacts", "chain_intake_contacts"})
      std::printf(" %9.4g", run.history(name));
    std::printf(" ex %.5g arm %.5g\n", run.rate("exhaust", 2), run.y("arm", 2));
  }
}

}  // namespace
}  // namespace clatter::dynamics
