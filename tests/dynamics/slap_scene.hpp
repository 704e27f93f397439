// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A lubricated piston slap of synthetic bodies, as files.
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

}  // namespace clatter::dynamics::testing
