// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A lubricated piston slap of synthetic bodies, as files.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics::testing {

/// A new folder of the current test; CTest runs tests side by side.
std::filesystem::path test_folder();

/// Writes slap.run.toml (two cycles, rigid piston and block) and what it reads: piston.rom.h5,
/// block.rom.h5 (elastic), bar.rom.h5, motored.csv.
void write_slap_scene(const std::filesystem::path& folder);

/// The scene with some tables changed: changed.run.toml, based on slap.run.toml.
Scene changed_scene(const std::filesystem::path& folder, const std::string& changes);

/// The InputError of that scene when it is read or its model is built, else "accepted".
std::string scene_refusal(const std::filesystem::path& folder, const std::string& changes);

/// Completes the file of a result and reads it.
H5File finished_file(const Scene& scene, const LoadedBodies& bodies, RunResult& result);

/// Runs the scene to its end, which is expected, and reads the file.
H5File complete_file(const Scene& scene, const std::filesystem::path& output, RunResult& result);

/// The table of an elastic block, instead of the rigid one.
inline constexpr const char* kElasticBlock = R"(
[block]
model = "elastic"
liner = "liner_4"
liner_axial = "liner_4_axial"
bearings = ["main_4", "main_5"]
gas_load = "head_4_gas"
mode_limit_hz = 8000.0
)";

/// A dry skirt on four_bore_block(), elastic on mounts of this stiffness [N/m].
std::string dry_engine(double stiffness);
/// Cylinder "c<number>" of that block, 1 to 4, with further keys of its own.
std::string in_line_cylinder(int number, const std::string& keys = "");

/// Tests of scenes that change that of write_slap_scene().
class SlapScenes : public ::testing::Test {
 protected:
  void SetUp() override { write_slap_scene(folder_); }
  Scene scene(const std::string& changes) { return changed_scene(folder_, changes); }
  std::string refusal(const std::string& changes) { return scene_refusal(folder_, changes); }
  /// Runs the scene to the end; its file is `name`.run.h5.
  H5File recorded(const Scene& scene, const std::string& name) {
    return complete_file(scene, folder_ / (name + ".run.h5"), result_);
  }
  std::filesystem::path folder_ = test_folder();
  RunResult result_;
};

}  // namespace clatter::dynamics::testing
