// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/json_line.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/refusal.hpp"
#include "core/base/threads.hpp"
#include "core/base/whole_file.hpp"
#include "tests/refusal.hpp"

namespace clatter {
namespace {

TEST(Threads, PiecesCoverTheRangeOnceWhateverTheCount) {
  for (const int count : {1, 2, 3, 7}) {
    set_thread_count(count);
    std::vector<int> visits(100, 0);
    parallel_pieces(100, [&](int64_t begin, int64_t end) {
      for (int64_t i = begin; i < end; ++i) ++visits[static_cast<size_t>(i)];
    });
    EXPECT_EQ(visits, std::vector<int>(100, 1)) << count << " threads";
  }
  set_thread_count(0);
}

TEST(Threads, AnExceptionInAPieceReachesTheCaller) {
  set_thread_count(2);
  EXPECT_EQ(test::refusal_of<NumericsError>([] {
              parallel_pieces(10, [](int64_t begin, int64_t) {
                if (begin > 0) throw NumericsError("piece");
              });
            }),
            "piece");
  set_thread_count(0);
}

/// The files left when `signal` ends a process that writes an HDF5 file and text files.
void end_while_writing(int signal) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("clatter_signal_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const pid_t child = ::fork();
  if (child == 0) {
    run_guarded("child", [&] {
      H5File artefact = H5File::create(folder / "a.h5");
      artefact.write("x", std::vector<double>{1.0});
      WholeFile text(folder / "a.txt");
      text.stream() << "half" << std::flush;
      WholeFile whole(folder / "b.txt");
      whole.commit();
      const bool there = exists(folder / "a.h5.part") && exists(folder / "a.txt.part");
      if (there) ::raise(signal);
      return 0;
    });
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal) << status;
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    left.push_back(entry.path().filename());
  EXPECT_EQ(left, std::vector<std::string>{"b.txt"});
  std::filesystem::remove_all(folder);
}

TEST(HardH1_Signals, RemoveFilesThatAreNotComplete) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) end_while_writing(signal);
}

TEST(MemoryText, HasTheUnitInWhichItIsANumber) {
  const double mib = 1.0 / 1024.0, kib = mib * mib;
  EXPECT_EQ(memory_text(0.0), "0 MiB");
  EXPECT_EQ(memory_text(512.0 * kib), "512 KiB");
  EXPECT_EQ(memory_text(0.02), "20.5 MiB");
  EXPECT_EQ(memory_text(0.9996), "1 GiB");
  EXPECT_EQ(memory_text(1.254), "1.25 GiB");
  EXPECT_EQ(memory_text(123.4), "123 GiB");
  EXPECT_EQ(memory_text(0.4 * kib), "0.4 KiB");
}

TEST(MemoryText, ARefusalSaysAmountsThatAreNotZero) {
  const double mib = 1.0 / 1024.0;
  set_memory_limit_gib(memory_in_use_gib() + 2.0 * mib);
  try {
    require_memory("the factor", 30.0 * mib, "smaller");
    ADD_FAILURE() << "accepted";
  } catch (const NumericsError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("the factor needs 30 MiB, "), std::string::npos) << said;
    EXPECT_EQ(said.find(" 0 "), std::string::npos) << said;
  }
  set_memory_limit_gib(0.0);
}

TEST(RunGuarded, GivesTheExitCodeOfTheError) {
  EXPECT_EQ(run_guarded("t", [] { return 0; }), 0);
  EXPECT_EQ(run_guarded("t", []() -> int { throw InputError("x"); }), 2);
  EXPECT_EQ(run_guarded("t", []() -> int { throw 7; }), 3);
  EXPECT_EQ(run_guarded("t", []() -> int { throw NumericsError("x"); }), 3);
  EXPECT_EQ(run_guarded("t", []() -> int { throw FileError("x"); }), 4);
}

TEST(RunGuarded, HardG1_AThrownStringIsCaught) {
  EXPECT_EQ(run_guarded("t", []() -> int { throw std::string("gmsh says no"); }), 3);
}

TEST(CommandLine, AWrongOptionEndsWithTwo) {
  CommandLine line("t", "summary", "");
  std::string program = "t", wrong = "--nonsense";
  char* argv[] = {program.data(), wrong.data(), nullptr};
  EXPECT_FALSE(line.parse(2, argv));
  EXPECT_EQ(line.exit_code(), 2);
}

TEST(CommandLine, TheDepfileNamesEachInputTwice) {
  const auto path = std::filesystem::temp_directory_path() / "clatter_depfile_test.d";
  write_depfile(path, "a.h5", {"a.toml", "b.csv"});
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "a.h5: a.toml b.csv\na.toml:\nb.csv:\n");
  std::filesystem::remove(path);
}

TEST(ErrorPositions, AreParsedFromTheMessage) {
  const auto folder = std::filesystem::temp_directory_path() / "clatter_error_positions: 7";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "a.toml").string();
  std::ofstream(file) << "x = 1\n";
  const auto expect = [](const std::string& message, const ErrorPosition& expected) {
    const ErrorPosition found = position_in(message);
    EXPECT_EQ(found.file, expected.file) << message;
    EXPECT_EQ(found.line, expected.line) << message;
    EXPECT_EQ(found.place, expected.place) << message;
  };
  expect(file + ":3: mesh.size: found 0, expected more", {file, 3, "mesh.size"});
  expect(file + ":3:14: not TOML: found ]", {file, 3, ""});
  expect(file + ": K/data: checksum does not match: damaged", {file, 0, "K/data"});
  expect(file + ": cannot be read", {file, 0, ""});
  expect("not converged: 7 of 20 modes", {"", 0, ""});
  std::filesystem::remove_all(folder);
  expect(file + ":3: mesh.size: found 0", {"", 0, ""});  // neither existing nor registered
  will_read(file);
  expect(file + ":3: mesh.size: found 0", {file, 3, "mesh.size"});
}

TEST(Json, QuotesAndControlCharactersAreEscaped) {
  EXPECT_EQ(json_text("a\"b\\c\n"), "\"a\\\"b\\\\c\\n\"");
  EXPECT_EQ(json_text("\xff.h5"), "\"\xef\xbf\xbd.h5\"");  // a file name that is not UTF-8
  EXPECT_EQ(json_number(std::numeric_limits<double>::quiet_NaN()), "null");
}

}  // namespace
}  // namespace clatter
