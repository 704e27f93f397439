#pragma once
// What the user may choose. Each default stands here once; --help and the stored configuration are
// made from it.
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "recover/panels.hpp"
#include "recover/piece.hpp"
#include "recover/radiated_power.hpp"
#include "recover/sensors.hpp"

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
  double to_hz = 0.0;  // 0: as far as the basis holds
};

struct WindowRule {
  std::string name = "ftdc";
  Span span{-10.0, 60.0};
  Taper taper = Taper::kTukey;
};

/// Instants at which the whole skin is written.
struct FrameRule {
  bool on = true;
  Span span{-10.0, 60.0};
  double step = 1.0;  // [deg], or [s] when the span is in seconds
  bool displacement = true;
};

/// Frequencies at which the whole skin is written as complex velocity.
struct LineRule {
  std::vector<double> frequencies_hz;  // the nearest lines are taken
  std::vector<double> orders;          // engine orders: multiples of the speed of the crank
  int strongest = 6;                   // with neither: the highest peaks of the A-weighted ERP
};

struct Options {
  std::string origin = "defaults";  // the file that says the following
  std::string body;                 // empty: "block", or the only reduced body of the run
  Air air;
  LevelReferences references;
  SpectrumBand spectrum;
  bool cycle = true;  // analyse the last cycle; with `cycle_asked` a run without one is refused
  bool cycle_asked = false;
  bool windows_asked = false;
  std::vector<WindowRule> windows{WindowRule{}};
  bool frames_asked = false;
  FrameRule frames;
  LineRule lines;
  std::vector<SensorRule> sensors;  // empty: every set of kind "sensor"
  std::vector<PanelRule> panels;    // empty: default_panels()
};

/// Reads the whole configuration; unknown keys are refused.
Options read_options(const Config& config);

/// Every choice, defaults included, as TOML that read_options() reads back to the same choices.
std::string resolved_text(const Options& options);

/// The configuration file explained, with the defaults filled in; for --help.
std::string options_help();

}  // namespace clatter::recover
