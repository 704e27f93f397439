// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// An effect of vanishing strength against the effect that is off.
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "dynamics/run/model.hpp"

namespace clatter::dynamics::testing {

/// What a short run in equal steps arrives at.
struct ShortRun {
  std::map<std::string, std::pair<std::string, double>> history;  // name: unit, value
  std::map<std::string, Eigen::VectorXd> velocity;                // of each body
  std::vector<Effect> effects;
  int elements = 0, modes = 0;                      // of the system
  std::string row(const std::string& entry) const;  // "on" if one of its rows is; "off", "none"
  int64_t evaluations(const std::string& entry) const;
};

/// Steps of a run: `count` of `length` [s] from `begin` [s] on, loads without a ramp.
struct ShortSteps {
  double begin = 0.0, length = 1e-5;
  int count = 20;
};

ShortRun short_run(const Scene& scene, const ShortSteps& steps);

/// The largest difference of the velocity of a body, or of a history, that both have, over the
/// largest velocity, or the largest history of the same unit, of the run with the effect off; a
/// unit in which that has nothing but zeros is left out. @param histories_only velocities are of
/// bodies with other masses
double difference(const ShortRun& run, const ShortRun& off, bool histories_only = false);

/// One effect of the catalogue.
struct LimitCase {
  std::string effect;  // name in the catalogue
  std::function<Scene()> off;
  std::function<Scene(double)> on;  // at a strength
  double strong = 1e-2, weak = 1e-3;
  /// The difference falls as strength^order; 0: it is gone at `weak`, to rounding.
  double order = 1.0;
  ShortSteps steps{};
  /// The table's state where it is off: "none", no row of it.
  std::string row_off = "off";
  bool histories_only = false;  // see difference()
};

/// The case of an effect; a failure of the test where there is none.
LimitCase case_of(const std::vector<LimitCase>& cases, const std::string& effect);

/// Expects the row to be on and off, and the difference to be there and to fall.
void expect_limit(const LimitCase& one);

/// The scene of a text, written into `folder`.
Scene scene_of(const std::filesystem::path& folder, const std::string& text);

}  // namespace clatter::dynamics::testing
