// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// One writer of a file at a time.
#include <filesystem>
#include <utility>

namespace clatter {

/// Creates the temporary file `part` if it is missing and locks it until destruction, so that no
/// second program writes it or renames it half written (hard case P3). Waits up to five seconds for
/// the other program. Where the file system has no locks, nothing is locked.
class PartLock {
 public:
  PartLock() = default;
  /// FileError when another program keeps it locked. Where the file cannot be created, nothing is
  /// locked: whoever opens it reports that.
  explicit PartLock(const std::filesystem::path& part);
  PartLock(PartLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  PartLock& operator=(PartLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~PartLock();

 private:
  int descriptor_ = -1;
};

}  // namespace clatter
