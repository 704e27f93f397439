// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The timing drive of the reference, step by step.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "dynamics/integrate/integrator.hpp"
#include "dynamics/run/model.hpp"
#include "tests/dynamics/chain/timing_drive.hpp"

namespace clatter::dynamics::testing {

/// A scene's text, read as a file of a folder.
Scene scene_of(const std::string& text, const std::filesystem::path& folder);

struct RunningDrive {
  Scene scene;
  std::unique_ptr<Model> model;
  std::unique_ptr<Integrator> method;
  int steps = 0;

  /// Not started yet, so that an observer may be set.
  explicit RunningDrive(const TimingDrive& drive);
  /// From static equilibrium with the velocities of the drive.
  void start();
  /// To a time [s]; `each` is called after each step.
  void run(
      double until, const std::function<void()>& each = [] {});

  /// A history at the last accepted state.
  double history(const std::string& name) const;
  /// y index of coordinate 0 to 2 (u, v, angle) of a body.
  int coordinate(const std::string& body, int k) const;
  double y(const std::string& body, int k) const;
  double rate(const std::string& body, int k) const;
};

}  // namespace clatter::dynamics::testing
