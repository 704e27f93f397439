// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/options/options.hpp"

#include <fmt/format.h>

namespace clatter::recover {
namespace {

using keys::Keys;

const Keys<Span>& span_keys() {
  static const Keys<Span> keys("span", "a part of the run", [](auto& key, Span& span) {
    key.number("from_deg", span.from, {},
               "begin, as a crank angle about 0, firing TDC of an engine")
        .unconverted();
    key.number("to_deg", span.to, {}, "end, as a crank angle about 0, firing TDC of an engine")
        .unconverted();
    key.number("from_s", span.from, {}, "begin, as a time of the run").required_with("to_s");
    key.number("to_s", span.to, {}, "end, as a time of the run").required_with("from_s");
    key.in_either("from_deg", "from_s", span.in_seconds);
    key.in_either("to_deg", "to_s", span.in_seconds);
    key.check([](const Config& table, Span& s) {
      if (!(s.to > s.from))
        table.fail(s.in_seconds ? "to_s" : "to_deg",
                   fmt::format("found {:g}, expected more than {:g}", s.to, s.from));
    });
  });
  return keys;
}

/// The row `quantities`.
template <class Rows>
void quantities(Rows& key, Quantities& chosen) {
  key.flags("quantities", chosen,
            {{"displacement", &Quantities::displacement},
             {"velocity", &Quantities::velocity},
             {"acceleration", &Quantities::acceleration},
             {"normal_velocity", &Quantities::normal_velocity}},
            "what is written: vectors at the nodes, or the mean over each triangle along its "
            "normal");
}

const Keys<FrameRule>& frame_keys() {
  static const Keys<FrameRule> keys(
      "frames", "instants at which the entire skin is written", [](auto& key, FrameRule& frames) {
        key.flag("on", frames.on, "whether they are written");
        key.part(frames.span, span_keys());
        key.number("step_deg", frames.step, Range::positive(), "from one instant to the next")
            .unconverted();
        key.number("step_s", frames.step, Range::positive(), "from one instant to the next")
            .needs("from_s")
            .required_with("from_s");
        key.in_either("step_deg", "step_s", frames.span.in_seconds);
        quantities(key, frames.quantities);
      });
  return keys;
}

const Keys<LineRule>& line_keys() {
  static const Keys<LineRule> keys(
      "lines", "frequencies at which the entire skin is written", [](auto& key, LineRule& lines) {
        key.numbers("frequencies_hz", lines.frequencies_hz, Range::positive(),
                    "frequencies, to which the nearest lines of the spectrum are taken");
        key.numbers("orders", lines.orders, Range::positive(),
                    "the same as engine orders, multiples of the crank's speed");
        key.number("from_hz", lines.from_hz, Range::not_negative(),
                   "every line of the spectrum from here, besides those above")
            .required_with("to_hz");
        key.number("to_hz", lines.to_hz, Range::positive(), "up to here").required_with("from_hz");
        key.integer("strongest", lines.strongest, {0, 1000},
                    "with none of these, this many of the highest peaks of the A-weighted sound "
                    "power, or of the equivalent radiated power without a sound file");
        quantities(key, lines.quantities);
      });
  return keys;
}

const Keys<WindowRule>& window_keys() {
  static const Keys<WindowRule> keys(
      "window",
      "a part of the run that is not periodic, with spectra of its own; window = [] for "
      "none, from -10 to 60 degrees when no window is given",
      [](auto& key, WindowRule& window) {
        key.name("name", window.name, "name of its results").required().distinct();
        key.part(window.span, span_keys());
        const char* reason = "cycles are the last ones of the run";
        key.integer("cycles", window.cycles, {1.0, 1000.0},
                    "so many of the cycles that the run has recorded, the last ones, over which "
                    "powers are averaged")
            .excludes("from_deg", reason)
            .excludes("to_deg", reason)
            .excludes("from_s", reason)
            .excludes("to_s", reason);
        key.choice("taper", window.taper,
                   {{"tukey", Taper::kTukey},
                    {"hann", Taper::kHann},
                    {"flattop", Taper::kFlatTop},
                    {"none", Taper::kNone}},
                   "function that fades its ends");
        key.choice("domain", window.domain, {{"time", Domain::kTime}, {"angle", Domain::kAngle}},
                   "whether the samples are uniform in time or in crank angle, where lines are "
                   "orders");
        key.number("segment_deg", window.segments.length, Range::not_negative(),
                   "length of the segments over which powers are averaged, 0 for the entire "
                   "window: a cycle with cycles, else the entire window without it")
            .unconverted();
        key.number("segment_s", window.segments.length, Range::not_negative(), "the same as a time")
            .needs("domain", "time", "orders need segments of equal angle");
        key.in_either("segment_deg", "segment_s", window.segments.in_seconds);
        key.number("overlap", window.segments.overlap, Range::between(0.0, 0.95),
                   "share of a segment that the next one repeats: 0 without it where segments are "
                   "cycles by default, else 0.5");
        key.check([](const Config& table, WindowRule& w) {
          if (w.name == "cycle")
            table.fail("name", "found \"cycle\", the name of the last cycle, expected another one");
        });
      });
  return keys;
}

const Keys<SensorRule>& sensor_keys() {
  static const Keys<SensorRule> keys(
      "sensor", "a point whose motion is written; every set of kind \"sensor\" when none is given",
      [](auto& key, SensorRule& sensor) {
        key.name("name", sensor.name, "name of its results; that of the set without it")
            .required_with("position");
        key.text("set", sensor.set, "a set of the reduced part");
        key.vector("position", sensor.position, {},
                   "point to which the nearest node of the skin is taken")
            .shown_in("m");
        key.direction("direction", sensor.direction,
                      "direction of the motion; x, y, z and the normal without it")
            .needs("position");
        key.one_of({"set", "position"});
        key.check([](const Config&, SensorRule& s) {
          if (s.name.empty()) s.name = s.set;
        });
      });
  return keys;
}

const Keys<PanelRule>& panel_keys() {
  static const Keys<PanelRule> keys(
      "panel",
      "a group of faces of the skin with a power of its own, which fulfil all its conditions; the "
      "skin, its exposed faces and their six sides when none is given",
      [](auto& key, PanelRule& panel) {
        key.name("name", panel.name, "name of its results").required();
        key.texts("surfaces", panel.surfaces, "surfaces of the mesh, on one of which a face lies");
        key.direction("direction", panel.direction,
                      "direction near which a face's outward normal is");
        key.number("angle_deg", panel.angle_deg, {0.0, 180.0, true},
                   "largest angle between normal and direction")
            .unconverted();
        key.vector("box_min", panel.box_min, {}, "lower corner of a box around the faces' centres")
            .shown_in("m");
        key.vector("box_max", panel.box_max, {}, "upper corner of that box").shown_in("m");
        key.flag("exposed", panel.exposed,
                 "whether only faces belong to it whose normal meets nothing of the body");
      });
  return keys;
}

const Keys<SpectrumBand>& band_keys() {
  static const Keys<SpectrumBand> keys(
      "spectrum", "the band of spectra, third octaves and totals",
      [](auto& key, SpectrumBand& band) {
        key.number("from_hz", band.from_hz, Range::positive(), "lower end");
        key.number("to_hz", band.to_hz, Range::not_negative(),
                   "upper end, 0 for as far as the reduced basis is accurate");
        key.check([](const Config& table, SpectrumBand& b) {
          if (b.to_hz > 0.0 && !(b.to_hz > b.from_hz))
            table.fail("to_hz", fmt::format("found {:g}, expected more than from_hz = {:g}",
                                            b.to_hz, b.from_hz));
        });
      });
  return keys;
}

const Keys<LevelReferences>& level_keys() {
  static const Keys<LevelReferences> keys(
      "levels", "references of the levels in dB", [](auto& key, LevelReferences& levels) {
        key.number("velocity_reference", levels.velocity, Range::positive(),
                   "reference of velocities, by ISO/TS 7849; ISO 1683 has 1e-9")
            .shown_in("m/s");
        key.number("acceleration_reference", levels.acceleration, Range::positive(),
                   "reference of accelerations, by ISO 1683")
            .shown_in("m/s2");
      });
  return keys;
}

const Keys<OutputRule>& output_keys() {
  static const Keys<OutputRule> keys(
      "output", "what the file may do without, where there are many runs",
      [](auto& key, OutputRule& output) {
        key.flag("skin", output.skin,
                 "whether it has the skin's geometry and the faces of the panels");
        key.flag("samples", output.samples, "whether it has time histories of sensors and panels");
        key.flag("spectra", output.spectra, "whether it has spectra of the sensors");
        key.choice("precision", output.single, {{"double", false}, {"single", true}},
                   "precision of all but times, frequencies and other axes");
      });
  return keys;
}

const Keys<Air>& field_air_keys() {
  static const Keys<Air> keys("air", "what surrounds the body", [](auto& key, Air& air) {
    key.part(air, air_keys());
    key.number("loss_factor", air.loss_factor, Range::positive(),
               "radiation loss factor of the equivalent radiated power");
  });
  return keys;
}

}  // namespace

const Keys<Air>& air_keys() {
  static const Keys<Air> keys("air", "what surrounds the body", [](auto& key, Air& air) {
    key.number("density", air.density, Range::positive(), "density of the air").shown_in("kg/m3");
    key.number("sound_speed", air.sound_speed, Range::positive(), "speed of sound in it")
        .shown_in("m/s");
  });
  return keys;
}

const Keys<Options>& field_keys() {
  static const Keys<Options> keys(
      "field.toml", "what is recovered of a run; every key is optional",
      [](auto& key, Options& options) {
        key.text("body", options.body,
                 "which body of the run; \"block\" or the only reduced one without it");
        key.flag("cycle", options.cycle,
                 "whether the last cycle is analysed: exact lines, half an engine order apart");
        key.path("sound", options.sound,
                 "sound file of the part, which gives sound power and microphones; without it "
                 "there is the equivalent radiated power alone");
        key.table("spectrum", options.spectrum, band_keys());
        key.table("air", options.air, field_air_keys());
        key.table("levels", options.references, level_keys());
        key.table("frames", options.frames, frame_keys());
        key.table("lines", options.lines, line_keys());
        key.table("output", options.output, output_keys());
        key.tables("window", options.windows, window_keys());
        key.tables("sensor", options.sensors, sensor_keys());
        key.tables("panel", options.panels, panel_keys());
        key.check([](const Config& config, Options& o) {
          if (!config.files().empty()) o.origin = config.files().front().string();
          o.cycle_requested = config.has("cycle");
          o.windows_requested = config.has("window");
          o.frames_requested = config.has("frames");
          if (!o.output.skin && (o.frames.on || o.lines.requested() || o.lines.strongest > 0))
            config.table("output").fail(
                "skin",
                "frames and lines need the geometry of the skin: set frames.on = false and "
                "lines.strongest = 0");
        });
      });
  return keys;
}

std::vector<std::string> names_of(const Quantities& quantities) {
  std::vector<std::string> names;
  if (quantities.displacement) names.emplace_back("displacement");
  if (quantities.velocity) names.emplace_back("velocity");
  if (quantities.acceleration) names.emplace_back("acceleration");
  if (quantities.normal_velocity) names.emplace_back("normal_velocity");
  return names;
}

}  // namespace clatter::recover
