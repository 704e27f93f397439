// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/simulate.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/progress.hpp"
#include "dynamics/run/periodicity.hpp"

namespace clatter::dynamics {
namespace {

struct Span {
  double begin, end;
};

Span cycle_span(const Scene& scene, int cycle) {
  if (!scene.engine) return {scene.time.begin, scene.time.end};
  const double length = 4.0 * std::numbers::pi / scene.engine->speed;
  const double begin = scene.time.end - length * (scene.time.cycles - cycle);
  return {begin, cycle + 1 == scene.time.cycles ? scene.time.end : begin + length};
}

Checkpoint first_state(const Scene& scene) {
  Checkpoint point;
  point.state.time = scene.time.begin;
  return point;
}

/// One cycle from a checkpoint with a newly built model.
class CycleRun {
 public:
  CycleRun(const Scene& scene, const LoadedBodies& bodies, const Checkpoint& from,
           double film_every)
      : span_(cycle_span(scene, from.cycle)),
        model_(build_model(scene, bodies)),
        energy_(model_->system, *scene.steps.method),
        method_(make_integrator(model_->system, scene.steps)),
        recorder_(std::make_unique<Recorder>(*model_, span_.begin, span_.end,
                                             scene.time.output_step, film_every)) {
    method_->set_observer(&energy_);
    if (from.cycle == 0) {
      const Eigen::VectorXd rest = Eigen::VectorXd::Zero(model_->system.modes());
      method_->start(span_.begin, rest, rest);
    } else {
      for (int e = 0; e < model_->system.elements(); ++e) {
        model_->system.element(e).restore(from.elements[static_cast<size_t>(e)]);
      }
      energy_.restore(from.energy, from.state.time);
      method_->resume(from.state, from.rung);
    }
  }

  /// False when it was stopped before the end.
  bool run(const std::function<void(double)>& progress, const std::atomic<bool>* stop) {
    recorder_->start(method_->state());
    while (method_->state().time < span_.end) {
      if (stop != nullptr && stop->load()) return false;
      method_->step(span_.end);
      recorder_->record(*model_, method_->previous(), method_->state(), energy_);
      progress(method_->state().time);
    }
    return true;
  }

  Checkpoint checkpoint(int cycle) const {
    Checkpoint point;
    point.cycle = cycle;
    point.state = method_->state();
    point.rung = method_->rung();
    for (int e = 0; e < model_->system.elements(); ++e) {
      point.elements.push_back(model_->system.element(e).save());
    }
    point.energy = energy_.save();
    point.eta = recorder_->samples().eta();
    point.v = recorder_->samples().v();
    return point;
  }

  Span span() const { return span_; }
  const StepStatistics& statistics() const { return method_->statistics(); }
  const EnergyBalance& energy() const { return energy_; }
  std::vector<std::string> warnings(const Accuracy& accuracy) const {
    return accuracy_warnings(method_->estimate().bodies(method_->weights()), accuracy,
                             method_->estimate().steps());
  }
  std::unique_ptr<Model> model_out() { return std::move(model_); }
  std::unique_ptr<Recorder> recorder_out() { return std::move(recorder_); }
  const Model& model() const { return *model_; }
  const Recorder& recorder() const { return *recorder_; }

 private:
  Span span_;
  std::unique_ptr<Model> model_;
  EnergyBalance energy_;
  std::unique_ptr<Integrator> method_;
  std::unique_ptr<Recorder> recorder_;
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
  const int cycles = scene.engine ? scene.time.cycles : 1;
  const double factor = scene.engine ? scene.engine->speed * 180.0 / std::numbers::pi : 1.0;
  Progress progress(control.label, factor * (scene.time.end - scene.time.begin),
                    scene.engine ? "deg" : "s");
  std::map<std::string, double> seconds;
  while (point.cycle < cycles) {
    CycleRun cycle(scene, bodies, point, control.film_every);
    const Span span = cycle.span();
    bool finished = false;
    try {
      finished = cycle.run([&](double t) { progress.update(factor * (t - scene.time.begin)); },
                           control.stop);
    } catch (const NumericsError& error) {
      result.failure = error.what();
    }
    result.statistics = point.statistics;
    result.statistics += cycle.statistics();
    for (const auto& [name, value] : seconds_by_element(cycle.model())) seconds[name] += value;
    result.energy_residue = cycle.energy().residue();
    result.energy_exchanged = cycle.energy().now().exchanged;
    result.warnings = cycle.warnings(scene.steps.accuracy);
    result.periodicity =
        cycle_difference(cycle.model(), cycle.recorder().samples(), point.eta, point.v);
    if (finished) {
      result.cycles = point.cycle + 1;
      const StepStatistics total = result.statistics;
      point = cycle.checkpoint(result.cycles);
      point.statistics = total;
      say(fmt::format("cycle {} of {}: {:.6g} to {:.6g} {}, {} steps so far, energy residue {:.2e}",
                      result.cycles, cycles, span.begin * factor, span.end * factor,
                      scene.engine ? "deg" : "s", total.accepted, result.energy_residue));
      if (point.cycle < cycles && control.checkpoint) control.checkpoint(point);
    }
    result.complete = finished && result.cycles == cycles;
    result.recorder = cycle.recorder_out();
    result.model = cycle.model_out();
    if (!finished) break;
  }
  for (const auto& [name, value] : seconds) result.model->effects.charge(name, value);
  return result;
}

}  // namespace clatter::dynamics
