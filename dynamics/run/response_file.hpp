// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The motion of a body under some of the forces of a run alone.
#include <filesystem>
#include <string>

#include "core/base/h5_file.hpp"

namespace clatter::dynamics {

/// What a response was made from, and its size.
struct ResponseSummary {
  std::string body, force;
  std::filesystem::path rom;
  int64_t samples = 0;
  double rms_velocity = 0.0;  // of the body, sqrt(v^T M v / mass) over the cycle [m/s]
  double run_velocity = 0.0;  // the same of the run without its mean [m/s]
};

/// Writes into `file` what clatter-recover reads of a run: the times of the run in `path`, and of
/// the body on which the recorded force `force` acts the periodic motion q, v, a (n_t x r) under
/// that force alone. The body is free: mounts and all other forces count only when they are among
/// the recorded ones. The sum over all forces of a run that repeats is the motion of the run, but
/// for the mean of rigid motions.
/// @param force empty: the only one; @param body empty: any
/// @throws InputError for a run without such a force, or with another reduced model than the file's
ResponseSummary write_response(const std::filesystem::path& path, const std::string& force,
                               const std::string& body, H5File& file);

}  // namespace clatter::dynamics
