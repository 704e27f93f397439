// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs without cycles that go on from a checkpoint.
#include <filesystem>

#include "core/base/h5_file.hpp"
#include "dynamics/run/bodies.hpp"
#include "dynamics/run/simulate.hpp"

namespace clatter::dynamics::testing {

/// Expects the same datasets in both groups, lists and matrices to the bit, others of the same
/// size; returns how many.
int expect_same_bits(const H5File& one, const H5File& other, const std::string& group);

/// Runs a scene without checkpoints, with them, and from the last of these; expects the same bits,
/// certificates and warnings of all three. Returns that checkpoint.
Checkpoint expect_same_bits_when_resumed(const Scene& scene, const std::filesystem::path& folder);

}  // namespace clatter::dynamics::testing
