// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The motions on which bench/integrators.py compares integrators.
#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "dynamics/integrate/integrator.hpp"

namespace clatter::bench {

/// Modal displacements and velocities, N each.
struct ModalState {
  Eigen::VectorXd eta, v;
};

/// A motion from `begin` to `end` and what is compared of it.
struct BenchScene {
  std::shared_ptr<dynamics::System> system;
  Eigen::VectorXd eta, v;  // at `begin`, N
  double begin = 0.0, end = 0.0;
  int samples = 200;              // equidistant, the last one at `end`
  dynamics::StepOptions options;  // of the kernel; tolerance 1: `accuracy` has the scales
  std::string unit;               // of what is compared
  /// The compared values of a state.
  std::function<Eigen::VectorXd(double time, const ModalState& state)> observe;

  /// Time of a sample, 1 to `samples`.
  double sample_time(int sample) const {
    return sample == samples ? end : begin + (end - begin) * sample / samples;
  }
};

/// Names of all scenes.
const std::vector<std::string>& scene_names();
/// A new scene: one of these, or the scene of a file, *.run.toml, with a chain (chain_scene).
/// InputError for other names.
BenchScene make_scene(const std::string& name);

/// The scene of a file with a [[chain]], sampled at its output steps. Compared are the tensions of
/// all joints [N] and, last, the spin of the body "intake" [rad/s].
BenchScene chain_scene(const std::filesystem::path& file);

}  // namespace clatter::bench
