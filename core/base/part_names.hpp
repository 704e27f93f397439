#pragma once
// Files that are being written under a name of their own until they are complete, and what a signal
// leaves of them: nothing.
#include <filesystem>

namespace clatter {

/// A name that stands for an unfinished file while this lives: SIGINT, SIGTERM and SIGHUP remove it
/// before they end the process.
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

/// Makes these signals remove the unfinished files; one that is ignored (nohup) stays ignored, one
/// that has a handler of its own keeps it.
void remove_parts_on_signals();

}  // namespace clatter
