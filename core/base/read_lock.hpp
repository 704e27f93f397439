// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files that no other program changes while they are read.
#include <filesystem>
#include <utility>

namespace clatter {

/// Keeps a file open with a shared lock until destruction. HDF5's library takes an exclusive one of
/// a file that it changes, as h5py and HDFView do. Where the file system has no locks, nothing is
/// locked; the library itself would not read there (hard case H3).
class ReadLock {
 public:
  ReadLock() = default;
  /// FileError when the file cannot be read, or another program keeps it open for changes for more
  /// than a second.
  explicit ReadLock(const std::filesystem::path& path);
  ReadLock(ReadLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  ReadLock& operator=(ReadLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~ReadLock();

 private:
  int descriptor_ = -1;
};

}  // namespace clatter
