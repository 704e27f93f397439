// SPDX-License-Identifier: GPL-3.0-or-later
// Checkpoints of scenes without cycles.
#include "tests/dynamics/resumed_within.hpp"

#include <gtest/gtest.h>

#include "tests/dynamics/scene_text.hpp"

namespace clatter::dynamics {
namespace {

namespace fs = std::filesystem;

/// A ball that bounces on a rigid stop and comes to rest, a shoe that sticks and slides under a
/// load of both signs, one that creeps, and a body that turns freely in space.
const char* const kBodies = R"(
[time]
end_s = 0.6
output_step_us = 130
[accuracy]
tolerance = 1e-5
[[rigid_body]]
name = "ball"
motion = "zx"
mass_kg = 1.0
inertia_kg_m2 = 1.0
centre_mm = [0, 0, 20]
[[load]]
body = "ball"
component = "z"
value = -9.81
[[stop]]
name = "floor"
a = { body = "ball", at_mm = [0, 0, 20] }
b = { at_mm = [0, 0, 0] }
normal = [0, 0, 1]
restitution = 0.6
friction = 0.2
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
stiffness_n_m = 1e4
length_mm = 999.0
[[stop]]
name = "ground"
a = { body = "shoe", at_mm = [0, 0, 0] }
b = { at_mm = [0, 0, 0] }
normal = [0, 0, 1]
stiffness_n_m = 1e7
chi_s_m = 100.0
friction = 0.1
static_friction = 0.15
[[rigid_body]]
name = "snail"
motion = "zx"
mass_kg = 1.0
inertia_kg_m2 = 1.0
[[load]]
body = "snail"
component = "z"
value = -10.0
[[load]]
body = "snail"
component = "x"
value = 0.5
[[stop]]
name = "trail"
a = { body = "snail", at_mm = [0, 0, 0] }
b = { at_mm = [0, 0, 0] }
normal = [0, 0, 1]
stiffness_n_m = 1e7
chi_s_m = 100.0
friction = 0.1
slip_speed_m_s = 1e-3
[[rigid_body]]
name = "top"
motion = "space"
mass_kg = 1.0
inertia_kg_m2 = [0.01, 0.02, 0.03]
start_spin_rad_s = [0.1, 30.0, 0.2]
)";

class ResumedWithin : public testing::SceneText {
 protected:
  ResumedWithin() : SceneText("scene") {}
};

TEST_F(ResumedWithin, StopsThatStickCreepAndBounceGoOnToTheSameBits) {
  const Checkpoint from = testing::expect_same_bits_when_resumed(scene(kBodies), folder_);
  EXPECT_EQ(from.cycle, 0);
  EXPECT_GT(from.state.time, 0.0);
  EXPECT_EQ(from.statistics.accepted % kStepsBetween, 0);
}

TEST_F(ResumedWithin, ACheckpointThatLacksNumbersSaysWhatToDelete) {
  const Scene read = scene(kBodies);
  RunControl control;
  control.output = folder_ / "a.run.h5";
  control.checkpoint_seconds = 0.0;
  const fs::path point = checkpoint_path(control.output);
  RunResult result = simulate(read, {}, control);
  const Checkpoint whole = read_checkpoint(point, fingerprint(read)).value();
  const H5File run = testing::finished_file(read, {}, result);
  for (const size_t left : {whole.recorded.size() - 1, whole.recorded.size() + 1}) {
    Checkpoint other = whole;
    other.recorded.resize(left);
    CheckpointFile file(point);
    file.copy(run);
    file.commit(other, fingerprint(read));
    control.resume_from = read_checkpoint(point, fingerprint(read));
    test::expect_parts(test::refusal_of([&] { simulate(read, {}, control); }),
                       {point.string() + ": ", "numbers", "; delete " + point.string()});
  }
}

}  // namespace
}  // namespace clatter::dynamics
