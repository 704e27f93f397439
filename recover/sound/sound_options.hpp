// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Options of the command `sound`. Each default is defined once, here.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "core/sound/space.hpp"
#include "recover/acoustic/acoustic_skin.hpp"
#include "recover/acoustic/velocity_map.hpp"
#include "recover/skin/radiated_power.hpp"

namespace clatter::recover {

/// A point at which the pressure is wanted.
struct Microphone {
  std::string name;
  Eigen::Vector3d position;  // [m], in the frame of the part
};

/// The frequencies of a sound file.
struct GridRule {
  double from_hz = 20.0;
  double to_hz = 2000.0;      // above it the ERP is used
  double tolerance_db = 0.1;  // largest error of interpolation
  int most = 80;              // frequencies
};

struct SoundOptions {
  std::string origin = "defaults";  // the file with these options
  Air air;                          // its loss factor is not used
  AcousticMesh mesh;
  LidMotion lids = LidMotion::kRest;
  GridRule grid;
  std::optional<sound::Plane> ground{};
  std::vector<Microphone> microphones{};  // empty: around_body()

  sound::Space space() const { return {{air.density, air.sound_speed}, ground}; }
};

/// Reads the entire configuration; unknown keys are rejected.
SoundOptions read_sound_options(const Config& config);

/// All options, defaults included, as TOML that read_sound_options() reads back.
std::string resolved_text(const SoundOptions& options);

/// Documentation of the configuration file with its defaults, for --help.
std::string sound_options_help();

/// Five microphones 1 m from the sides of the box around a body, none below: plus_y, minus_y,
/// plus_x, minus_x, top.
std::vector<Microphone> around_body(const sound::Surface& acoustic);

}  // namespace clatter::recover
