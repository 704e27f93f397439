// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Schema and names of the parts of a run file that dynamics writes and recover reads
// (docs/formats.md).
#include <string>

namespace clatter::run {

inline constexpr const char* kSchema = "clatter/run/1";
inline constexpr const char* kComplete = "complete";     // root attribute: 0 for an interrupted run
inline constexpr const char* kAngleZero = "angle_zero";  // with a crank: what angle 0 is, in words

// Groups with datasets kTime and, with a crank, kCrankAngle: n_t.
inline constexpr const char* kOutput = "output";               // of the bodies' samples
inline constexpr const char* kTime = "time";                   // [s]
inline constexpr const char* kCrankAngle = "crank_angle_deg";  // from kAngleZero

// Group kBodies has a group for each body: these datasets, n_t x r, and attributes.
inline constexpr const char* kBodies = "bodies";
inline constexpr const char* kPosition = "q";          // reduced coordinates [m]
inline constexpr const char* kVelocity = "v";          // [m/s]
inline constexpr const char* kAcceleration = "a";      // [m/s2]
inline constexpr const char* kRom = "rom";             // attribute: path from the run file's folder
inline constexpr const char* kRomHash = "rom_sha256";  // attribute

// Group kForces has a group for each body with the recorded forces on it by name: n_t x r, on q
// [N].
inline constexpr const char* kForces = "forces";

/// "<group>/<member>".
inline std::string path(const std::string& group, const std::string& member) {
  return group + "/" + member;
}

}  // namespace clatter::run
