// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files of other programs that clatter does not read: what they are, and the way out.
#include <filesystem>

namespace clatter::mesh::deck {

/// InputError that names the format when the extension is that of a known one that is not read;
/// nothing otherwise.
void refuse_other_format(const std::filesystem::path& path);

}  // namespace clatter::mesh::deck
