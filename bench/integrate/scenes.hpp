// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The motions on which bench/integrators.py compares integrators.
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::bench {

/// A motion from `begin` to `end` and what is compared of it.
struct BenchScene {
  std::shared_ptr<dynamics::System> system;
  Eigen::VectorXd eta, v;  // at `begin`, N
  double begin = 0.0, end = 0.0;
  int samples = 200;              // equidistant, the last one at `end`
  dynamics::StepOptions options;  // of the kernel; tolerance 1: `accuracy` has the scales
  std::string unit;               // of what is compared
  /// The compared values of a state: of the time and the modal displacements, N.
  std::function<Eigen::VectorXd(double time, const Eigen::VectorXd& eta)> observe;

  /// Time of a sample, 1 to `samples`.
  double sample_time(int sample) const {
    return sample == samples ? end : begin + (end - begin) * sample / samples;
  }
};

/// Names of all scenes.
const std::vector<std::string>& scene_names();
/// A new scene; InputError for other names.
BenchScene make_scene(const std::string& name);

}  // namespace clatter::bench
