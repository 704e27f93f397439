// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Files that are written under a temporary name until they are complete; signals remove them.
#include <filesystem>

namespace clatter {

/// Registers an unfinished file for its lifetime: SIGINT, SIGTERM, SIGHUP and SIGXCPU remove the
/// file before they terminate the process.
class PartName {
 public:
  PartName() = default;
  explicit PartName(const std::filesystem::path& path);
  PartName(PartName&& other) noexcept;
  PartName& operator=(PartName&& other) noexcept;
  ~PartName();

 private:
  int slot_ = -1;
};

/// Installs handlers that remove the unfinished files. An ignored signal (nohup) stays ignored, one
/// with a handler keeps it.
void remove_parts_on_signals();

}  // namespace clatter
