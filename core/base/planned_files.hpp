#pragma once
// What a program reads and writes, known before it works: an output never overwrites an input, and
// an output that cannot be written is told at once.
#include <filesystem>
#include <string>

namespace clatter {

/// Says that this program is going to write `path`, because `asked_by` ("-o", "--export") asks for
/// it; `path.part`, the name until it is complete, counts as the same output.
///
/// InputError when that is a file said to be read or another output, also by a link or another
/// spelling. FileError when the folder is missing or cannot be written, when the name is a folder
/// or no regular file, or when a file there may not be overwritten.
void will_write(const std::string& asked_by, const std::filesystem::path& path);

/// Says that this program reads `path`, which `named_by` names ("a.toml:3: source"; empty: the
/// command line). InputError when it is also an output.
void will_read(const std::filesystem::path& path, const std::string& named_by = {});

/// Whether this program said that it reads or writes a file of this very name, or the part of one.
bool is_planned(const std::filesystem::path& path);

}  // namespace clatter
