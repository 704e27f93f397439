// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The user's options. Each default is defined once, here.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "recover/options/piece.hpp"
#include "recover/skin/panels.hpp"
#include "recover/skin/radiated_power.hpp"
#include "recover/skin/sensors.hpp"

namespace clatter::recover {

/// References of the levels in dB; each is written beside the levels that use it.
struct LevelReferences {
  double velocity = 5e-8;      // [m/s] ISO/TS 7849; ISO 1683 has 1e-9, 34 dB apart
  double acceleration = 1e-6;  // [m/s2] ISO 1683
  double power = 1e-12;        // [W] ISO 1683
};

/// The band that spectra, third octaves and totals cover.
struct SpectrumBand {
  double from_hz = 20.0;
  double to_hz = 0.0;  // 0: the limit of the basis
};

/// Quantities of the entire skin that are written: vectors at its nodes, and the mean normal
/// velocity of each triangle.
struct Quantities {
  bool displacement = false, velocity = true, acceleration = false, normal_velocity = true;
};
/// Names of the chosen ones, in the order of the members.
std::vector<std::string> names_of(const Quantities& quantities);

/// Instants at which the entire skin is written.
struct FrameRule {
  bool on = true;
  Span span;
  double step = 1.0;  // [deg], or [s] when the span is in seconds
  Quantities quantities{.displacement = true};
};

/// Frequencies at which the entire skin is written as complex motion.
struct LineRule {
  std::vector<double> frequencies_hz;  // the nearest lines are taken
  std::vector<double> orders;          // engine orders: multiples of the speed of the crank
  std::optional<double> from_hz;       // with to_hz: every line of the spectrum between both
  std::optional<double> to_hz;
  int strongest = 6;  // with none of these: the highest peaks of the A-weighted power
  Quantities quantities;

  bool requested() const { return !frequencies_hz.empty() || !orders.empty() || from_hz; }
};

/// Parts of the field file that may be left out, and its precision.
struct OutputRule {
  bool skin = true;     // geometry of the skin and faces of the panels
  bool samples = true;  // time histories of sensors and panels
  bool spectra = true;  // spectra of the sensors
  bool single = false;  // single precision for everything but times, frequencies and other axes
};

struct Options {
  std::string origin = "defaults";  // the file with these options
  std::string body;                 // empty: "block", or the only reduced body of the run
  std::filesystem::path sound;      // sound file of the part; empty: ERP alone
  Air air;
  LevelReferences references;
  SpectrumBand spectrum;
  bool cycle = true;  // analyse the last cycle; if requested, a run without one is rejected
  bool cycle_requested = false;
  bool windows_requested = false;
  std::vector<WindowRule> windows{WindowRule{}};
  bool frames_requested = false;
  FrameRule frames;
  LineRule lines;
  OutputRule output;
  std::vector<SensorRule> sensors;  // empty: every set of kind "sensor"
  std::vector<PanelRule> panels;    // empty: default_panels()
};

/// The keys of a field.toml, and those of its table [air].
const keys::Keys<Options>& field_keys();
const keys::Keys<Air>& air_keys();

}  // namespace clatter::recover
