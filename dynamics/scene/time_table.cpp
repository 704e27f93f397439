// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/time_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kMostSamples = 1e9;       // of a span: 8 GB for one column of the file
constexpr double kTimeResolution = 1e-15;  // of a span: steps below do not advance a double
constexpr double kRounding = 1e-9;         // of a bound that is converted between units

/// A number, given or by default, that another setting bounds. `given` [s], all others [us].
double within(const Config& table, const char* key, const std::optional<double>& given,
              double fallback, double min, double max) {
  const double value = given ? *given / kMicro : fallback;
  if (!(value >= min * (1.0 - kRounding) && value <= max * (1.0 + kRounding)))
    table.fail(key, fmt::format("found {:g}{}, expected at least {:.3g} and at most {:.3g}", value,
                                given ? "" : " (default)", min, max));
  return given.value_or(fallback * kMicro);
}

/// A cycle, or the entire run.
double cycle_or_run(const Scene& scene) {
  return scene.clock ? scene.clock->cycle() : scene.time.end - scene.time.begin;
}

void read_output(const Config& time, TimeTable& table, Scene& scene) {
  const double span_us = cycle_or_run(scene) / kMicro;
  const double least_us = scene.time.recorded * span_us / kMostSamples;
  scene.time.output_step =
      within(time, "output_step_us", table.output_step, std::min(20.0, span_us), least_us, span_us);
  table.output_step = scene.time.output_step;
  if (scene.clock) scene.film_every = table.film_every / scene.clock->speed;
  scene.time.output_step_where = time.where("output_step_us");
  scene.time.film_every_where = time.where("film_every_deg");
}

/// Cycles of the clock.
void read_cycles(const Config& root, const Config& time, TimeTable& table, Scene& scene) {
  const bool settles = table.settle > 0.0;
  table.cycles = static_cast<int>(
      time.integer_or("cycles", settles ? 30 : 2, Range::between(settles ? 2.0 : 1.0, 1000.0)));
  // An engine starts at its ideal places and loads grow from nothing; other scenes start in the
  // state that they are given.
  const double rest = table.start.empty() && root.has("engine") ? 60.0 * kDegree : 0.0;
  table.ramp = table.ramp.value_or(rest);
  scene.time.settle = table.settle;
  scene.time.cycles = *table.cycles;
  scene.time.recorded = table.recorded;
  if (table.recorded > *table.cycles)
    time.fail("record_cycles",
              fmt::format("found {}, expected at most cycles, {}", table.recorded, *table.cycles));
  scene.time.start = table.start;
  const double omega = scene.clock->speed;
  // While it settles each cycle has the same times; what repeats each cycle allows that.
  const int before = settles ? 0 : scene.time.cycles - 1;
  scene.time.begin = -(2.0 + 4.0 * before) * std::numbers::pi / omega;
  scene.time.end = 2.0 * std::numbers::pi / omega;
  scene.time.ramp = *table.ramp / omega;
}

}  // namespace

const Keys<TimeTable>& time_keys() {
  static const Keys<TimeTable> keys(
      "time", "span, cycles, output and steps of a run", [](auto& key, TimeTable& time) {
        key.number("end_s", time.end, Range::between(1e-9, 1e9),
                   "end of a run without an engine or cycle_of, which begins at 0")
            .excludes("cycle_of", "it has cycles");
        key.text(
            "cycle_of", time.cycle_of,
            "the [[drive]] with speed_rpm whose cycles of 720 deg a run without an engine has");
        key.integer("cycles", time.cycles, Range::between(1.0, 1000.0),
                    "cycles, of which the last record_cycles are reported: 2 without it; with "
                    "settle_to the most, 30 without it");
        key.integer("record_cycles", time.recorded, Range::between(1.0, 1000.0),
                    "so many of the last cycles are recorded, as one span; checkpoints are written "
                    "before it only")
            .excludes("settle_to", "a run that settles ends with the first cycle that repeats");
        key.number("settle_to", time.settle, Range::between(1e-9, 1.0),
                   "further cycles, until the velocities of each body differ by no more than this "
                   "part from those of the cycle before");
        key.path("start_from", time.start, "run file at whose end this run starts");
        key.number("ramp_deg", time.ramp, Range::between(0.0, 360.0),
                   "loads grow from zero over this angle at the start: 60 of an engine, 0 with "
                   "start_from and without an engine");
        key.number("output_step_us", time.output_step, Range::positive(),
                   "between samples of the bodies' motion: 20 without it; histories and energies "
                   "have a row "
                   "for each step of the integration");
        key.number("film_every_deg", time.film_every, Range::between(0.0, 720.0),
                   "between fields of films; 0: none");
        key.choice("method", time.method,
                   {{"sdirk2", &sdirk2()},
                    {"tr-bdf2", &tr_bdf2()},
                    {"predictor-corrector", &predictor_corrector()}},
                   "of integration: sdirk2 with an oil film, else tr-bdf2 without it");
        key.flag("exact_modes", time.exact_modes,
                 "free modes move exactly: true of methods of two stages without it");
        key.number("largest_step_us", time.largest_step, Range::positive(),
                   "largest step: 1 deg of the crank, or 1 % of the span without it");
        key.number("smallest_step_us", time.smallest_step, Range::positive(),
                   "step below which a run ends with an error: 1e-4 without it");
        key.check([](const Config& table, TimeTable& found) {
          const double every = found.film_every / kDegree;
          if (every > 0.0 && every < 0.01)
            table.fail(
                "film_every_deg",
                fmt::format("found {:g}, expected 0 (no film fields) or at least 0.01", every));
          if (!found.start.empty() && !std::filesystem::exists(found.start))
            table.fail("start_from",
                       fmt::format("found \"{}\", which does not exist, expected a run file",
                                   found.start.string()));
        });
      });
  return keys;
}

const Keys<Accuracy>& accuracy_keys() {
  static const Keys<Accuracy> keys(
      "accuracy", "what the error test of the steps refers to", [](auto& key, Accuracy& accuracy) {
        const Range any = Range::between(1e-9, 1e12);
        key.number("tolerance", accuracy.tolerance, Range::between(1e-12, 1.0),
                   "error of a step over the scales below");
        key.number("displacement_um", accuracy.displacement_scale, kDisplacementScaleUm,
                   "scale of displacements at interfaces, and so of gaps");
        key.number("velocity_m_s", accuracy.velocity_scale, kVelocityScale,
                   "scale of the velocities of bodies as rigid ones");
        key.number("arm_mm", accuracy.arm, Range::between(1e-3, 1e5),
                   "arm that makes displacements of rotations");
        key.number("force_n", accuracy.force_scale, any,
                   "scale of the forces of elements, which are not tested without it");
        key.number("acceleration_m_s2", accuracy.acceleration_scale, any,
                   "scale of the accelerations of bodies, which are not tested without it");
      });
  return keys;
}

TimeTable read_time(const Config& root, Scene& scene) {
  const Config time = root.table("time");
  TimeTable table = time_keys().read(time);
  if (scene.clock) {
    if (table.end)
      time.fail("end_s", "end_s and [engine] exclude each other: a run with an engine has cycles");
    read_cycles(root, time, table, scene);
  } else {
    for (const char* key :
         {"cycles", "record_cycles", "settle_to", "start_from", "ramp_deg", "film_every_deg"})
      if (time.has(key)) time.fail(key, "needs [engine], or cycle_of: a run without has no cycles");
    if (!table.end) time.fail("end_s", "found nothing, expected a number above 0");
    scene.time.end = *table.end;
  }
  read_output(time, table, scene);
  return table;
}

void read_steps(const Config& root, TimeTable table, Scene& scene) {
  const Config time = root.table("time");
  const double span = cycle_or_run(scene), whole = scene.time.end - scene.time.begin;
  const bool has_film =
      std::any_of(scene.components.begin(), scene.components.end(),
                  [](const auto& component) { return component->traits().has_film; });
  StepOptions& steps = scene.steps;
  steps.method = table.method.value_or(has_film ? &sdirk2() : &tr_bdf2());
  steps.exact_modes = table.exact_modes.value_or(steps.method->stages == 2);
  if (steps.exact_modes && steps.method->stages != 2)
    time.fail("exact_modes", fmt::format("found true with method \"{}\", expected one of two "
                                         "stages, \"sdirk2\" or \"tr-bdf2\"",
                                         steps.method->name));
  const double largest_us = (scene.clock ? span / 720.0 : span / 100.0) / kMicro;
  const double resolved_us = kTimeResolution * whole / kMicro, span_us = span / kMicro;
  steps.largest =
      within(time, "largest_step_us", table.largest_step, largest_us, resolved_us, span_us);
  steps.smallest = within(time, "smallest_step_us", table.smallest_step,
                          std::min(1e-4, 1e-3 * largest_us), resolved_us, span_us);
  if (!(steps.smallest < steps.largest))
    time.fail("smallest_step_us",
              fmt::format("found {:g}, expected less than largest_step_us, {:g}",
                          steps.smallest / kMicro, steps.largest / kMicro));
  steps.first = std::min(1e-7, 1e-3 * steps.largest);
  if (const auto accuracy = root.find_table("accuracy"))
    accuracy_keys().read(*accuracy, steps.accuracy);
  // Once more, so that the resolved scene has the defaults that follow from others.
  table.method = steps.method;
  table.exact_modes = steps.exact_modes;
  table.largest_step = steps.largest;
  table.smallest_step = steps.smallest;
  time_keys().read(time, table);
}

}  // namespace clatter::dynamics
