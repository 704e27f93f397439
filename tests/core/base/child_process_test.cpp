// SPDX-License-Identifier: GPL-3.0-or-later
// A child process that aborts, hangs, exhausts memory, exits or throws a non-exception (hard case
// N17): each is reported, nothing is left over, and results are returned completely.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/base/child_process.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/wire.hpp"
#include "tests/plain_faults.hpp"
#include "tests/random_matrix.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

using Kind = ChildEnd::Kind;
using namespace std::chrono_literals;

ChildEnd child(const std::function<std::string()>& body, const ChildLimits& limits = {}) {
  const ChildEnd end = run_in_child(limits, body);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
  return end;
}

std::string fall() {
  enter_step("falling");
  std::abort();
}

void throw_text() { throw std::string("lost"); }
// Like a library function that must not throw.
void callback() noexcept { throw_text(); }
void throw_bad_alloc() { throw std::bad_alloc(); }
void allocate_in_vain() noexcept { throw_bad_alloc(); }

TEST(HardN17_ChildProcess, ReturnsItsResultBitwise) {
  std::string large(10'000'000, '\0');
  for (size_t i = 0; i < large.size(); ++i) large[i] = static_cast<char>(i * i % 251);
  const ChildEnd end = child([&] { return large; });
  EXPECT_TRUE(end.done());
  EXPECT_EQ(end.result, large);
  EXPECT_TRUE(child([] { return std::string(); }).done());
}

TEST(HardN17_ChildProcess, AbortAndSegmentationFaultAreReportedWithTheStep) {
  const ChildEnd aborted = child(fall);
  EXPECT_EQ(aborted.kind, Kind::kCrashed);
  EXPECT_EQ(aborted.describe({}), "crashed (signal 6, Aborted)");
  EXPECT_EQ(aborted.step, "falling");
  const test::PlainFaults plain;
  const ChildEnd faulted = child([]() -> std::string {
    ::raise(SIGSEGV);
    return "never";
  });
  EXPECT_EQ(faulted.describe({}), "crashed (signal 11, Segmentation fault)");
}

TEST(HardN17_ChildProcess, ExitInAnyWayWithoutAResultIsNoSuccess) {
  for (const int code : {0, 3}) {
    const ChildEnd end = child([code]() -> std::string { std::exit(code); });
    EXPECT_EQ(end.kind, Kind::kNoResult);
    EXPECT_EQ(end.exit_code, code);
    EXPECT_EQ(end.describe({}), "ended with exit code " + std::to_string(code) + " and no result");
  }
}

TEST(HardN17_ChildProcess, EveryExceptionIsCaughtAndOurErrorsKeepTheirType) {
  const ChildEnd number = child([]() -> std::string { throw 42; });
  EXPECT_EQ(number.kind, Kind::kThrew);
  EXPECT_EQ(child([]() -> std::string { throw std::string("lost"); }).words, "lost");
  EXPECT_EQ(child([]() -> std::string { throw std::out_of_range("far"); }).words, "far");
  // Where nothing can catch it, the C++ runtime ends the process.
  const ChildEnd terminated = child([]() -> std::string {
    callback();
    return "never";
  });
  EXPECT_EQ(terminated.signal, SIGABRT);
  EXPECT_NE(terminated.chatter.find("terminate called after throwing"), std::string::npos);
  EXPECT_EQ(test::refusal_of([] { child([]() -> std::string { throw InputError("words"); }); }),
            "words");
  EXPECT_EQ(test::refusal_of<NumericsError>(
                [] { child([]() -> std::string { throw NumericsError("more words"); }); }),
            "more words");
  EXPECT_EQ(test::refusal_of<FileError>(
                [] { child([]() -> std::string { throw FileError("no room"); }); }),
            "no room");
}

TEST(HardN17_ChildProcess, AHangEndsAtTheTimeLimit) {
  ChildLimits limits;
  limits.seconds = 0.2;  // without effect, CTest's own limit ends the test
  const ChildEnd end = child(
      []() -> std::string {
        for (;;) std::this_thread::sleep_for(1h);
      },
      limits);
  EXPECT_EQ(end.kind, Kind::kTimeLimit);
  EXPECT_EQ(end.describe(limits), "was stopped after 0.2 s (--time-limit)");
}

TEST(HardN17_ChildProcess, SilenceIsBrokenByNewsOfTheStep) {
  ChildLimits limits;
  limits.patience = 0.2;
  limits.doing = [](const ChildEnd& so_far) { return "at " + so_far.step + so_far.chatter; };
  ::testing::internal::CaptureStderr();
  const ChildEnd end = child(
      []() -> std::string {
        say("a line of ours");
        enter_step("a long one");
        std::printf(": 7 of 9\n");
        std::fflush(stdout);
        std::this_thread::sleep_for(1s);
        return "done";
      },
      limits);
  const std::string said = ::testing::internal::GetCapturedStderr();
  EXPECT_LT(said.find("a line of ours"), said.find("at a long one: 7 of 9\n, 0.0")) << said;
  EXPECT_LE(std::count(said.begin(), said.end(), ','), 6) << said;  // after .2, .4, .8 s
  EXPECT_EQ(end.result, "done");
}

TEST(HardN17_ChildProcess, AChildThatExhaustsMemoryIsStoppedAtTheLimit) {
  ChildLimits limits;
  limits.memory_gib = 0.25;
  const ChildEnd slowly = child(
      []() -> std::string {
        std::vector<std::vector<char>> eaten;
        for (;;) eaten.emplace_back(std::size_t{1} << 22, 'x');
      },
      limits);
  EXPECT_EQ(slowly.kind, Kind::kMemoryLimit);
  EXPECT_EQ(slowly.describe(limits), "ran out of memory (0.25 GiB, --memory-limit)");
#ifndef __SANITIZE_ADDRESS__  // aborts on such an allocation
  const ChildEnd at_once =
      child([]() -> std::string { return {std::vector<char>(std::size_t{1} << 44, 'x').back()}; },
            limits);
  EXPECT_EQ(at_once.kind, Kind::kMemoryLimit);
#endif
  const ChildEnd uncaught = child([]() -> std::string { return allocate_in_vain(), "never"; });
  EXPECT_EQ(uncaught.kind, Kind::kMemoryLimit);
}

TEST(HardN17_ChildProcess, LibrariesThatPrintDoNotReachOurStdoutAndItsLinesDo) {
  const test::PlainFaults plain;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  const ChildEnd end = child([]() -> std::string {
    enter_step("first");
    std::printf("old news\n");
    enter_step("second");
    std::printf("transfer of 7 entities\n");
    std::cout << "and more\n" << std::flush;
    std::fprintf(stderr, "trouble\n");
    say("a line of ours");
    warn("mind this");
    ::raise(SIGSEGV);
    return "never";
  });
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "a line of ours\nwarning: mind this\n");
  EXPECT_EQ(end.chatter, "transfer of 7 entities\nand more\ntrouble\n");
  EXPECT_EQ(end.step, "second");
}

TEST(HardN17_ChildProcess, MuchOutputNeitherBlocksNorGrows) {
  const ChildEnd end = child([]() -> std::string {
    for (int i = 0; i < 200'000; ++i) std::printf("line %d of a library that talks a lot\n", i);
    return "done";
  });
  EXPECT_EQ(end.result, "done");
  EXPECT_LE(end.chatter.size(), 4096u);
}

// A process that waits for a hanging child; the child writes its process id to `file`.
pid_t start_waiter(const std::filesystem::path& file, const std::filesystem::path& scratch) {
  const pid_t waiter = ::fork();
  if (waiter != 0) return waiter;
  ChildLimits limits;
  limits.scratch = scratch;
  run_in_child(limits, [&]() -> std::string {
    std::ofstream(file.string() + ".new") << ::getpid() << std::endl;
    std::filesystem::rename(file.string() + ".new", file);
    for (;;) std::this_thread::sleep_for(1h);
  });
  ::_exit(7);
}

bool comes_true(const std::function<bool()>& holds) {
  for (int i = 0; i < 1000 && !holds(); ++i) std::this_thread::sleep_for(10ms);
  return holds();
}

TEST(HardN17_ChildProcess, ASignalToTheParentTakesTheChildAndTheScratchWithIt) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGKILL}) {
    const auto folder = test::scratch_path(fmt::format("child_{}", signal));
    std::filesystem::create_directories(folder / "scratch");
    const pid_t waiter = start_waiter(folder / "pid", folder / "scratch");
    ASSERT_TRUE(comes_true([&] { return std::filesystem::exists(folder / "pid"); }));
    pid_t hanging = 0;
    std::ifstream(folder / "pid") >> hanging;
    ASSERT_GT(hanging, 1);
    ASSERT_EQ(::kill(hanging, 0), 0);
    ::kill(waiter, signal);
    int status = 0;
    ::waitpid(waiter, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << signal;
    // A zombie that init has not yet collected counts as ended.
    EXPECT_TRUE(comes_true([&] {
      std::ifstream stat("/proc/" + std::to_string(hanging) + "/stat");
      std::string number, name, state;
      return !(stat >> number >> name >> state) || state == "Z";
    })) << signal;
    EXPECT_EQ(std::filesystem::exists(folder / "scratch"), signal == SIGKILL) << signal;
    std::filesystem::remove_all(folder);
  }
}

TEST(HardN17_ChildProcess, NoCoreFileIsWrittenAndTheParentsStateStays) {
  rlimit before{}, after{};
  ::getrlimit(RLIMIT_CORE, &before);
  const ChildEnd end = child([] {
    rlimit here{};
    ::getrlimit(RLIMIT_CORE, &here);
    return to_wire(static_cast<int>(is_child()) + 10 * static_cast<int>(here.rlim_cur));
  });
  EXPECT_EQ(from_wire<int>(end.result), 1);
  ::getrlimit(RLIMIT_CORE, &after);
  EXPECT_EQ(before.rlim_cur, after.rlim_cur);
  EXPECT_FALSE(is_child());
}

TEST(Wire, ValuesComeBackAndBytesThatEndEarlyAreRefused) {
  std::map<std::string, std::vector<double>> map = {{"a", {1.0 / 3.0, -0.0}}, {"", {}}};
  Eigen::MatrixXd matrix = test::random_matrix(3, 4);
  const std::optional<double> some = 1.0 / 3.0, none;
  const std::pair<int, std::string> both = {7, "x"};
  WireWriter writer;
  writer(map, matrix, some, none, both);
  const std::string bytes = writer.take();
  const auto read = [&](const std::string& from) {
    std::map<std::string, std::vector<double>> map_again;
    Eigen::MatrixXd matrix_again;
    std::optional<double> some_again, none_again = 1.0;
    std::pair<int, std::string> both_again;
    WireReader reader(from);
    reader(map_again, matrix_again, some_again, none_again, both_again);
    EXPECT_EQ(map, map_again);
    EXPECT_EQ(matrix, matrix_again);
    EXPECT_EQ(some, some_again);
    EXPECT_EQ(none, none_again);
    EXPECT_EQ(both, both_again);
  };
  read(bytes);
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(test::refusal_of<NumericsError>([&] { read(bytes.substr(0, size)); }),
              "the result of a child process is truncated")
        << size;
}

}  // namespace
}  // namespace clatter
