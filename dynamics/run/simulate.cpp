// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/progress.hpp"
#include "core/base/stopwatch.hpp"
#include "dynamics/run/cycle_run.hpp"

namespace clatter::dynamics {
namespace {

Checkpoint first_point(const Scene& scene) {
  Checkpoint point;
  point.state.time = scene.time.begin;
  return point;
}

std::map<std::string, double> seconds_by_element(const Model& model) {
  std::map<std::string, double> seconds;
  for (const auto& cost : model.system.costs()) seconds[cost.name] += cost.seconds;
  return seconds;
}

/// Checkpoints within a span, which take a small part of the time.
class Checkpoints {
 public:
  Checkpoints(const Scene& scene, double seconds) : scene_(scene), between_(seconds) {}

  /// Writes one where it is due. One that the disk does not take is left out with a warning.
  void look(CycleRun& run, const StepStatistics& before) {
    if (since_.seconds() < between_) return;
    const Stopwatch clock;
    Checkpoint point = run.within();
    point.statistics = before;
    point.statistics += run.statistics();
    try {
      run.commit(point, mark());
    } catch (const FileError& error) {
      warn(fmt::format("no checkpoint at {:.6g} s, the run goes on: {}", point.state.time,
                       error.what()));
    }
    between_ = std::max(between_, kSecondsBySecond * clock.seconds());
    since_ = Stopwatch();
  }
  /// Fingerprint of the scene.
  const std::string& mark() {
    if (mark_.empty()) mark_ = fingerprint(scene_);
    return mark_;
  }

 private:
  static constexpr double kSecondsBySecond = 20.0;  // of the run, by those for checkpoints
  const Scene& scene_;
  double between_;
  Stopwatch since_;
  std::string mark_;
};

/// Degrees of the crank, or seconds, in a second.
double per_second(const Scene& scene) {
  return scene.clock ? scene.clock->speed * 180.0 / std::numbers::pi : 1.0;
}

bool is_settled(const Scene& scene, double change) {
  return scene.time.settle > 0.0 && change <= scene.time.settle;
}

/// "cycle 2 of 4: ..." of a span that was completed.
std::string cycle_text(const Scene& scene, const RunResult& result, Span span, double change) {
  const double factor = per_second(scene);
  const bool settles = scene.time.settle > 0.0;
  const int first = result.cycles - span.cycles + 1;
  const std::string which = span.cycles == 1 ? fmt::format("cycle {}", first)
                                             : fmt::format("cycles {} to {}", first, result.cycles);
  return fmt::format("{} of {}{}: {:.6g} to {:.6g} {}, {} steps so far, energy residue {:.2e}{}",
                     which, settles ? "at most " : "", most_cycles(scene), span.begin * factor,
                     span.end * factor, scene.clock ? "deg" : "s", result.statistics.accepted,
                     result.energy_residue,
                     settles && result.cycles > 1
                         ? fmt::format(", velocities {:.2g} off those of the cycle before", change)
                         : "");
}

std::string unsettled_text(const Scene& scene, double change) {
  return fmt::format(
      "not settled after {} cycles: the velocities of a body differ by {:.2g} of them from the "
      "cycle before, more than time.settle_to = {:g}; more cycles or more damping may help; dry "
      "contact may never repeat, its mean over cycles is by record_cycles instead of settle_to",
      scene.time.cycles, change, scene.time.settle);
}

}  // namespace

RunResult simulate(const Scene& scene, const LoadedBodies& bodies, const RunControl& control) {
  RunResult result;
  Checkpoint point = control.resume_from ? *control.resume_from : first_point(scene);
  const int cycles = most_cycles(scene);
  Checkpoints checkpoints(scene, control.checkpoint_seconds);
  const double factor = per_second(scene);
  const double length = scene.clock ? scene.clock->cycle() : scene.time.end - scene.time.begin;
  Progress progress(control.label, factor * length * cycles, scene.clock ? "deg" : "s");
  std::map<std::string, double> seconds;
  bool finished = true;
  while (finished && !result.complete) {
    result.file.reset();  // of the cycle before: the next one takes its name
    CycleRun cycle(scene, bodies, point, control.output);
    const Span span = cycle.span();
    finished = false;
    try {
      finished = cycle.run(
          [&](double t) { progress.update(factor * (point.cycle * length + t - span.begin)); },
          [&] { checkpoints.look(cycle, point.statistics); }, control.stop);
    } catch (const NumericsError& error) {
      result.failure = error.what();
    }
    cycle.finish();
    result.statistics = point.statistics;
    result.statistics += cycle.statistics();
    for (const auto& [name, value] : seconds_by_element(cycle.model())) seconds[name] += value;
    cycle.report(result);
    result.cycles = cycle.completed();
    if (finished) {
      const bool settled = is_settled(scene, cycle.change());
      result.complete = settled || result.cycles == cycles;
      say(cycle_text(scene, result, span, cycle.change()));
      if (!result.complete) {
        point = cycle.next();
        point.statistics = result.statistics;
        cycle.commit(point, checkpoints.mark());
      } else {
        cycle.write_end();
        if (scene.time.settle > 0.0 && !settled)
          result.warnings.push_back(unsettled_text(scene, cycle.change()));
      }
    }
    result.file = cycle.file_out();
    result.model = cycle.model_out();
  }
  for (const auto& [name, value] : seconds) result.model->effects.charge(name, value);
  return result;
}

}  // namespace clatter::dynamics
