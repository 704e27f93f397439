// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Disk space of the results, before the run.
#include <cstdint>
#include <filesystem>
#include <string>

#include "dynamics/run/bodies.hpp"
#include "dynamics/scene/scene.hpp"

namespace clatter::dynamics {

/// Space that the samples of the recorded cycles and the film fields need. Histories come on top;
/// their length is that of the steps, which is not known before.
struct RunSize {
  int64_t samples = 0;        // of the recorded cycles
  int64_t coordinates = 0;    // reduced coordinates of all bodies
  double sample_bytes = 0.0;  // in the run file and, with several cycles, in checkpoints
  int64_t film_fields = 0;    // instants
  double film_bytes = 0.0;
};

/// Predicts the size of the results from the scene.
RunSize predict_size(const Scene& scene, const LoadedBodies& bodies);

/// FileError naming time.output_step_us or time.film_every_deg when `free_bytes`, what the disk of
/// `output` has left, are less than the size. Otherwise a line for the user about a large size,
/// over 1 GiB, or "".
std::string check_size(const Scene& scene, const RunSize& size, const std::filesystem::path& output,
                       double free_bytes);
/// The same with the space that is free where `output` is written.
std::string check_size(const Scene& scene, const RunSize& size,
                       const std::filesystem::path& output);

}  // namespace clatter::dynamics
