// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Options of the command `sound`. Each default is defined once, here.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/keys/keys.hpp"
#include "core/sound/space.hpp"
#include "recover/acoustic/acoustic_skin.hpp"
#include "recover/acoustic/velocity_map.hpp"
#include "recover/skin/radiated_power.hpp"
#include "recover/sound/measurement_surface.hpp"

namespace clatter::recover {

/// The frequencies of a sound file.
struct GridRule {
  double from_hz = 20.0;
  double to_hz = 2000.0;      // above it the ERP is used
  double tolerance_db = 0.1;  // largest error of interpolation
  int most = 80;              // frequencies
};

/// The acoustic skin.
struct SkinRule {
  AcousticMesh mesh;
  LidMotion lids = LidMotion::kRest;
};

struct SoundOptions {
  std::string origin = "defaults";  // the file with these options
  Air air;                          // its loss factor is not used
  SkinRule skin;
  GridRule grid;
  std::optional<sound::Plane> ground{};
  MicrophoneSet set = MicrophoneSet::kNone;  // none: engine_1m, or none beside a list
  std::vector<Microphone> microphones{};     // of the list, in addition to those of the set
  bool surface_pressure = true;              // is kept, for other microphones

  sound::Space space() const { return {{air.density, air.sound_speed}, ground}; }
  MicrophoneSet chosen_set() const {
    return set == MicrophoneSet::kNone && microphones.empty() ? MicrophoneSet::kEngine1m : set;
  }
};

/// The keys of a sound.toml.
const keys::Keys<SoundOptions>& sound_keys();

}  // namespace clatter::recover
