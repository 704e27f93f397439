// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/dynamics/effects/limit_case.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "dynamics/integrate/integrator.hpp"
#include "dynamics/run/start_state.hpp"
#include "tests/observed.hpp"

namespace clatter::dynamics::testing {

std::string ShortRun::row(const std::string& entry) const {
  std::string state = "none";
  for (const Effect& effect : effects) {
    if (effect.entry->name != entry) continue;
    if (effect.on) return "on";
    state = "off";
  }
  return state;
}

int64_t ShortRun::evaluations(const std::string& entry) const {
  int64_t sum = 0;
  for (const Effect& effect : effects)
    if (effect.entry->name == entry) sum += effect.evaluations;
  return sum;
}

ShortRun short_run(const Scene& given, const ShortSteps& steps) {
  Scene scene = given;
  scene.time.ramp = 0.0;
  scene.time.begin = steps.begin;
  const LoadedBodies bodies = load_bodies(scene);
  const auto model = build_model(scene, bodies);
  StepOptions options = scene.steps;
  options.fixed = true;
  options.largest = steps.length;
  options.smallest = 1e-6 * steps.length;
  options.first = 1e-3 * steps.length;
  const auto method = make_integrator(model->system, options);
  const ModalStart start = start_state(scene, bodies, *model);
  method->start(steps.begin, start.eta, start.v);
  for (int k = 0; k < steps.count; ++k) method->step(1e9);
  ShortRun made;
  History history;
  model->record(method->state(), history);
  for (const History::Entry& entry : history.entries())
    made.history[entry.name] = {entry.unit, entry.value};
  for (int b = 0; b < static_cast<int>(model->system.bodies().size()); ++b) {
    const ModalBody& body = model->system.bodies()[b];
    made.velocity[body.name] =
        method->state().v.segment(model->system.mode_offset(b), body.modes());
  }
  for (const ElementCost& cost : model->system.costs()) {
    EXPECT_GT(cost.evaluations, 0) << cost.name;
    model->effects.charge(cost.name, cost.seconds, cost.evaluations);
  }
  made.effects = model->effects.effects();
  made.elements = model->system.elements();
  made.modes = model->system.modes();
  return made;
}

double difference(const ShortRun& run, const ShortRun& off, bool histories_only) {
  double fastest = 0.0, by_velocity = 0.0, by_history = 0.0;
  for (const auto& [name, v] : off.velocity) {
    const auto other = run.velocity.find(name);
    if (histories_only || other == run.velocity.end() || other->second.size() != v.size()) continue;
    if (v.size() == 0) continue;
    fastest = std::max(fastest, v.cwiseAbs().maxCoeff());
    by_velocity = std::max(by_velocity, (v - other->second).cwiseAbs().maxCoeff());
  }
  std::map<std::string, double> largest, apart;
  for (const auto& [name, value] : off.history) {
    const auto other = run.history.find(name);
    if (other == run.history.end()) continue;
    const auto& [unit, number] = value;
    largest[unit] = std::max(largest[unit], std::abs(number));
    apart[unit] = std::max(apart[unit], std::abs(number - other->second.second));
  }
  for (const auto& [unit, value] : apart)
    if (largest[unit] > 0.0) by_history = std::max(by_history, value / largest[unit]);
  return std::max(fastest > 0.0 ? by_velocity / fastest : 0.0, by_history);
}

LimitCase case_of(const std::vector<LimitCase>& cases, const std::string& effect) {
  for (const LimitCase& one : cases)
    if (one.effect == effect) return one;
  ADD_FAILURE() << "no case of " << effect;
  return {};
}

void expect_limit(const LimitCase& one) {
  SCOPED_TRACE(one.effect);
  const ShortRun off = short_run(one.off(), one.steps);
  const ShortRun strong = short_run(one.on(one.strong), one.steps);
  const ShortRun weak = short_run(one.on(one.weak), one.steps);
  EXPECT_EQ(off.row(one.effect), one.row_off);
  EXPECT_EQ(strong.row(one.effect), "on");
  // What is off has no element, no coordinate and no evaluation.
  const bool own_element = strong.evaluations(one.effect) > 0;
  EXPECT_EQ(off.evaluations(one.effect), 0);
  EXPECT_LE(off.modes, strong.modes);
  EXPECT_LE(off.elements, strong.elements);
  if (own_element && one.row_off == "none") {
    EXPECT_LT(off.elements, strong.elements);
  }
  const double far = difference(strong, off, one.histories_only),
               near = difference(weak, off, one.histories_only);
  const double found = std::log(far / near) / std::log(one.strong / one.weak);
  test::observed(fmt::format("{}: {:.3g} from off at strength {:g}, {:.3g} at {:g}, order {:.2f}",
                             one.effect, far, one.strong, near, one.weak, found));
  EXPECT_GT(far, 1e-9);  // the effect acts
  if (one.order == 0.0) {
    EXPECT_LT(near, 1e-6 * far);
  } else {
    EXPECT_NEAR(found, one.order, 0.15);
    EXPECT_LT(near, 1.0);
  }
}

Scene scene_of(const std::filesystem::path& folder, const std::string& text) {
  std::ofstream(folder / "limit.run.toml") << text;
  return read_scene(folder / "limit.run.toml");
}

}  // namespace clatter::dynamics::testing
