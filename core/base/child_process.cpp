// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <new>
#include <utility>

#include "core/base/child_pipe.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/stopwatch.hpp"

namespace clatter {
namespace {

constexpr size_t kChatterBytes = 4096;  // kept of what libraries print
constexpr char kStepMark = '\x1d';      // in captured output: a step begins
constexpr int kPollMs = 20;             // between checks of time, memory and signals

char* step_text = nullptr;  // in the child: shared with the parent

// Type of a message from the child.
enum class Frame : char {
  kSay = 's',
  kWarn = 'w',
  kResult = 'r',
  kError = 'e',
  kThrew = 't',
  kMemory = 'm'
};

// --- the child ---

void send_bytes(int to, const char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t sent = ::write(to, bytes, count);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) ::_exit(1);  // the parent has ended
    bytes += sent;
    count -= static_cast<size_t>(sent);
  }
}

void send(int to, Frame kind, const std::string& text) {
  const uint64_t size = text.size();
  std::string head(1 + sizeof size, static_cast<char>(kind));
  std::memcpy(head.data() + 1, &size, sizeof size);
  send_bytes(to, head.data(), head.size());
  send_bytes(to, text.data(), text.size());
}

#ifndef __SANITIZE_ADDRESS__
double address_space_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
}
#endif

// The parent monitors resident memory; a single huge allocation is refused in the child.
void limit_address_space([[maybe_unused]] double memory_gib) {
#ifndef __SANITIZE_ADDRESS__  // its shadow memory takes terabytes
  const double bytes = address_space_bytes() + (1.25 * memory_gib + 2.0) * kBytesPerGib;
  rlimit limit{};
  if (bytes > 9e18 || ::getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(bytes));
  ::setrlimit(RLIMIT_AS, &limit);
#endif
}

void prepare_child(pid_t parent, int chatter, double memory_gib) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // the parent ended before the line above
  // The terminal signals both processes; only the parent reacts.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_IGN);
  const rlimit none{};
  ::setrlimit(RLIMIT_CORE, &none);
  limit_address_space(memory_gib);
  ::dup2(chatter, STDOUT_FILENO);
  ::dup2(chatter, STDERR_FILENO);
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // otherwise the last lines before a crash are lost
}

[[noreturn]] void be_child(int to, const std::function<std::string()>& body) {
  set_log_sink([to](bool warning, const std::string& line) {
    send(to, warning ? Frame::kWarn : Frame::kSay, line);
  });
  try {
    send(to, Frame::kResult, body());
  } catch (const Error& error) {
    send(to, Frame::kError, static_cast<char>(error.code()) + std::string(error.what()));
  } catch (const std::bad_alloc&) {
    send(to, Frame::kMemory, "");
  } catch (const std::exception& error) {
    send(to, Frame::kThrew, error.what());
  } catch (const std::string& text) {
    send(to, Frame::kThrew, text);
  } catch (...) {
    send(to, Frame::kThrew, "");
  }
  ::_exit(0);  // no destructors: they include the library's
}

// --- the parent ---

volatile std::sig_atomic_t caught_signal = 0;

// Records SIGINT, SIGTERM and SIGHUP during its lifetime.
class SignalWatch {
 public:
  SignalWatch() {
    caught_signal = 0;
    for (size_t i = 0; i < kSignals.size(); ++i) {
      struct sigaction action {};
      action.sa_handler = [](int signal) { caught_signal = signal; };
      ::sigaction(kSignals[i], nullptr, &old_[i]);
      if (old_[i].sa_handler != SIG_IGN) ::sigaction(kSignals[i], &action, nullptr);
    }
  }
  ~SignalWatch() { restore(); }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;
  void restore() {
    for (size_t i = 0; i < kSignals.size(); ++i) ::sigaction(kSignals[i], &old_[i], nullptr);
  }

 private:
  static constexpr std::array<int, 3> kSignals = {SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> old_{};
};

double resident_gib(pid_t process) {
  std::ifstream file(fmt::format("/proc/{}/statm", process));
  double all = 0.0, resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGE_SIZE)) / kBytesPerGib;
}

[[noreturn]] void throw_error_of(const std::string& frame) {
  const auto code = static_cast<ExitCode>(frame.at(0));
  const std::string message = frame.substr(1);
  if (code == ExitCode::kBadInput) throw InputError(message);
  if (code == ExitCode::kFileTrouble) throw FileError(message);
  throw NumericsError(message);
}

// A running child and its output.
class Child {
 public:
  Child(pid_t process, const ChildLimits& limits, const SharedText& step)
      : process_(process), limits_(limits), step_(step) {}
  ~Child() { stop(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Reads until the child closes its end or exceeds a limit.
  void follow(int frames, int chatter) {
    std::array<pollfd, 2> watched = {pollfd{frames, POLLIN, 0}, pollfd{chatter, POLLIN, 0}};
    ::fcntl(chatter, F_SETFL, O_NONBLOCK);
    while (true) {
      ::poll(watched.data(), watched.size(), kPollMs);
      if (caught_signal != 0) return;
      if (watched[1].revents != 0 && !drain_chatter(chatter)) watched[1].fd = -1;
      if (watched[0].revents != 0 && !take_bytes(frames)) break;
      watched[0].revents = watched[1].revents = 0;
      if (over_limit()) return;
      break_silence();
    }
    drain_chatter(chatter);
  }

  /// Kills it if necessary and collects its exit status.
  ChildEnd finish() {
    if (end_.kind == ChildEnd::Kind::kTimeLimit || stopped_for_memory_ || caught_signal != 0)
      ::kill(process_, SIGKILL);
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    if (finished_ || end_.kind != ChildEnd::Kind::kDone) return std::move(end_);
    end_.kind = WIFSIGNALED(status) ? ChildEnd::Kind::kCrashed : ChildEnd::Kind::kNoResult;
    end_.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    end_.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    // A library that lets nobody catch its failed allocation: std::terminate prints this.
    if (end_.signal == SIGABRT && end_.chatter.find("std::bad_alloc") != std::string::npos)
      end_.kind = ChildEnd::Kind::kMemoryLimit;
    return std::move(end_);
  }

  const std::string& error() const { return error_; }

 private:
  void stop() {
    if (process_ == 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }

  bool over_limit() {
    if (limits_.seconds > 0.0 && clock_.seconds() > limits_.seconds)
      end_.kind = ChildEnd::Kind::kTimeLimit;
    if (resident_gib(process_) > limits_.memory_gib) {
      end_.kind = ChildEnd::Kind::kMemoryLimit;
      stopped_for_memory_ = true;
    }
    return end_.kind != ChildEnd::Kind::kDone && !finished_;
  }

  void break_silence() {
    if (!limits_.doing || silence_.seconds() < patience_) return;
    ChildEnd so_far = end_;
    so_far.step = step_.str();
    so_far.chatter.erase(0, so_far.chatter.rfind(kStepMark) + 1);
    say(fmt::format("{}, {:.3g} min so far", limits_.doing(so_far), clock_.seconds() / 60.0));
    patience_ *= 2.0;
  }

  bool drain_chatter(int from) {
    std::array<char, 4096> bytes;
    ssize_t count = 0;
    while ((count = ::read(from, bytes.data(), bytes.size())) > 0) {
      end_.chatter.append(bytes.data(), static_cast<size_t>(count));
      if (end_.chatter.size() > kChatterBytes)
        end_.chatter.erase(0, end_.chatter.find('\n', end_.chatter.size() - kChatterBytes) + 1);
    }
    return count < 0 && (errno == EAGAIN || errno == EINTR);
  }

  bool take_bytes(int from) {
    std::array<char, 65536> bytes;
    const ssize_t count = ::read(from, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) return true;
    if (count <= 0) return false;
    pending_.append(bytes.data(), static_cast<size_t>(count));
    constexpr size_t kHead = 1 + sizeof(uint64_t);
    while (pending_.size() >= kHead) {
      uint64_t size = 0;
      std::memcpy(&size, pending_.data() + 1, sizeof size);
      if (pending_.size() < kHead + size) {
        if (pending_.capacity() < kHead + size) pending_.reserve(kHead + size);
        break;
      }
      take_frame(static_cast<Frame>(pending_[0]), pending_.substr(kHead, size));
      pending_.erase(0, kHead + size);
    }
    return true;
  }

  void take_frame(Frame kind, std::string text) {
    silence_ = Stopwatch();
    patience_ = limits_.patience;
    if (kind == Frame::kSay) return say(text);
    if (kind == Frame::kWarn) return warn(text);
    finished_ = true;
    if (kind == Frame::kResult) end_.result = std::move(text);
    if (kind == Frame::kError) error_ = std::move(text);
    if (kind == Frame::kMemory) end_.kind = ChildEnd::Kind::kMemoryLimit;
    if (kind == Frame::kThrew) {
      end_.kind = ChildEnd::Kind::kThrew;
      end_.words = std::move(text);
    }
  }

  pid_t process_;
  ChildLimits limits_;
  const SharedText& step_;
  Stopwatch clock_, silence_;
  double patience_ = limits_.patience;  // of silence until the next news [s]
  ChildEnd end_;
  std::string pending_, error_;
  bool finished_ = false, stopped_for_memory_ = false;
};

[[noreturn]] void end_by_signal(SignalWatch& watch, const ChildLimits& limits) {
  std::error_code ignored;
  if (!limits.scratch.empty()) std::filesystem::remove_all(limits.scratch, ignored);
  watch.restore();
  ::raise(caught_signal);
  throw NumericsError(fmt::format("stopped by signal {}", static_cast<int>(caught_signal)));
}

}  // namespace

std::string ChildEnd::describe(const ChildLimits& limits) const {
  switch (kind) {
    case Kind::kDone:
      return "succeeded";
    case Kind::kCrashed:
      return fmt::format(
          "crashed (signal {}, {}{})", signal, ::strsignal(signal),
          signal == SIGKILL ? ": possibly killed by the kernel because memory ran out" : "");
    case Kind::kNoResult:
      return fmt::format("ended with exit code {} and no result", exit_code);
    case Kind::kThrew:
      return words.empty() ? "threw an exception without text" : fmt::format("threw \"{}\"", words);
    case Kind::kTimeLimit:
      return fmt::format("was stopped after {:g} s (--time-limit)", limits.seconds);
    case Kind::kMemoryLimit:
      return fmt::format("ran out of memory ({:.3g} GiB, --memory-limit)",
                         limits.memory_gib > 0.0 ? limits.memory_gib : memory_limit_gib());
  }
  return "";
}

ChildEnd run_in_child(const ChildLimits& requested, const std::function<std::string()>& body) {
  ChildLimits limits = requested;
  if (limits.memory_gib <= 0.0) limits.memory_gib = memory_limit_gib();
  const SharedText step;
  Pipe frames, chatter;
  SignalWatch watch;
  std::fflush(nullptr);  // otherwise the child may print our buffers again
  const pid_t parent = ::getpid(), process = ::fork();
  if (process < 0) throw FileError(fmt::format("no child process: {}", std::strerror(errno)));
  if (process == 0) {
    step_text = step.get();
    prepare_child(parent, chatter.write.get(), limits.memory_gib);
    be_child(frames.write.get(), body);
  }
  frames.write.close();
  chatter.write.close();
  Child child(process, limits, step);
  child.follow(frames.read.get(), chatter.read.get());
  ChildEnd end = child.finish();
  if (caught_signal != 0) end_by_signal(watch, limits);
  end.step = step.str();
  end.chatter.erase(0, end.chatter.rfind(kStepMark) + 1);
  if (!child.error().empty()) throw_error_of(child.error());
  return end;
}

void enter_step(const std::string& step) {
  if (step_text == nullptr) return;
  const size_t size = std::min(step.size(), SharedText::kBytes - 1);
  std::memcpy(step_text, step.data(), size);
  step_text[size] = '\0';
  std::putchar(kStepMark);
  std::fflush(stdout);
}

bool is_child() { return step_text != nullptr; }

}  // namespace clatter
