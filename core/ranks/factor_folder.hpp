// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where a rank keeps its part of a factor on disk.
#include <filesystem>

namespace clatter::ranks {

/// A folder `clatter-factor-XXXXXX` in TMPDIR (or /tmp), removed by the destructor. A watching
/// process removes it when this one is killed; where that is killed too, the next program that
/// makes such a folder there does, since the lock in it is free then.
class FactorFolder {
 public:
  /// FileError when TMPDIR has no room for it.
  FactorFolder();
  ~FactorFolder();
  FactorFolder(const FactorFolder&) = delete;
  FactorFolder& operator=(const FactorFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;   // held while this process lives
  int alive_ = -1;  // end of a pipe; the watching process acts when it closes
};

}  // namespace clatter::ranks
