// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/cycle_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/units.hpp"
#include "dynamics/run/mounted_motion.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/start_state.hpp"

namespace clatter::dynamics {
namespace {

Span span_after(const Scene& scene, int cycle) {
  const TimeSpec& time = scene.time;
  if (!scene.clock || time.settle > 0.0) return {time.begin, time.end};
  const double length = scene.clock->cycle();
  const double begin = time.end - length * (time.cycles - cycle);
  if (cycle + time.recorded >= time.cycles) return {begin, time.end, time.cycles - cycle, length};
  return {begin, begin + length};
}

/// Cycles that all have the same times begin with the ramp of the first one only.
std::unique_ptr<Model> model_of(const Scene& scene, const LoadedBodies& bodies, int cycle) {
  if (scene.time.settle == 0.0 || cycle == 0) return build_model(scene, bodies);
  Scene later = scene;
  later.time.ramp = 0.0;
  return build_model(later, bodies);
}

std::string creep_text(const std::string& name, double crept) {
  return fmt::format(
      "{}: it crept by {:.3g} um at rest, while its friction was below the limit: a smaller "
      "slip_speed_m_s creeps less; [[stop]] sticks without this key",
      name, crept / kMicro);
}

}  // namespace

int most_cycles(const Scene& scene) { return scene.clock ? scene.time.cycles : 1; }

CycleRun::CycleRun(const Scene& scene, const LoadedBodies& bodies, const Checkpoint& from,
                   const std::filesystem::path& output)
    : scene_(scene),
      point_(checkpoint_path(output)),
      bodies_(bodies),
      completed_(from.cycle),
      span_(span_after(scene, from.cycle)),
      output_step_(fitted_step(span_.cycle, scene.time.output_step)),
      model_(model_of(scene, bodies, from.cycle)),
      file_(std::make_unique<H5File>(H5File::create(output))),
      energy_(model_->system, *scene.steps.method),
      forces_(energy_),
      method_(make_integrator(model_->system, scene.steps)),
      recorder_(*model_, {span_.begin, span_.end, span_.cycle, output_step_, scene.film_every},
                *file_, [this](const SampleBlock& block) { pass_on(block); }) {
  for (const ForceRecordSpec& spec : scene.forces)
    forces_.add(std::make_unique<ForceRecord>(*model_, bodies, spec, *scene.steps.method, *file_,
                                              span_.begin, span_.end, output_step_));
  method_->set_observer(&forces_);
  if (from.state.eta.size() == 0) {
    start();
  } else {
    from_checkpoint(point_, [&] {
      restore(from);
      if (from.cycle > 0 && span_.cycles == 1) compare_with(H5File::open(point_));
    });
  }
  if (span_.cycles > 1 || from.cycle + 1 < most_cycles(scene)) next_.emplace(point_);
  recorder_.start(method_->state());
  forces_.start(span_.begin);
  if (!from.recorded.empty()) from_checkpoint(point_, [&] { take_up(from, H5File::open(point_)); });
  begin_ = method_->state();
}

/// From the places given, from static equilibrium, or from the end of another run.
void CycleRun::start() {
  const ModalStart at = first_state(scene_, bodies_, *model_);
  method_->start(span_.begin, at.eta, at.v);
}

void CycleRun::restore(const Checkpoint& from) {
  const auto& system = model_->system;
  const auto require = [](const char* name, Eigen::Index found, Eigen::Index expected) {
    if (found != expected)
      throw InputError(fmt::format("{}: found {} numbers, expected {}", name, found, expected));
  };
  require("elements", std::ssize(from.elements), system.elements());
  for (const auto* values : {&from.state.eta, &from.state.v, &from.state.a})
    require("state", values->size(), system.modes());
  for (const auto* values : {&from.state.y, &from.state.v_y})
    require("state", values->size(), system.interface_size());
  for (int e = 0; e < system.elements(); ++e) model_->system.element(e).restore(from.elements[e]);
  if (scene_.time.settle > 0.0) {  // the state was moved: its rates and forces are others
    method_->start(span_.begin, from.state.eta, from.state.v);
    return;
  }
  energy_.restore(from.energy, from.state.time);
  method_->resume(from.state, from.rung);
}

void CycleRun::compare_with(H5File before) {
  before_.emplace(*model_, std::move(before), sample_count(span_.cycle, output_step_), span_.cycle);
}

/// Goes on with what was recorded before a checkpoint within the span.
void CycleRun::take_up(const Checkpoint& from, const H5File& file) {
  file_->copy(file, kRunSoFar, "/");
  Archive recorded(from.recorded);
  archive(recorded);
  if (!recorded.is_used_up()) throw InputError("recorded: found too many numbers");
}

/// What has summed up over the span, besides states.
void CycleRun::archive(Archive& archive) {
  recorder_.archive(archive);
  forces_.archive(archive);
  energy_.archive(archive);
  method_->estimate().archive(archive);
  for (int e = 0; e < model_->system.elements(); ++e) model_->system.element(e).archive(archive);
  archive(most_held_);
}

/// What elements and integrator keep besides their states is forgotten, as after a checkpoint.
void CycleRun::begin_again() {
  for (int e = 0; e < model_->system.elements(); ++e) {
    ForceElement& element = model_->system.element(e);
    element.restore(element.save());
  }
  method_->resume(method_->state(), method_->rung());
}

void CycleRun::finish() {
  recorder_.finish();
  forces_.finish();
}

bool CycleRun::run(const std::function<void(double)>& progress,
                   const std::function<void()>& at_point, const std::atomic<bool>* stop) {
  for (int left = span_.cycles; left > 0; --left) {
    const double end = span_.end_of_cycle(left);
    while (method_->state().time < end) {
      if (stop != nullptr && stop->load()) return false;
      method_->step(end);
      recorder_.record(*method_, energy_);
      pressure_.look(*model_, recorder_.last(), method_->state().time);
      most_held_ = std::max(most_held_, recorder_.held() + forces_.held());
      progress(method_->state().time);
      if (scene_.clock || method_->statistics().accepted % kStepsBetween != 0) continue;
      begin_again();
      at_point();
    }
    ++completed_;
    if (left > 1) begin_again();
  }
  return true;
}

void CycleRun::pass_on(const SampleBlock& block) {
  append_samples(*file_, *model_, bodies_, block);
  if (span_.cycles == 1) {
    if (next_) next_->add(block);
    if (before_) before_->add(block);
    return;
  }
  const int64_t cycle = sample_count(span_.cycle, output_step_) - 1;
  const int64_t end = span_.cycles * cycle, last = end - cycle;
  if (next_) next_->add(block.between(last - cycle, last));
  if (block.first + block.count <= last) return;
  if (!before_) compare_with(std::exchange(next_, std::nullopt)->take_samples());
  before_->add(block.between(last, end));
}

Checkpoint CycleRun::here() const {
  Checkpoint point;
  point.cycle = completed_;
  point.state = method_->state();
  point.rung = method_->rung();
  for (int e = 0; e < model_->system.elements(); ++e)
    point.elements.push_back(model_->system.element(e).save());
  point.energy = energy_.save();
  return point;
}

Checkpoint CycleRun::next() const {
  Checkpoint point = here();
  if (scene_.time.settle > 0.0) settle(point);
  return point;
}

Checkpoint CycleRun::within() {
  Checkpoint point = here();
  Archive recorded;
  archive(recorded);
  point.recorded = std::move(recorded).numbers();
  return point;
}

void CycleRun::settle(Checkpoint& point) const {
  if (const auto mounted = MountedMotion::of(*model_, span_.end)) {
    const double moved = mounted->predict(begin_, span_.end - span_.begin, point.state);
    say(fmt::format("  settle_to: engine shifted by {:.3g} um on its mounts", moved / kMicro));
  }
  point.state.time = span_.begin;
}

void CycleRun::commit(const Checkpoint& point, const std::string& mark) {
  std::optional<CheckpointFile> file = std::exchange(next_, std::nullopt);
  if (!file) file.emplace(point_);
  if (!point.recorded.empty()) file->copy(*file_);
  file->commit(point, mark);
}

void CycleRun::write_end() {
  if (scene_.clock) dynamics::write_end(*file_, *model_, method_->state());
}

double CycleRun::change() const {
  if (!before_) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const auto& [body, value] : before_->difference().velocity)
    largest = std::max(largest, value);
  return largest;
}

void CycleRun::report(RunResult& result) const {
  result.energy_residue = energy_.residue(method_->weights().least_energy());
  result.energy_imbalance = energy_.imbalance();
  result.oil.reset();
  result.energy_exchanged = energy_.exchanged();
  result.periodicity = before_ ? before_->difference() : CycleDifference{};
  result.samples = recorder_.samples();
  result.most_held = std::max(result.most_held, most_held_);
  result.warnings = accuracy_warnings(method_->estimate().bodies(method_->weights()),
                                      scene_.steps.accuracy, method_->estimate().steps());
  for (const std::string& warning : pressure_.warnings()) result.warnings.push_back(warning);
  for (const auto& [name, contact] : contacts_of(*model_)) {
    const auto oil = contact->oil_balance();
    if (oil && (!result.oil || oil->residue() > result.oil->residue())) result.oil = oil;
  }
  result.creep.reset();
  for (int e = 0; e < model_->system.elements(); ++e) {
    const ForceElement& element = model_->system.element(e);
    const std::optional<double> crept = element.crept();
    if (!crept) continue;
    result.creep = std::max(result.creep.value_or(0.0), *crept);
    if (*crept > kLongestCreep) result.warnings.push_back(creep_text(element.name(), *crept));
  }
  for (const auto& component : model_->components)
    for (const std::string& warning : component->warnings()) result.warnings.push_back(warning);
}

}  // namespace clatter::dynamics
