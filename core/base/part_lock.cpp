// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/part_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

#include "core/base/error.hpp"

namespace clatter {
namespace {

constexpr std::chrono::milliseconds kPatience{5000}, kPause{50};

/// Whether the open file still has this name: another program may have renamed or removed it.
bool has_name(int descriptor, const std::filesystem::path& part) {
  struct stat opened = {}, named = {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(part.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

PartLock::PartLock(const std::filesystem::path& part) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (true) {
    descriptor_ = ::open(part.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) return;
    const bool locked = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK) return;  // a file system without locks
    if (locked && has_name(descriptor_, part)) return;
    ::close(std::exchange(descriptor_, -1));
    if (std::chrono::steady_clock::now() > end)
      throw FileError(
          fmt::format("{}: another program is writing this file: let it end, or "
                      "choose another output",
                      part.string()));
    if (!locked) std::this_thread::sleep_for(kPause);
  }
}

PartLock::~PartLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace clatter
