// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/effects_command.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"
#include "dynamics/run/effect_report.hpp"

namespace clatter::dynamics {

void print_effects(const std::filesystem::path& path, const std::filesystem::path& run) {
  const Scene scene = read_scene(path);
  const LoadedBodies bodies = load_bodies(scene);
  const auto model = build_model(scene, bodies);
  std::optional<RunForecast> forecast = measured_run(scene, *model, run);
  if (!forecast && std::filesystem::exists(run))
    say(fmt::format("{}: not of this scene with these inputs, or not complete: not used",
                    run.string()));
  if (!forecast) forecast = probe_run(scene, bodies);
  for (const std::string& line : effect_lines(*forecast)) print_result(line);
  if (is_json()) print_json(effects_json(*forecast));
}

}  // namespace clatter::dynamics
