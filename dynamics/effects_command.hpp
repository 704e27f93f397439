// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// clatter-dynamics --effects scene.run.toml
#include <filesystem>

namespace clatter::dynamics {

/// Prints the effects of a scene with their equations, switches and predicted cost, with --json one
/// line; writes nothing. @param run where a run of the scene may be, whose measured seconds are
/// then used.
void print_effects(const std::filesystem::path& scene, const std::filesystem::path& run);

}  // namespace clatter::dynamics
