// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The sound file, schema "clatter/sound/2".
#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"
#include "recover/sound/sound_build.hpp"

namespace clatter::recover {

inline constexpr const char* kSoundSchema = "clatter/sound/2";

/// Writes table, acoustic skin, lids, efficiencies and certificate.
/// @param rom_sha256 hash of the reduced model
void write_sound(H5File& file, const PartSound& sound, const SoundOptions& options,
                 const std::string& rom_sha256);

/// What an earlier file of the part has for a new one: see EarlierSamples. None where there is no
/// file, where it is of another model, version or space, invalid, or keeps no pressures.
std::vector<SoundSample> earlier_samples(const std::filesystem::path& path,
                                         const std::string& rom_sha256, const PartSound& sound);

/// Reads the table of a sound file.
/// @param rom_sha256 hash of the reduced model that it must have been made from
/// @param size number of its coordinates
/// @throws InputError for a file of another model, or invalid content
SoundTable read_sound(const std::filesystem::path& path, const std::string& rom_sha256, int size);

}  // namespace clatter::recover
