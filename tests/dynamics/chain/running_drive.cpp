// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/chain/running_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "dynamics/run/start_state.hpp"
#include "tests/dynamics/slap_scene.hpp"

namespace clatter::dynamics::testing {

Scene scene_of(const std::string& text, const std::filesystem::path& folder) {
  const std::filesystem::path path = folder / "drive.run.toml";
  std::ofstream(path) << text;
  return read_scene(path);
}

RunningDrive::RunningDrive(const TimingDrive& drive)
    : scene(scene_of(drive.scene(), test_folder())),
      model(build_model(scene, {})),
      method(make_integrator(model->system, scene.steps)) {}

void RunningDrive::start() {
  const ModalStart at = start_state(scene, {}, *model);
  method->start(0.0, at.eta, at.v);
}

void RunningDrive::run(double until, const std::function<void()>& each) {
  while (method->state().time < until) {
    method->step(until);
    ++steps;
    each();
  }
}

double RunningDrive::history(const std::string& name) const {
  History history;
  model->record(method->state(), history);
  for (const History::Entry& entry : history.entries())
    if (entry.name == name) return entry.value;
  ADD_FAILURE() << "no history " << name;
  return std::nan("");
}

int RunningDrive::coordinate(const std::string& body, int k) const {
  System& system = model->system;
  for (int b = 0; b < static_cast<int>(system.bodies().size()); ++b)
    if (system.bodies()[b].name == body) return system.coordinate(b, k);
  ADD_FAILURE() << "no body " << body;
  return 0;
}

double RunningDrive::y(const std::string& body, int k) const {
  return method->state().y(coordinate(body, k));
}

double RunningDrive::rate(const std::string& body, int k) const {
  return method->state().v_y(coordinate(body, k));
}

}  // namespace clatter::dynamics::testing
