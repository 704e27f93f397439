// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/read_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

#include "core/base/error.hpp"

namespace clatter {

ReadLock::ReadLock(const std::filesystem::path& path)
    : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (descriptor_ < 0)
    throw FileError(fmt::format("{}: cannot be read: {}", path.string(), std::strerror(errno)));
  constexpr std::chrono::milliseconds kWait{1000}, kBetween{20};
  const auto end = std::chrono::steady_clock::now() + kWait;
  while (::flock(descriptor_, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    if (std::chrono::steady_clock::now() > end) {
      ::close(std::exchange(descriptor_, -1));
      throw FileError(fmt::format(
          "{}: another program has it open for changes, expected a file that nobody changes: close "
          "it there (h5py, HDFView)",
          path.string()));
    }
    std::this_thread::sleep_for(kBetween);
  }
}

ReadLock::~ReadLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace clatter
