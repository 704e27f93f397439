// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/run_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <vector>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/run/run_layout.hpp"
#include "dynamics/run/cycle_run.hpp"
#include "dynamics/run/start_state.hpp"

namespace clatter::dynamics {
namespace {

/// Counts and seconds of some steps, of which multiples and sums are taken.
struct StepCost {
  double accepted = 0.0, by_error = 0.0, by_newton = 0.0, refused = 0.0, stages = 0.0;
  double evaluations = 0.0, factorizations = 0.0;
  double elements = 0.0, factors = 0.0, total = 0.0;  // [s], without operators
  double processor = 0.0;                             // [s], of all threads
  std::vector<double> element_seconds, element_evaluations;

  void add(double factor, const StepCost& other) {
    for (double StepCost::*number :
         {&StepCost::accepted, &StepCost::by_error, &StepCost::by_newton, &StepCost::refused,
          &StepCost::stages, &StepCost::evaluations, &StepCost::factorizations, &StepCost::elements,
          &StepCost::factors, &StepCost::total, &StepCost::processor})
      this->*number += factor * (other.*number);
    element_seconds.resize(other.element_seconds.size());
    element_evaluations.resize(other.element_evaluations.size());
    for (size_t e = 0; e < element_seconds.size(); ++e) {
      element_seconds[e] += factor * other.element_seconds[e];
      element_evaluations[e] += factor * other.element_evaluations[e];
    }
  }
};

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// All that a method and the elements of its system have cost so far.
StepCost cost_so_far(const Integrator& method, const System& system) {
  const StepStatistics& s = method.statistics();
  StepCost cost;
  cost.accepted = static_cast<double>(s.accepted);
  cost.by_error = static_cast<double>(s.rejected_error);
  cost.by_newton = static_cast<double>(s.rejected_newton);
  cost.refused = static_cast<double>(s.rejected_refused);
  cost.stages = static_cast<double>(s.stages);
  cost.evaluations = static_cast<double>(s.evaluations);
  cost.factorizations = static_cast<double>(s.factorizations);
  cost.elements = s.element_seconds;
  cost.factors = s.factor_seconds;
  cost.total = s.total_seconds - s.operator_seconds;
  cost.processor = processor_seconds() - s.operator_seconds;
  for (const ElementCost& element : system.costs()) {
    cost.element_seconds.push_back(element.seconds);
    cost.element_evaluations.push_back(static_cast<double>(element.evaluations));
  }
  return cost;
}

StepOptions coarse_steps(const Scene& scene, double span, int coarser) {
  StepOptions options = scene.steps;
  options.accuracy.tolerance *= coarser * coarser * coarser;
  options.largest = std::min(options.largest * coarser, 0.01 * span);
  return options;
}

/// The first cycle of a scene, integrated by two methods in turns.
class Probe {
 public:
  Probe(const Scene& scene, const LoadedBodies& bodies, const ProbeLimits& limits)
      : limits_(limits),
        cycles_(most_cycles(scene)),
        models_(cycles_ - scene.time.recorded + 1),
        span_(scene.clock ? scene.clock->cycle() : scene.time.end - scene.time.begin),
        begin_(scene.time.begin),
        model_(build_model(scene, bodies)),
        fine_(make_integrator(model_->system, scene.steps)),
        coarse_(make_integrator(model_->system, coarse_steps(scene, span_, limits.coarser))) {
    const ModalStart at = first_state(scene, bodies, *model_);
    coarse_->start(begin_, at.eta, at.v);
    // A rung of the ladder of steps is a factor of 2^(1/2).
    const double ratio =
        limits.coarser * scene.steps.largest / coarse_steps(scene, span_, limits.coarser).largest;
    finer_ = static_cast<int>(std::lround(2.0 * std::log2(ratio)));
  }

  /// Sections until all are done, the limits are reached, or one fails.
  void run() {
    const double first = processor_seconds(), section = span_ / limits_.sections;
    for (done_ = 0; done_ < limits_.sections; ++done_) {
      const double spent = processor_seconds() - first;
      if (done_ > 0 && spent > std::max(limits_.seconds, limits_.of_run * total_seconds())) return;
      try {
        integrate(begin_ + done_ * section, section);
      } catch (const NumericsError& error) {
        if (done_ == 0) throw;
        failure_ = error.what();
        return;
      }
    }
  }

  RunForecast forecast(const Scene& scene) const {
    RunForecast made;
    made.effects = model_->effects;
    const StepCost all = scaled();
    const auto& costs = model_->system.costs();
    for (size_t e = 0; e < costs.size(); ++e)
      if (!made.effects.charge(costs[e].name, all.element_seconds[e],
                               std::llround(all.element_evaluations[e])))
        made.other_seconds += all.element_seconds[e];
    StepStatistics& s = made.statistics;
    s.accepted = std::llround(all.accepted);
    s.rejected_error = std::llround(all.by_error);
    s.rejected_newton = std::llround(all.by_newton);
    s.rejected_refused = std::llround(all.refused);
    s.stages = std::llround(all.stages);
    s.evaluations = std::llround(all.evaluations);
    s.factorizations = std::llround(all.factorizations);
    s.element_seconds = all.elements;
    s.factor_seconds = all.factors;
    s.operators = models_ * fine_->statistics().operators;
    s.operator_seconds = models_ * fine_->statistics().operator_seconds;
    s.total_seconds = all.total + s.operator_seconds;
    made.processor_seconds = all.processor;
    made.source = text(scene);
    return made;
  }

 private:
  /// One section: coarse, then with the steps of the run, the first of which are not counted.
  void integrate(double from, double length) {
    const double end = begin_ + span_;
    const auto advance = [end](Integrator& method, int least, double until) {
      for (int k = 0; k < least || method.state().time < until; ++k) {
        if (method.state().time >= end) return;
        method.step(end);
      }
    };
    const double counted_from = from + (1.0 - limits_.share) * length;
    advance(*coarse_, 0, counted_from - limits_.settle * length);
    fine_->resume(coarse_->state(), std::max(0, coarse_->rung() + finer_));
    advance(*fine_, limits_.least_steps / 2, counted_from);
    const double start = fine_->state().time;
    const StepCost before = cost_so_far(*fine_, model_->system);
    advance(*fine_, limits_.least_steps, from + length);
    StepCost counted = cost_so_far(*fine_, model_->system);
    counted.add(-1.0, before);
    const double covered = fine_->state().time - start;
    if (covered > 0.0) {
      sections_.add(length / covered, counted);
      ++counted_;
    }
    coarse_->resume(fine_->state(), std::max(0, fine_->rung() - finer_));
  }

  /// Of the entire run.
  StepCost scaled() const {
    StepCost all;
    all.add(static_cast<double>(limits_.sections) / std::max(counted_, 1) * cycles_, sections_);
    return all;
  }
  double total_seconds() const { return scaled().total; }

  std::string text(const Scene& scene) const {
    const double part = static_cast<double>(done_) / limits_.sections;
    std::string what = scene.clock ? fmt::format("{:.0f} of 720 deg", 720.0 * part)
                                   : fmt::format("{:.3g} of {:.3g} s", span_ * part, span_);
    what = fmt::format("a probe of {}, a tenth of it counted with the steps of the run", what);
    if (!failure_.empty()) what += fmt::format(" (it ended there: {})", failure_);
    if (cycles_ > 1)
      what += fmt::format("; each of {}{} cycles is taken as the first one",
                          scene.time.settle > 0.0 ? "at most " : "", cycles_);
    return what;
  }

  ProbeLimits limits_;
  int cycles_, models_;  // the recorded cycles share a model
  double span_, begin_;
  std::unique_ptr<Model> model_;
  std::unique_ptr<Integrator> fine_, coarse_;
  int finer_ = 0;  // rungs from the coarse ladder's to a step of the run
  StepCost sections_;
  int done_ = 0, counted_ = 0;
  std::string failure_;
};

/// The run at `path` is complete and of this scene, with the same inputs.
bool is_run_of(const Scene& scene, const H5File& file) {
  if (file.get_int("/", run::kComplete) != 1) return false;
  if (file.get_string("/", "config") != scene.resolved) return false;
  std::vector<std::string> expected;
  for (const auto& input : scene.inputs)
    if (input.extension() != ".toml") expected.push_back(sha256_of_file(input));
  const auto paths = file.read_strings("inputs/path"), hashes = file.read_strings("inputs/sha256");
  std::vector<std::string> found;
  for (size_t i = 0; i < paths.size(); ++i)
    if (std::filesystem::path(paths[i]).extension() != ".toml") found.push_back(hashes[i]);
  return found == expected;
}

StepStatistics statistics_of(const H5File& file) {
  const auto count = [&](const char* name) { return file.get_int("statistics", name); };
  const auto seconds = [&](const char* name) { return file.get_double("statistics", name); };
  StepStatistics s;
  s.accepted = count("accepted");
  s.rejected_error = count("rejected_error");
  s.rejected_newton = count("rejected_newton");
  s.rejected_refused = count("rejected_refused");
  s.stages = count("stages");
  s.evaluations = count("evaluations");
  s.factorizations = count("factorizations");
  s.operators = count("operators");
  s.element_seconds = seconds("element_seconds");
  s.factor_seconds = seconds("factor_seconds");
  s.operator_seconds = seconds("operator_seconds");
  s.total_seconds = seconds("total_seconds");
  return s;
}

}  // namespace

RunForecast probe_run(const Scene& scene, const LoadedBodies& bodies, const ProbeLimits& limits) {
  Probe probe(scene, bodies, limits);
  probe.run();
  return probe.forecast(scene);
}

std::optional<RunForecast> measured_run(const Scene& scene, const Model& model,
                                        const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  const H5File file = open_artefact(path, run::kSchema);
  if (!is_run_of(scene, file)) return std::nullopt;
  RunForecast made;
  made.effects = model.effects;
  made.statistics = statistics_of(file);
  const auto names = file.read_strings("effects/name");
  const auto seconds = file.read_doubles("effects/seconds");
  if (names.size() != made.effects.effects().size()) return std::nullopt;
  made.other_seconds = made.statistics.element_seconds;
  for (const ElementCost& element : model.system.costs())
    made.effects.charge(element.name, 0.0, made.statistics.evaluations);
  for (size_t i = 0; i < names.size(); ++i) {
    if (names[i] != made.effects.effects()[i].name) return std::nullopt;
    made.effects.set_seconds(i, seconds[i]);
    made.other_seconds -= seconds[i];
  }
  made.other_seconds = std::max(0.0, made.other_seconds);
  made.source = fmt::format("the run of the same scene and inputs, {}", path.string());
  return made;
}

}  // namespace clatter::dynamics
