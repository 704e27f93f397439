#include "core/base/planned_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <vector>

#include "core/base/error.hpp"

namespace clatter {
namespace {

namespace fs = std::filesystem;

struct Output {
  std::string asked_by;
  fs::path path;

  std::string name() const { return fmt::format("{} {}", asked_by, path.string()); }
  /// The names that stand on disk in the course of writing.
  std::vector<fs::path> written() const { return {path, path.string() + ".part"}; }
};

struct Input {
  fs::path path;
  std::string named_by;
};

// One process is one program: options, configuration and readers add to the same plan.
std::vector<Output> outputs;
std::vector<Input> inputs;

/// The file behind the name where both exist (links of both kinds), else the resolved spelling.
bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, ignored), ignored);
  return !whole_a.empty() && whole_a == fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

void keep_apart(const Output& output, const Input& input) {
  for (const fs::path& written : output.written()) {
    if (!same_file(written, input.path)) continue;
    const std::string on_the_way =
        written == output.path ? "" : fmt::format(" (by way of {})", written.string());
    const std::string named = input.named_by.empty() ? "" : fmt::format(" ({})", input.named_by);
    throw InputError(
        fmt::format("command line: {}{} would overwrite the input {}{}: expected another name",
                    output.name(), on_the_way, input.path.string(), named));
  }
}

void keep_apart(const Output& one, const Output& other) {
  for (const fs::path& a : one.written())
    for (const fs::path& b : other.written())
      if (same_file(a, b))
        throw InputError(fmt::format("command line: {} and {} are one file, expected two names",
                                     other.name(), one.name()));
}

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw FileError(fmt::format("{}: cannot be written: {}", path.string(), why));
}

/// With the rights that opening has; errno says why not.
bool permitted(const fs::path& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0;
}

void check_writable(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code trouble;
  const fs::file_status state = fs::status(path, trouble);
  if (!path.has_filename() || fs::is_directory(state))
    fail(path, "it is a folder, expected the name of a file");
  const fs::file_status place = fs::status(folder, trouble);
  if (!fs::exists(place))
    fail(path, fmt::format("folder {}: {}", folder.string(), trouble.message()));
  if (!fs::is_directory(place)) fail(path, fmt::format("{} is no folder", folder.string()));
  if (!permitted(folder, W_OK | X_OK))
    fail(path, fmt::format("folder {}: {}", folder.string(), std::strerror(errno)));
  if (!fs::exists(state)) return;
  if (!fs::is_regular_file(state)) fail(path, "it is a device or pipe, expected a file");
  if (!permitted(path, W_OK))
    fail(path, fmt::format("the file that is there: {}", std::strerror(errno)));
}

}  // namespace

void will_write(const std::string& asked_by, const fs::path& path) {
  const Output output{asked_by, path};
  if (path.empty())
    throw InputError(fmt::format("command line: {}: found no name, expected a file", asked_by));
  for (const Input& input : inputs) keep_apart(output, input);
  for (const Output& other : outputs) keep_apart(output, other);
  outputs.push_back(output);  // before what may be refused, so that the refusal knows the file
  check_writable(path);
}

void will_read(const fs::path& path, const std::string& named_by) {
  const Input input{path, named_by};
  for (const Output& output : outputs) keep_apart(output, input);
  inputs.push_back(input);
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
