// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/drive_component.hpp"
#include "dynamics/component/engine_table.hpp"
#include "dynamics/scene/registry.hpp"
#include "dynamics/scene/time_table.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kLeastSpeed = 0.01 * std::numbers::pi / 30.0;  // of a clock [rad/s]

/// The clock of the drive that [time] names: engine cycles without an [engine].
CrankClock read_drive_clock(const Config& root, const Config& time, const std::string& drive) {
  const double mean = speed_of_drive(root, time, "cycle_of", drive), speed = std::abs(mean);
  if (!(speed >= kLeastSpeed))
    time.fail("cycle_of", fmt::format("found \"{}\" with {:g} rpm, expected a drive that turns",
                                      drive, speed * 30.0 / std::numbers::pi));
  CrankClock clock{speed, orders_of_drive(root, drive)};
  // The angle of the cycle grows, whatever the drive's sense: cos(-x + p) = cos(x - p).
  if (mean < 0.0)
    for (SpeedOrder& order : clock.orders) {
      order.amplitude = -order.amplitude;
      order.phase = -order.phase;
    }
  if (!clock.is_forward())
    time.fail("cycle_of", fmt::format("found \"{}\", which stops or turns back by its orders, "
                                      "expected a drive that always turns",
                                      drive));
  return clock;
}

std::optional<CrankClock> read_clock(const Config& root) {
  const auto engine = root.find_table("engine");
  if (const auto time = root.find_table("time"); time && time->has("cycle_of")) {
    if (engine)
      time->fail("cycle_of",
                 "cycle_of and [engine] exclude each other: the engine's crank defines the cycle");
    return read_drive_clock(root, *time, time_keys().read(*time).cycle_of);
  }
  if (!engine) return std::nullopt;
  return engine_keys().read(*engine).clock;
}

/// What crank angle 0 is. An engine without gas does not fire.
std::string angle_zero(const Config& root) {
  if (!root.has("engine")) return "the cycle's start";
  const std::vector<Config> cylinders = root.tables("cylinder");
  const bool fires =
      root.has("gas") || std::any_of(cylinders.begin(), cylinders.end(),
                                     [](const Config& one) { return one.has("gas"); });
  return fires ? "firing TDC" : "TDC";
}

void check_engine(const Config& root) {
  for (const char* key : {"piston", "block", "gas", "contact", "rod", "small_end", "big_end",
                          "pin_guide", "cylinder", "crank"}) {
    if (root.has(key) && !root.has("engine"))
      root.fail(key, "needs [engine], with speed and stroke");
  }
  if (!root.has("engine") && !root.has("body") && !root.has("rigid_body") && !root.has("shaft") &&
      !root.has("valve")) {
    root.fail("body",
              "give [engine] with [piston], or a [[body]], [[rigid_body]], [[valve]] or [[shaft]]");
  }
}

/// Reduced models first, then the tables of components.
void list_inputs(const Config& root, Scene& scene) {
  scene.inputs = root.files();
  const auto add = [&](const std::filesystem::path& path) {
    if (std::find(scene.inputs.begin(), scene.inputs.end(), path) == scene.inputs.end()) {
      scene.inputs.push_back(path);
    }
  };
  for (const auto& component : scene.components)
    for (const BodySpec& body : component->reduced_bodies()) add(body.rom);
  for (const auto& component : scene.components)
    for (const auto& path : component->inputs()) add(path);
  if (!scene.time.start.empty()) add(scene.time.start);
}

std::vector<ForceRecordSpec> read_recorded_forces(const Config& root) {
  std::vector<ForceRecordSpec> forces;
  for (const Config& table : root.tables("recorded_force")) {
    ForceRecordSpec spec = recorded_force_keys().read(table);
    for (const ForceRecordSpec& other : forces)
      if (other.name == spec.name && other.body == spec.body)
        table.fail("name", fmt::format("found a second \"{}\" of {}, expected each name once",
                                       spec.name, spec.body));
    forces.push_back(std::move(spec));
  }
  return forces;
}

/// What settles must repeat.
void check_repeats(const Config& root, const Scene& scene) {
  if (scene.time.settle == 0.0) return;
  for (const auto& component : scene.components)
    if (!component->repeats(scene.clock->cycle()))
      root.table("time").fail(
          "settle_to", fmt::format("found {:g}, but \"{}\" does not repeat its motion each cycle, "
                                   "expected a scene of which all parts do, or no settle_to",
                                   scene.time.settle, component->name()));
}

}  // namespace

const Keys<ForceRecordSpec>& recorded_force_keys() {
  static const Keys<ForceRecordSpec> keys(
      "recorded_force", "forces on a body whose effect is wanted alone",
      [](auto& key, ForceRecordSpec& force) {
        key.where(force.where, "name");
        name_row(key, force.name).required();
        key.text("body", force.body, "the body on which they act").required();
        key.texts("of", force.of, "names of elements and loads, as the energy balance has them")
            .required();
      });
  return keys;
}

Scene read_scene(const std::filesystem::path& path) {
  return read_scene(Config::load_with_base(path), path);
}

Scene read_scene(const Config& root, const std::filesystem::path& path) {
  Scene scene;
  scene.file = path;
  check_known(root);
  scene.title = root.text_or("title", path.stem().stem().string());
  check_engine(root);
  scene.clock = read_clock(root);
  if (scene.clock) scene.angle_zero = angle_zero(root);
  const TimeTable time = read_time(root, scene);
  scene.components = read_components(root);
  scene.forces = read_recorded_forces(root);
  read_steps(root, time, scene);
  check_repeats(root, scene);
  root.finish();
  scene.resolved = root.resolved();
  list_inputs(root, scene);
  return scene;
}

}  // namespace clatter::dynamics
