// SPDX-License-Identifier: GPL-3.0-or-later
// The configuration as text: the chosen options, and the documentation for --help.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "recover/options/options.hpp"

namespace clatter::recover {
namespace {

std::string quoted(const std::string& text) { return "\"" + text + "\""; }

std::string vector_text(const Eigen::Vector3d& v) {
  return fmt::format("[{:g}, {:g}, {:g}]", v[0], v[1], v[2]);
}

std::string span_text(const Span& span) {
  const char* unit = span.in_seconds ? "s" : "deg";
  return fmt::format("from_{0} = {1:.9g}\nto_{0} = {2:.9g}\n", unit, span.from, span.to);
}

std::string list_text(const std::vector<std::string>& names) {
  return names.empty() ? "[]" : fmt::format("[\"{}\"]", fmt::join(names, "\", \""));
}

std::string window_text(const WindowRule& window) {
  const SegmentRule& segments = window.segments;
  return fmt::format(
      "[[window]]\nname = {}\n{}taper = {}\ndomain = {}\nsegment_{} = {:.9g}\noverlap = {:.9g}\n",
      quoted(window.name), span_text(window.span), quoted(name_of(window.taper)),
      quoted(name_of(window.domain)), segments.in_seconds ? "s" : "deg", segments.length,
      segments.overlap);
}

std::string panel_text(const PanelRule& panel) {
  std::string text = fmt::format("[[panel]]\nname = {}\n", quoted(panel.name));
  if (!panel.surfaces.empty()) text += "surfaces = " + list_text(panel.surfaces) + "\n";
  if (panel.direction)
    text += fmt::format("direction = {}\nangle_deg = {:g}\n", vector_text(*panel.direction),
                        panel.angle_deg);
  if (panel.box_min) text += "box_min = " + vector_text(*panel.box_min) + "\n";
  if (panel.box_max) text += "box_max = " + vector_text(*panel.box_max) + "\n";
  return text + fmt::format("exposed = {}\n", panel.exposed);
}

std::string sensor_text(const SensorRule& sensor) {
  std::string text = fmt::format("[[sensor]]\nname = {}\n", quoted(sensor.name));
  if (!sensor.set.empty()) text += "set = " + quoted(sensor.set) + "\n";
  if (sensor.position) text += "position = " + vector_text(*sensor.position) + "\n";
  if (sensor.direction) text += "direction = " + vector_text(*sensor.direction) + "\n";
  return text;
}

}  // namespace

std::string resolved_text(const Options& o) {
  std::string text = fmt::format("body = {}\ncycle = {}\n", quoted(o.body), o.cycle);
  if (!o.sound.empty()) text += "sound = " + quoted(o.sound.string()) + "\n";
  text += fmt::format("[spectrum]\nfrom_hz = {:.9g}\nto_hz = {:.9g}\n", o.spectrum.from_hz,
                      o.spectrum.to_hz);
  text += fmt::format("[air]\ndensity = {:.9g}\nsound_speed = {:.9g}\nloss_factor = {:.9g}\n",
                      o.air.density, o.air.sound_speed, o.air.loss_factor);
  text += fmt::format("[levels]\nvelocity_reference = {:g}\nacceleration_reference = {:g}\n",
                      o.references.velocity, o.references.acceleration);
  text += fmt::format("[frames]\non = {}\n{}step_{} = {:.9g}\nquantities = {}\n", o.frames.on,
                      span_text(o.frames.span), o.frames.span.in_seconds ? "s" : "deg",
                      o.frames.step, list_text(names_of(o.frames.quantities)));
  text += fmt::format(
      "[lines]\nfrequencies_hz = [{}]\norders = [{}]\nstrongest = {}\nquantities = {}\n",
      fmt::join(o.lines.frequencies_hz, ", "), fmt::join(o.lines.orders, ", "), o.lines.strongest,
      list_text(names_of(o.lines.quantities)));
  text += fmt::format("[output]\nskin = {}\nsamples = {}\nspectra = {}\nprecision = {}\n",
                      o.output.skin, o.output.samples, o.output.spectra,
                      quoted(o.output.single ? "single" : "double"));
  for (const WindowRule& window : o.windows) text += window_text(window);
  for (const SensorRule& sensor : o.sensors) text += sensor_text(sensor);
  for (const PanelRule& panel : o.panels) text += panel_text(panel);
  return text;
}

std::string options_help() {
  const Options d;
  const WindowRule w;
  return fmt::format(R"(Configuration (slap.field.toml); every key is optional:

  body = "block"           # which body of the run
  cycle = true             # analyse the last cycle: exact lines, 1/2 engine order apart
  sound = "block.sound.h5" # of `clatter-recover sound`: sound power and microphones; without it ERP
  [spectrum]
  from_hz = {:g}             # lower end of third octaves and totals
  to_hz = 0                # upper end; 0: as far as the reduced basis holds
  [air]
  density = {:g}         # kg/m3
  sound_speed = {:g}     # m/s
  loss_factor = {:g}          # radiation loss factor of the ERP
  [levels]
  velocity_reference = {:g}      # m/s; ISO 1683 has 1e-9
  acceleration_reference = {:g}  # m/s2
  [frames]                 # instants at which the entire skin is written (ParaView)
  from_deg = {:g}           # crank angle about firing TDC; or from_s, to_s, step_s
  to_deg = {:g}
  step_deg = {:g}
  quantities = ["displacement", "velocity", "normal_velocity"]  # or "acceleration"
  [lines]                  # frequencies at which the entire skin is written
  frequencies_hz = [500]   # or orders = [2, 4]; with neither the
  strongest = {}            # highest peaks of the A-weighted sound power; of the ERP without a
                           # sound file
  quantities = ["velocity", "normal_velocity"]  # or "displacement", "acceleration"
  [output]                 # what the file may do without, for many runs
  skin = true              # geometry of the skin, faces of the panels
  samples = true           # time histories of sensors and panels
  spectra = true           # spectra of the sensors
  precision = "double"     # single: all but times, frequencies and other axes
  [[window]]               # a piece that is not periodic, with its own spectra; window = []: none
  name = "{}"
  from_deg = {:g}           # or from_s, to_s; or cycles = 3: from firing TDC to firing TDC
  to_deg = {:g}
  taper = "{}"          # tukey, hann, flattop, none
  domain = "time"          # angle: values at uniform crank angles, lines are orders
  segment_deg = 0          # or segment_s: powers are averaged over segments; 0: one segment
  overlap = {:g}            # share of a segment that the next one repeats
  [[sensor]]               # default: every set of kind "sensor"
  set = "sensor_block"     # or name + position (m), optional direction
  [[panel]]                # default: skin, exposed, and six sides
  name = "oil_pan_rail"
  surfaces = ["oil_pan_rail"]  # on one of these surfaces of the mesh
  direction = [0, 0, -1]   # outward normal within angle_deg = 45 of it
  box_min = [-1, -1, -0.3]
  box_max = [1, 1, -0.2]
  exposed = true           # only faces whose normal ray hits nothing of the body)",
                     d.spectrum.from_hz, d.air.density, d.air.sound_speed, d.air.loss_factor,
                     d.references.velocity, d.references.acceleration, d.frames.span.from,
                     d.frames.span.to, d.frames.step, d.lines.strongest, w.name, w.span.from,
                     w.span.to, name_of(w.taper), w.segments.overlap);
}

}  // namespace clatter::recover
