// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The tables [time] and [accuracy] of a scene.
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>

#include "core/keys/keys.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// [time]; absent values follow from the scene.
struct TimeTable {
  std::optional<double> end;  // [s]
  std::string cycle_of;       // a drive
  std::optional<int> cycles;
  int recorded = 1;     // cycles
  double settle = 0.0;  // 0: exactly so many cycles
  std::filesystem::path start;
  std::optional<double> ramp;                           // [rad]
  std::optional<double> output_step;                    // [s]
  double film_every = 10.0 * std::numbers::pi / 180.0;  // [rad]
  std::optional<const Tableau*> method;
  std::optional<bool> exact_modes;
  std::optional<double> largest_step, smallest_step;  // [s]
};
const keys::Keys<TimeTable>& time_keys();
const keys::Keys<Accuracy>& accuracy_keys();

/// Reads span, ramp and output of a scene whose clock, if it has one, is known. InputError for
/// values outside their range, which allows for 2 to 1e9 samples.
TimeTable read_time(const Config& root, Scene& scene);

/// Sets method, step limits and accuracy; after read_time() and the components, whose film decides
/// on the default method.
void read_steps(const Config& root, TimeTable table, Scene& scene);

}  // namespace clatter::dynamics
