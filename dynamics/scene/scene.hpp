// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contents of a scene (stem.run.toml). docs/dynamics/scene.md documents the file; values here are
// SI.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/component/component.hpp"
#include "dynamics/component/run_time.hpp"
#include "dynamics/given/crank_clock.hpp"
#include "dynamics/integrate/integrator.hpp"

namespace clatter::dynamics {

/// [[recorded_force]]: forces on a body whose effect is wanted alone.
struct ForceRecordSpec {
  std::string name, body;
  std::vector<std::string> of;  // elements and loads, as the energy balance names them
  std::string where;            // "file:line", for messages
};

const keys::Keys<ForceRecordSpec>& recorded_force_keys();

struct Scene {
  std::filesystem::path file;
  std::vector<std::filesystem::path> inputs;  // every file that the scene reads, itself first
  std::string title, resolved;
  TimeSpec time;
  StepOptions steps;
  double film_every = 0.0;          // between stored film fields [s]; 0: none
  std::optional<CrankClock> clock;  // of an engine scene: runs are cycles of it
  std::string angle_zero;           // what its angle 0 is: "firing TDC"
  std::vector<ForceRecordSpec> forces;
  ComponentList components;  // in the order in which they are added to a model
};

/// Reads and checks a scene; InputError "file:line: key: found ..., expected ...".
Scene read_scene(const std::filesystem::path& path);
Scene read_scene(const Config& config, const std::filesystem::path& path);

}  // namespace clatter::dynamics
