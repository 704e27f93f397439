// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/factor_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "core/base/error.hpp"

namespace clatter::ranks {
namespace {

constexpr const char* kFolder = "clatter-factor-";
constexpr const char* kLock = "lock";

std::filesystem::path place_for_factors() {
  const char* given = std::getenv("TMPDIR");
  return given != nullptr && *given != '\0' ? given : "/tmp";
}

[[noreturn]] void refuse_folder(const std::filesystem::path& where, const char* what) {
  throw FileError(fmt::format("{}: the factor is to be kept on disk there (TMPDIR), but {}: {}",
                              where.string(), what, std::strerror(errno)));
}

/// Removes the folders of programs that were killed: their lock is free.
void remove_left_over(const std::filesystem::path& place) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(place, ignored)) {
    if (!entry.path().filename().string().starts_with(kFolder)) continue;
    const int lock = ::open((entry.path() / kLock).c_str(), O_RDWR | O_CLOEXEC);
    if (lock < 0) continue;  // of another user, or not complete yet
    if (::flock(lock, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove_all(entry.path(), ignored);
    ::close(lock);
  }
}

/// Starts a shell that removes the folder when the other end of its input closes, which it does
/// however this process ends. Returns that end, or -1.
int watch(const std::filesystem::path& folder) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return -1;
  constexpr int kWatched = 3;  // not standard input, which a shell takes from what runs beside it
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, ends[0], kWatched);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, kWatched + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);  // mpirun's signals do not reach it
  std::string shell = "sh", option = "-c", name = folder.string();
  // The inner shell is nobody's child, so that it outlives a rank that is ended with its children.
  std::string command = R"((cat <&3 >/dev/null; rm -rf -- "$0") &)";
  std::array<char*, 5> words{shell.data(), option.data(), command.data(), name.data(), nullptr};
  pid_t child = 0;
  const int failed = ::posix_spawn(&child, "/bin/sh", &files, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  ::close(ends[0]);
  if (failed == 0) {
    ::waitpid(child, nullptr, 0);
    return ends[1];
  }
  ::close(ends[1]);
  return -1;
}

}  // namespace

FactorFolder::FactorFolder() {
  const std::filesystem::path place = place_for_factors();
  remove_left_over(place);
  std::string name = (place / fmt::format("{}XXXXXX", kFolder)).string();
  if (::mkdtemp(name.data()) == nullptr) refuse_folder(place, "no folder can be made");
  path_ = name;
  alive_ = watch(path_);
  // Held before it has its name: else another rank might find it free.
  const std::filesystem::path unnamed = path_ / "new";
  lock_ = ::open(unnamed.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0 &&
      ::rename(unnamed.c_str(), (path_ / kLock).c_str()) == 0)
    return;
  const int reason = errno;
  if (lock_ >= 0) ::close(lock_);
  if (alive_ >= 0) ::close(alive_);
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  errno = reason;
  refuse_folder(place, "no file can be made in it");
}

FactorFolder::~FactorFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
  if (alive_ >= 0) ::close(alive_);
}

}  // namespace clatter::ranks
