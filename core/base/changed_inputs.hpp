// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inputs that are edited or replaced while a program uses them.
#include <filesystem>

namespace clatter {

/// Whether an input that will_read() registered (core/base/planned_files.hpp) was written to or
/// replaced since then: what was read from it is not what it holds now (hard case P5). False for
/// other paths.
bool changed_since_planned(const std::filesystem::path& path);

}  // namespace clatter
