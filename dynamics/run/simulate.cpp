// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/progress.hpp"
#include "dynamics/run/film_pressure.hpp"
#include "dynamics/run/periodicity.hpp"
#include "dynamics/run/recorder.hpp"
#include "dynamics/run/run_file.hpp"

namespace clatter::dynamics {
namespace {

struct Span {
  double begin, end;
};

Span cycle_span(const Scene& scene, int cycle) {
  if (!scene.clock) return {scene.time.begin, scene.time.end};
  const double length = scene.clock->cycle();
  const double begin = scene.time.end - length * (scene.time.cycles - cycle);
  return {begin, cycle + 1 == scene.time.cycles ? scene.time.end : begin + length};
}

int cycles_of(const Scene& scene) { return scene.clock ? scene.time.cycles : 1; }

Checkpoint first_state(const Scene& scene) {
  Checkpoint point;
  point.state.time = scene.time.begin;
  return point;
}

/// One cycle from a checkpoint with a newly built model and a new run file.
class CycleRun {
 public:
  CycleRun(const Scene& scene, const LoadedBodies& bodies, const Checkpoint& from,
           const std::filesystem::path& output)
      : bodies_(bodies),
        span_(cycle_span(scene, from.cycle)),
        model_(build_model(scene, bodies)),
        file_(std::make_unique<H5File>(H5File::create(output))),
        energy_(model_->system, *scene.steps.method),
        method_(make_integrator(model_->system, scene.steps)),
        recorder_(*model_, {span_.begin, span_.end, scene.time.output_step, scene.film_every},
                  *file_, [this](const SampleBlock& block) { pass_on(block); }) {
    method_->set_observer(&energy_);
    const std::filesystem::path point = checkpoint_path(output);
    if (from.cycle == 0) {
      method_->start(span_.begin, model_->system.eta_start(), model_->system.v_start());
    } else {
      from_checkpoint(point, [&] {
        restore(from);
        before_.emplace(*model_, H5File::open(point),
                        sample_count(span_.end - span_.begin, scene.time.output_step));
      });
    }
    if (from.cycle + 1 < cycles_of(scene)) next_.emplace(point);
  }
  CycleRun(const CycleRun&) = delete;
  CycleRun& operator=(const CycleRun&) = delete;

  /// False when it was stopped before the end.
  bool run(const std::function<void(double)>& progress, const std::atomic<bool>* stop) {
    recorder_.start(method_->state());
    while (method_->state().time < span_.end) {
      if (stop != nullptr && stop->load()) return false;
      method_->step(span_.end);
      recorder_.record(method_->previous(), method_->state(), energy_);
      pressure_.look(*model_, recorder_.last(), method_->state().time);
      most_held_ = std::max(most_held_, recorder_.held());
      progress(method_->state().time);
    }
    return true;
  }

  /// Writes what is left, at the end of the cycle or earlier.
  void finish() { recorder_.finish(); }

  Checkpoint state(int cycle) const {
    Checkpoint point;
    point.cycle = cycle;
    point.state = method_->state();
    point.rung = method_->rung();
    for (int e = 0; e < model_->system.elements(); ++e) {
      point.elements.push_back(model_->system.element(e).save());
    }
    point.energy = energy_.save();
    return point;
  }
  /// Writes the checkpoint of a cycle that another one follows.
  void commit(const Checkpoint& point, const std::string& mark) {
    if (next_) next_->commit(point, mark);
  }

  Span span() const { return span_; }
  const StepStatistics& statistics() const { return method_->statistics(); }
  /// Adds what this cycle reports, except of its end and its model.
  void report(RunResult& result, const Accuracy& accuracy) const {
    result.energy_residue = energy_.residue();
    result.energy_exchanged = energy_.now().exchanged;
    result.periodicity = before_ ? before_->difference() : CycleDifference{};
    result.samples = recorder_.samples();
    result.most_held = std::max(result.most_held, most_held_);
    result.warnings = accuracy_warnings(method_->estimate().bodies(method_->weights()), accuracy,
                                        method_->estimate().steps());
    for (const std::string& warning : pressure_.warnings()) result.warnings.push_back(warning);
  }
  const Model& model() const { return *model_; }
  std::unique_ptr<Model> model_out() { return std::move(model_); }
  std::unique_ptr<H5File> file_out() { return std::move(file_); }

 private:
  void restore(const Checkpoint& from) {
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
    for (int e = 0; e < system.elements(); ++e)
      model_->system.element(e).restore(from.elements[static_cast<size_t>(e)]);
    energy_.restore(from.energy, from.state.time);
    method_->resume(from.state, from.rung);
  }

  void pass_on(const SampleBlock& block) {
    append_samples(*file_, *model_, bodies_, block);
    if (next_) next_->add(block);
    if (before_) before_->add(block);
  }

  const LoadedBodies& bodies_;
  Span span_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<H5File> file_;
  EnergyBalance energy_;
  std::unique_ptr<Integrator> method_;
  Recorder recorder_;
  std::optional<CycleComparison> before_;
  std::optional<CheckpointFile> next_;
  FilmPressureWatch pressure_;
  int64_t most_held_ = 0;
};

std::map<std::string, double> seconds_by_element(const Model& model) {
  std::map<std::string, double> seconds;
  for (const auto& cost : model.system.costs()) seconds[cost.name] += cost.seconds;
  return seconds;
}

}  // namespace

RunResult simulate(const Scene& scene, const LoadedBodies& bodies, const RunControl& control) {
  RunResult result;
  Checkpoint point = control.resume_from ? *control.resume_from : first_state(scene);
  const int cycles = cycles_of(scene);
  const std::string mark = cycles > 1 ? fingerprint(scene) : "";
  const double factor = scene.clock ? scene.clock->speed * 180.0 / std::numbers::pi : 1.0;
  Progress progress(control.label, factor * (scene.time.end - scene.time.begin),
                    scene.clock ? "deg" : "s");
  std::map<std::string, double> seconds;
  while (point.cycle < cycles) {
    result.file.reset();  // of the cycle before: the next one takes its name
    CycleRun cycle(scene, bodies, point, control.output);
    const Span span = cycle.span();
    bool finished = false;
    try {
      finished = cycle.run([&](double t) { progress.update(factor * (t - scene.time.begin)); },
                           control.stop);
    } catch (const NumericsError& error) {
      result.failure = error.what();
    }
    cycle.finish();
    result.statistics = point.statistics;
    result.statistics += cycle.statistics();
    for (const auto& [name, value] : seconds_by_element(cycle.model())) seconds[name] += value;
    cycle.report(result, scene.steps.accuracy);
    if (finished) {
      result.cycles = point.cycle + 1;
      point = cycle.state(result.cycles);
      point.statistics = result.statistics;
      say(fmt::format("cycle {} of {}: {:.6g} to {:.6g} {}, {} steps so far, energy residue {:.2e}",
                      result.cycles, cycles, span.begin * factor, span.end * factor,
                      scene.clock ? "deg" : "s", result.statistics.accepted,
                      result.energy_residue));
      cycle.commit(point, mark);
    }
    result.complete = finished && result.cycles == cycles;
    result.file = cycle.file_out();
    result.model = cycle.model_out();
    if (!finished) break;
  }
  for (const auto& [name, value] : seconds) result.model->effects.charge(name, value);
  return result;
}

}  // namespace clatter::dynamics
