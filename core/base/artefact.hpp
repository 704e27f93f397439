// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Metadata of every artefact: schema, version, configuration, inputs with their hashes, timing. See
// docs/formats.md.
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/h5_file.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter {

/// SHA-256 of a file's bytes as 64 hexadecimal digits. FileError when it cannot be read.
std::string sha256_of_file(const std::filesystem::path& path);

/// SHA-256 of the concatenated pieces.
std::string sha256_of_bytes(std::initializer_list<std::string_view> pieces);

/// Origin of an artefact.
struct Provenance {
  std::string schema;                         // "clatter/mesh/1"
  std::string config;                         // Config::resolved()
  std::vector<std::filesystem::path> inputs;  // files that were read
};

/// Writes schema, version, configuration and the inputs' paths and hashes to root attributes and
/// `inputs/`.
void write_provenance(H5File& file, const Provenance& provenance);

/// Writes group `timing`: seconds and peak memory per step, and totals.
void write_timing(H5File& file, const StepClock& clock);

/// Opens an artefact and checks its schema: InputError "file: schema: found X, expected Y".
H5File open_artefact(const std::filesystem::path& path, const std::string& schema);

/// Version of the running clatter, "0.1.0".
std::string version();

}  // namespace clatter
