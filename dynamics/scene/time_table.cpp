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

/// A number, given or by default, that another setting bounds.
double number_within(const Config& table, const char* key, double fallback, double min,
                     double max) {
  const double value = table.number_or(key, fallback, Range::positive());
  if (!(value >= min * (1.0 - kRounding) && value <= max * (1.0 + kRounding)))
    table.fail(key, fmt::format("found {:g}{}, expected at least {:.3g} and at most {:.3g}", value,
                                table.has(key) ? "" : " (default)", min, max));
  return value;
}

/// The span that is recorded: a cycle, or the entire run.
double recorded_span(const Scene& scene) {
  return scene.clock ? scene.clock->cycle() : scene.time.end - scene.time.begin;
}

void read_accuracy(const Config& table, Accuracy& accuracy) {
  accuracy.tolerance = table.number_or("tolerance", accuracy.tolerance, Range::between(1e-12, 1.0));
  accuracy.displacement_scale =
      table.number_or("displacement_um", accuracy.displacement_scale / kMicro,
                      kDisplacementScaleUm) *
      kMicro;
  accuracy.velocity_scale =
      table.number_or("velocity_m_s", accuracy.velocity_scale, kVelocityScale);
  accuracy.force_scale =
      table.has("force_n") ? table.number("force_n", Range::between(1e-9, 1e12)) : 0.0;
  accuracy.acceleration_scale = table.has("acceleration_m_s2")
                                    ? table.number("acceleration_m_s2", Range::between(1e-9, 1e12))
                                    : 0.0;
  accuracy.arm =
      table.number_or("arm_mm", accuracy.arm / kMilli, Range::between(1e-3, 1e5)) * kMilli;
}

std::filesystem::path read_start(const Config& time) {
  const std::filesystem::path path = time.path("start_from");
  if (!std::filesystem::exists(path))
    time.fail("start_from", fmt::format("found \"{}\", which does not exist, expected a run file",
                                        path.string()));
  return path;
}

void read_output(const Config& time, Scene& scene) {
  const double span_us = recorded_span(scene) / kMicro;
  scene.time.output_step = number_within(time, "output_step_us", std::min(20.0, span_us),
                                         span_us / kMostSamples, span_us) *
                           kMicro;
  scene.time.output_step_where = time.where("output_step_us");
  if (!scene.clock) return;
  const double film_deg = time.number_or("film_every_deg", 10.0, Range::between(0.0, 720.0));
  if (film_deg > 0.0 && film_deg < 0.01)
    time.fail("film_every_deg",
              fmt::format("found {:g}, expected 0 (no film fields) or at least 0.01", film_deg));
  scene.film_every = film_deg * kDegree / scene.clock->speed;
  scene.time.film_every_where = time.where("film_every_deg");
}

}  // namespace

void read_time(const Config& root, Scene& scene) {
  const Config time = root.table("time");
  if (!scene.clock) {
    scene.time.end = time.number("end_s", Range::between(1e-9, 1e9));
    read_output(time, scene);
    return;
  }
  if (time.has("settle_to"))
    scene.time.settle = time.number("settle_to", Range::between(1e-9, 1.0));
  const bool settles = scene.time.settle > 0.0;
  scene.time.cycles = static_cast<int>(
      time.integer_or("cycles", settles ? 30 : 2, Range::between(settles ? 2.0 : 1.0, 1000.0)));
  if (time.has("start_from")) scene.time.start = read_start(time);
  // An engine starts at its ideal places and loads grow from nothing; other scenes start in the
  // state that they are given.
  const double rest_deg = scene.time.start.empty() && root.has("engine") ? 60.0 : 0.0;
  const double ramp_deg = time.number_or("ramp_deg", rest_deg, Range::between(0.0, 360.0));
  const double omega = scene.clock->speed;
  // While it settles each cycle has the same times; what repeats each cycle allows that.
  const int before = settles ? 0 : scene.time.cycles - 1;
  scene.time.begin = -(2.0 + 4.0 * before) * std::numbers::pi / omega;
  scene.time.end = 2.0 * std::numbers::pi / omega;
  scene.time.ramp = ramp_deg * kDegree / omega;
  read_output(time, scene);
}

void read_steps(const Config& root, Scene& scene) {
  const double span = recorded_span(scene), whole = scene.time.end - scene.time.begin;
  const double largest_us = (scene.clock ? span / 720.0 : span / 100.0) / kMicro;
  const Config time = root.table("time");
  const std::string method =
      std::any_of(scene.components.begin(), scene.components.end(),
                  [](const auto& component) { return component->has_film(); })
          ? time.choice("method", {"sdirk2", "tr-bdf2", "predictor-corrector"})
          : time.choice("method", {"tr-bdf2", "sdirk2", "predictor-corrector"});
  for (const Tableau* known : {&sdirk2(), &tr_bdf2(), &predictor_corrector()})
    if (known->name == method) scene.steps.method = known;
  scene.steps.exact_modes = time.flag_or("exact_modes", scene.steps.method->stages == 2);
  if (scene.steps.exact_modes && scene.steps.method->stages != 2)
    time.fail("exact_modes", fmt::format("found true with method \"{}\", expected one of two "
                                         "stages, \"sdirk2\" or \"tr-bdf2\"",
                                         method));
  const auto step = [&](const char* key, double fallback) {
    const double resolved = kTimeResolution * whole / kMicro;
    return number_within(time, key, fallback, resolved, span / kMicro) * kMicro;
  };
  scene.steps.largest = step("largest_step_us", largest_us);
  scene.steps.smallest = step("smallest_step_us", std::min(1e-4, 1e-3 * largest_us));
  if (!(scene.steps.smallest < scene.steps.largest))
    time.fail("smallest_step_us",
              fmt::format("found {:g}, expected less than largest_step_us, {:g}",
                          scene.steps.smallest / kMicro, scene.steps.largest / kMicro));
  scene.steps.first = std::min(1e-7, 1e-3 * scene.steps.largest);
  if (const auto table = root.find_table("accuracy")) read_accuracy(*table, scene.steps.accuracy);
}

}  // namespace clatter::dynamics
