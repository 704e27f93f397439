// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/planned_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "core/base/changed_inputs.hpp"
#include "core/base/error.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

struct Output {
  std::string requested_by;
  fs::path path;

  std::string name() const { return fmt::format("{} {}", requested_by, path.string()); }
  /// The paths that exist on disk during writing.
  std::vector<fs::path> written() const { return {path, path.string() + ".part"}; }
};

/// Changes whenever the file is written to or another one gets its name; 0 where there is none.
struct Identity {
  dev_t device = 0;
  ino_t inode = 0;
  off_t bytes = 0;
  time_t seconds = 0;
  long nanoseconds = 0;

  explicit Identity(const fs::path& path) {
    struct stat state = {};
    if (::stat(path.c_str(), &state) != 0) return;
    device = state.st_dev;
    inode = state.st_ino;
    bytes = state.st_size;
    seconds = state.st_mtim.tv_sec;
    nanoseconds = state.st_mtim.tv_nsec;
  }
  bool operator==(const Identity&) const = default;
};

struct Input {
  fs::path path;
  std::string named_by;
  Identity identity;
};

// Global per process: options, configuration and readers add to the same lists.
std::vector<Output> outputs;
std::vector<Input> inputs;

/// Compares existing files (also through hard and symbolic links), else the resolved paths.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  return !whole_a.empty() && whole_a == fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

void keep_apart(const Output& output, const Input& input) {
  for (const fs::path& written : output.written()) {
    if (!same_file(written, input.path)) continue;
    const std::string via =
        written == output.path ? "" : fmt::format(" (via {})", written.string());
    const std::string named = input.named_by.empty() ? "" : fmt::format(" ({})", input.named_by);
    throw InputError(
        fmt::format("command line: {}{} would overwrite the input {}{}: expected another name",
                    output.name(), via, input.path.string(), named));
  }
}

void keep_apart(const Output& one, const Output& other) {
  for (const fs::path& a : one.written())
    for (const fs::path& b : other.written())
      if (same_file(a, b))
        throw InputError(
            fmt::format("command line: {} and {} are the same file, expected different paths",
                        other.name(), one.name()));
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw FileError(fmt::format("{}: cannot be written: {}", path.string(), why));
}

/// Checks with effective permissions; errno gives the reason.
bool permitted(const fs::path& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0;
}

void check_writable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code trouble;
  const fs::file_status state = fs::status(path, trouble);
  if (!path.has_filename() || fs::is_directory(state))
    fail(path, "it is a folder, expected a file");
  const fs::file_status folder_state = fs::status(folder, trouble);
  if (!fs::exists(folder_state))
    fail(path, fmt::format("folder {}: {}", folder.string(), trouble.message()));
  if (!fs::is_directory(folder_state))
    fail(path, fmt::format("{} is not a folder", folder.string()));
  if (!permitted(folder, W_OK | X_OK))
    fail(path, fmt::format("folder {}: {}", folder.string(), std::strerror(errno)));
  if (!fs::exists(state)) return;
  if (!fs::is_regular_file(state)) fail(path, "it is a device or pipe, expected a file");
  if (!permitted(path, W_OK)) fail(path, fmt::format("existing file: {}", std::strerror(errno)));
}

}  // namespace

void will_write(const std::string& requested_by, const fs::path& path) {
  const Output output{requested_by, path};
  if (path.empty())
    throw InputError(
        fmt::format("command line: {}: found an empty path, expected a file", requested_by));
  for (const Input& input : inputs) keep_apart(output, input);
  for (const Output& other : outputs) keep_apart(output, other);
  outputs.push_back(output);  // before the check, so that its error can name the file
  check_writable(path);
}

void will_read(const fs::path& path, const std::string& named_by) {
  const Input input{path, named_by, Identity(path)};
  for (const Output& output : outputs) keep_apart(output, input);
  inputs.push_back(input);
}

bool changed_since_planned(const fs::path& path) {
  for (const Input& input : inputs)
    if (input.path == path) return input.identity != Identity(path);
  return false;
}

bool is_planned(const fs::path& path) {
  for (const Input& input : inputs)
    if (input.path == path) return true;
  for (const Output& output : outputs)
    for (const fs::path& written : output.written())
      if (written == path) return true;
  return false;
}

}  // namespace clatter
