// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inputs and outputs of a program, registered before it starts work: no output overwrites an input,
// and an output that cannot be written is reported at once.
#include <filesystem>
#include <string>

namespace clatter {

/// Registers `path` as an output requested by `requested_by` ("-o", "--export"); the temporary name
/// `path.part` counts as the same output.
///
/// InputError when that is a registered input or another output, also through a link or another
/// spelling. FileError when the folder is missing or not writable, when the path is a folder or not
/// a regular file, or when an existing file may not be overwritten.
void will_write(const std::string& requested_by, const std::filesystem::path& path);

/// Registers `path` as an input, named by `named_by` ("a.toml:3: source"; empty: the command line).
/// InputError when it is also an output.
void will_read(const std::filesystem::path& path, const std::string& named_by = {});

/// Whether exactly this path was registered, or is the .part file of an output.
bool is_planned(const std::filesystem::path& path);

}  // namespace clatter
