#pragma once
// Work that may crash, hang or eat memory, in a child process: libraries abort, call exit or throw
// across their own callbacks, and only another process survives that (hard case N17).
//
// The child is a fork: it sees all that the parent has read, and hands back bytes through a pipe.
// Nothing goes through files, so nothing is left behind whichever way either of them ends. Lines of
// say() and warn() flow on through the parent. What the libraries print themselves on stdout and
// stderr never reaches ours; its end is kept for the message of a crash.
#include <filesystem>
#include <functional>
#include <string>

namespace clatter {

/// What the child may take.
struct ChildLimits {
  double seconds = 0.0;           // of wall time; 0: no limit
  double memory_gib = 0.0;        // resident; 0: memory_limit_gib()
  std::filesystem::path scratch;  // a folder that goes when a signal ends the parent; may be empty
};

/// How a child ended.
struct ChildEnd {
  enum class Kind {
    kDone,         // `result` is there
    kCrashed,      // by `signal`
    kNoResult,     // ended with `exit_code` and handed nothing back: a library called exit
    kThrew,        // what is no error of ours: `words` is its text where it has one
    kTimeLimit,    // stopped by the parent
    kMemoryLimit,  // stopped by the parent, or an allocation failed
  };
  Kind kind = Kind::kDone;
  std::string result;
  int signal = 0, exit_code = 0;
  std::string step;     // what enter_step() said last
  std::string words;    // of what was thrown
  std::string chatter;  // the end of what libraries printed in that step, some KiB

  bool done() const { return kind == Kind::kDone; }
  /// "crashed (signal 11, Segmentation fault)", "was stopped after 30 s (--time-limit)", ...
  std::string describe(const ChildLimits& limits) const;
};

/// Runs `body` in a child process and waits for it.
///
/// An Error that the body throws is thrown here, as the same kind. Everything else that ends the
/// child is a ChildEnd. The child dies with its parent, also when that is killed; SIGINT, SIGTERM
/// and SIGHUP of the parent kill the child, remove `scratch` and then end the parent as they would
/// have. No core file is left. FileError when the system gives no process or pipe.
/// Call it where no thread of ours runs: only the calling thread lives on in the child.
ChildEnd run_in_child(const ChildLimits& limits, const std::function<std::string()>& body);

/// Says what this process is about to do, for the message should it crash there. Without
/// effect outside a child.
void enter_step(const std::string& step);

/// True in the child of run_in_child().
bool is_child();

}  // namespace clatter
