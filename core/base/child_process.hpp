// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Runs work that may crash, hang or exhaust memory in a child process: libraries abort, call exit
// or throw across their own callbacks, which only a separate process survives (hard case N17).
//
// The child is a fork: it sees all data of the parent and returns bytes through a pipe. No files
// are used, so none are left over however either process ends. Lines of say() and warn() are
// forwarded to the parent. Output of the libraries on stdout and stderr is captured; its last lines
// go into the message of a crash.
#include <filesystem>
#include <functional>
#include <string>

namespace clatter {

/// How a child ended.
struct ChildEnd {
  enum class Kind {
    kDone,         // `result` is valid
    kCrashed,      // killed by `signal`
    kNoResult,     // exited with `exit_code` without a result: a library called exit
    kThrew,        // an exception that is not an Error; `words` is its text, if any
    kTimeLimit,    // stopped by the parent
    kMemoryLimit,  // stopped by the parent, or an allocation failed
  };
  Kind kind = Kind::kDone;
  std::string result;
  int signal = 0, exit_code = 0;
  std::string step;     // last argument of enter_step()
  std::string words;    // text of the exception
  std::string chatter;  // last few KiB that libraries printed in that step

  bool done() const { return kind == Kind::kDone; }
  /// "crashed (signal 11, Segmentation fault)", "was stopped after 30 s (--time-limit)", ...
  std::string describe(const struct ChildLimits& limits) const;
};

/// Limits of the child, and the news of it while it works.
struct ChildLimits {
  double seconds = 3600.0;        // of wall time; 0: no limit
  double memory_gib = 0.0;        // resident; 0: memory_limit_gib()
  std::filesystem::path scratch;  // folder removed when a signal ends the parent; may be empty
  /// What the child is doing, from its state so far (`step` and `chatter`): said after 1, 2, 4, ...
  /// times `patience` without a line of its own; empty: nothing is said.
  std::function<std::string(const ChildEnd&)> doing{};
  double patience = 60.0;  // [s]
};

/// Runs `body` in a child process and waits for it.
///
/// An Error thrown by the body is rethrown here with the same type. Any other end is described by
/// ChildEnd. The child dies with its parent, even if that is killed; SIGINT, SIGTERM and SIGHUP to
/// the parent kill the child, remove `scratch` and then terminate the parent as usual. No core file
/// is written. FileError when the system provides no process or pipe.
/// Call it while no other thread of ours runs: only the calling thread exists in the child.
ChildEnd run_in_child(const ChildLimits& limits, const std::function<std::string()>& body);

/// Names the step that this process starts, for the message if it crashes there. No effect outside
/// a child.
void enter_step(const std::string& step);

/// True in the child of run_in_child().
bool is_child();

}  // namespace clatter
