// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/options/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/base/error.hpp"

namespace clatter::recover {
namespace {

Span read_span(const Config& table, const Span& fallback) {
  Span span = fallback;
  span.in_seconds = table.has("from_s") || table.has("to_s");
  if (span.in_seconds) {
    span.from = table.number("from_s");
    span.to = table.number("to_s");
  } else {
    span.from = table.number_or("from_deg", fallback.from);
    span.to = table.number_or("to_deg", fallback.to);
  }
  if (!(span.to > span.from))
    table.fail(span.in_seconds ? "to_s" : "to_deg",
               fmt::format("found {:g}, expected more than {:g}", span.to, span.from));
  return span;
}

Eigen::Vector3d read_point(const Config& table, const char* key) {
  return Eigen::Vector3d::Map(table.numbers(key, size_t{3}).data());
}

Quantities read_quantities(const Config& table, const Quantities& fallback) {
  Quantities chosen{false, false, false, false};
  const std::pair<const char*, bool Quantities::*> all[] = {
      {"displacement", &Quantities::displacement},
      {"velocity", &Quantities::velocity},
      {"acceleration", &Quantities::acceleration},
      {"normal_velocity", &Quantities::normal_velocity}};
  const std::vector<std::string> names = table.texts_or("quantities", names_of(fallback));
  if (names.empty()) table.fail("quantities", "found none, expected at least one");
  for (const std::string& name : names) {
    const auto* const at = std::find_if(std::begin(all), std::end(all),
                                        [&](const auto& entry) { return name == entry.first; });
    if (at == std::end(all))
      table.fail("quantities", "found \"" + name +
                                   "\", expected displacement, velocity, acceleration or "
                                   "normal_velocity");
    chosen.*(at->second) = true;
  }
  return chosen;
}

void read_frames(const Config& table, FrameRule& frames) {
  frames.on = table.flag_or("on", frames.on);
  frames.span = read_span(table, frames.span);
  if (frames.span.in_seconds)
    frames.step = table.number("step_s", Range::positive());
  else
    frames.step = table.number_or("step_deg", frames.step, Range::positive());
  frames.quantities = read_quantities(table, frames.quantities);
}

void read_lines(const Config& table, LineRule& lines) {
  lines.frequencies_hz = table.numbers_or("frequencies_hz", {});
  lines.orders = table.numbers_or("orders", {});
  lines.strongest = static_cast<int>(table.integer_or("strongest", lines.strongest, {0, 1000}));
  lines.quantities = read_quantities(table, lines.quantities);
  for (const char* key : {"frequencies_hz", "orders"})
    for (double value : table.numbers_or(key, {}))
      if (!(value > 0.0)) table.fail(key, fmt::format("found {:g}, expected more than 0", value));
}

/// Segments of a window: segment_deg or segment_s, and overlap.
SegmentRule read_segments(const Config& table, Domain domain) {
  SegmentRule rule;
  rule.in_seconds = table.has("segment_s");
  if (rule.in_seconds && table.has("segment_deg"))
    table.fail("segment_s", "found with segment_deg, expected one of them");
  if (rule.in_seconds && domain == Domain::kAngle)
    table.fail("segment_s", "found in a window over the angle, expected segment_deg");
  const char* key = rule.in_seconds ? "segment_s" : "segment_deg";
  rule.length = table.number_or(key, rule.length, Range::not_negative());
  rule.overlap = table.number_or("overlap", rule.overlap, Range::between(0.0, 0.95));
  return rule;
}

WindowRule read_window(const Config& table) {
  WindowRule window;
  window.name = table.text("name");
  if (window.name.empty() || window.name == "cycle" || window.name.find('/') != std::string::npos)
    table.fail("name",
               "found '" + window.name + "', expected a name without '/', other than cycle");
  constexpr double kMostCycles = 100000.0;
  if (table.has("cycles")) {
    for (const char* key : {"from_deg", "to_deg", "from_s", "to_s"})
      if (table.has(key)) table.fail(key, "found with cycles, expected one of them");
    window.span = {0.0, 720.0 * table.number("cycles", {0.0, kMostCycles, true})};
  } else {
    window.span = read_span(table, window.span);
  }
  window.taper = taper_of(table.choice("taper", {"tukey", "hann", "flattop", "none"}));
  const bool by_angle = table.choice("domain", {"time", "angle"}) == "angle";
  window.domain = by_angle ? Domain::kAngle : Domain::kTime;
  window.segments = read_segments(table, window.domain);
  return window;
}

PanelRule read_panel(const Config& table) {
  PanelRule panel{.name = table.text("name")};
  if (panel.name.empty() || panel.name.find('/') != std::string::npos)
    table.fail("name", "found '" + panel.name + "', expected a name without '/'");
  if (table.has("direction")) panel.direction = read_point(table, "direction");
  if (panel.direction && !(panel.direction->norm() > 0.0))
    table.fail("direction", "found a zero vector, expected a direction");
  panel.surfaces = table.texts_or("surfaces", {});
  panel.angle_deg = table.number_or("angle_deg", panel.angle_deg, {0.0, 180.0, true});
  if (table.has("box_min")) panel.box_min = read_point(table, "box_min");
  if (table.has("box_max")) panel.box_max = read_point(table, "box_max");
  panel.exposed = table.flag_or("exposed", panel.exposed);
  return panel;
}

SensorRule read_sensor(const Config& table) {
  SensorRule sensor{.name = table.text_or("name", table.text_or("set", ""))};
  sensor.set = table.text_or("set", "");
  if (table.has("position")) sensor.position = read_point(table, "position");
  if (table.has("direction")) sensor.direction = read_point(table, "direction");
  if (sensor.name.empty() || sensor.name.find('/') != std::string::npos)
    table.fail("name", "found '" + sensor.name + "', expected a name without '/'");
  if (sensor.set.empty() == !sensor.position)
    table.fail("set", "expected either `set` (a set of the reduced model) or `position`");
  if (sensor.direction && !(sensor.direction->norm() > 0.0))
    table.fail("direction", "found a zero vector, expected a direction");
  return sensor;
}

}  // namespace

std::vector<std::string> names_of(const Quantities& quantities) {
  std::vector<std::string> names;
  if (quantities.displacement) names.emplace_back("displacement");
  if (quantities.velocity) names.emplace_back("velocity");
  if (quantities.acceleration) names.emplace_back("acceleration");
  if (quantities.normal_velocity) names.emplace_back("normal_velocity");
  return names;
}

Options read_options(const Config& config) {
  Options options;
  if (!config.files().empty()) options.origin = config.files().front().string();
  options.body = config.text_or("body", options.body);
  if (config.has("sound")) options.sound = config.path("sound");
  options.cycle_requested = config.has("cycle");
  options.cycle = config.flag_or("cycle", options.cycle);
  if (const auto air = config.find_table("air")) {
    options.air.density = air->number_or("density", options.air.density, Range::positive());
    options.air.sound_speed =
        air->number_or("sound_speed", options.air.sound_speed, Range::positive());
    options.air.loss_factor =
        air->number_or("loss_factor", options.air.loss_factor, Range::positive());
  }
  if (const auto levels = config.find_table("levels")) {
    LevelReferences& ref = options.references;
    ref.velocity = levels->number_or("velocity_reference", ref.velocity, Range::positive());
    ref.acceleration =
        levels->number_or("acceleration_reference", ref.acceleration, Range::positive());
  }
  if (const auto spectrum = config.find_table("spectrum")) {
    SpectrumBand& band = options.spectrum;
    band.from_hz = spectrum->number_or("from_hz", band.from_hz, Range::positive());
    band.to_hz = spectrum->number_or("to_hz", band.to_hz, Range::not_negative());
    if (band.to_hz > 0.0 && !(band.to_hz > band.from_hz))
      spectrum->fail("to_hz", fmt::format("found {:g}, expected more than from_hz = {:g}",
                                          band.to_hz, band.from_hz));
  }
  if (const auto frames = config.find_table("frames")) {
    options.frames_requested = true;
    read_frames(*frames, options.frames);
  }
  if (const auto lines = config.find_table("lines")) read_lines(*lines, options.lines);
  if (const auto output = config.find_table("output")) {
    OutputRule& rule = options.output;
    rule.skin = output->flag_or("skin", rule.skin);
    rule.samples = output->flag_or("samples", rule.samples);
    rule.spectra = output->flag_or("spectra", rule.spectra);
    rule.single = output->choice("precision", {"double", "single"}) == "single";
    const LineRule& lines = options.lines;
    if (!rule.skin && (options.frames.on || lines.requested() || lines.strongest > 0))
      output->fail("skin",
                   "found false with frames or lines, which need the geometry, expected "
                   "frames.on = false and lines.strongest = 0");
  }
  options.windows_requested = config.has("window");
  if (options.windows_requested) options.windows.clear();
  for (const Config& table : config.tables("window")) {
    options.windows.push_back(read_window(table));
    for (size_t i = 0; i + 1 < options.windows.size(); ++i)
      if (options.windows[i].name == options.windows.back().name)
        table.fail("name", "found '" + options.windows[i].name +
                               "' a second time, expected different names");
  }
  for (const Config& table : config.tables("sensor")) options.sensors.push_back(read_sensor(table));
  for (const Config& table : config.tables("panel")) options.panels.push_back(read_panel(table));
  config.finish();
  return options;
}

}  // namespace clatter::recover
