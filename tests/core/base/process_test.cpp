// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <numeric>
#include <set>
#include <sstream>
#include <thread>

#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/h5_file.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/refusal.hpp"
#include "core/base/threads.hpp"
#include "core/base/whole_file.hpp"
#include "core/base/write_artefact.hpp"
#include "tests/refusal.hpp"
#include "tests/scratch.hpp"

namespace clatter {
namespace {

TEST(Threads, PiecesCoverTheRangeOnceWhateverTheCount) {
  for (const int count : {1, 2, 3, 7}) {
    set_thread_count(count);
    std::vector<int> visits(100, 0);
    parallel_pieces(100, [&](int64_t begin, int64_t end) {
      for (int64_t i = begin; i < end; ++i) ++visits[i];
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

/// Whether pieces of pieces cover 10 x 10 numbers once each.
bool nested_pieces_cover() {
  std::vector<int> visits(100, 0);
  parallel_pieces(10, [&](int64_t begin, int64_t end) {
    for (int64_t k = begin; k < end; ++k)
      parallel_pieces(10, [&](int64_t first, int64_t last) {
        for (int64_t i = first; i < last; ++i) ++visits[10 * k + i];
      });
  });
  return visits == std::vector<int>(100, 1);
}

TEST(Threads, PiecesOfPiecesOfSeveralThreadsAndInAForkedProcessAreDone) {
  set_thread_count(4);
  std::atomic<int> right{0};
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller)
    callers.emplace_back([&] {
      for (int k = 0; k < 200; ++k) right += nested_pieces_cover() ? 1 : 0;
    });
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(right, 800);
  const pid_t child = ::fork();
  if (child == 0) ::_exit(nested_pieces_cover() ? 0 : 1);
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  set_thread_count(0);
}

TEST(Threads, AreMoreThanOneWhereTheyHaveTime) {
  set_thread_count(2);
  std::set<std::thread::id> ran;
  std::mutex mutex;
  for (int k = 0; k < 500 && ran.size() < 2; ++k)
    parallel_pieces(2, [&](int64_t, int64_t) {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const std::lock_guard lock(mutex);
      ran.insert(std::this_thread::get_id());
    });
  EXPECT_EQ(ran.size(), 2u);
  set_thread_count(0);
}

TEST(WholeFile, IsReadByteByByteAndFoldersAreRefused) {
  const std::filesystem::path path = test::scratch_path("whole");
  const std::string bytes("a\r\n\0\xff b", 8);
  write_whole_file(path, bytes);
  EXPECT_EQ(read_whole_file(path), bytes);
  write_whole_file(path, "");
  EXPECT_EQ(read_whole_file(path), "");
  std::filesystem::remove(path);
  const std::string what = path.string() + ": cannot be read";
  EXPECT_EQ(test::refusal_of<FileError>([&] { read_whole_file(path); }), what);
  std::filesystem::create_directory(path);
  EXPECT_EQ(test::refusal_of<FileError>([&] { read_whole_file(path); }), what);
  std::filesystem::remove(path);
}

/// The files left when `signal` ends a process that writes an HDF5 file and text files.
void end_while_writing(int signal) {
  const std::filesystem::path folder = test::scratch_path("signal");
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

/// A program with a usual job and a command, both of which note what they were called with.
struct Program {
  CommandLine line{"t", "summary", ""};
  std::filesystem::path model, solved;
  int count = 0;
  std::string called;

  Program() {
    line.positional("model", model, "model");
    line.option("--count", count, "count");
    line.moved("--static", "t statics MODEL");
    line.action([this](const CommonOptions&) { called = "usual " + model.string(); });
    CommandLine& statics = line.command("statics", "summary", "");
    statics.positional("model", solved, "model");
    statics.action([this](const CommonOptions& common) {
      called = "statics " + solved.string() + (common.json ? " json" : "");
    });
  }
  /// The exit code.
  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "t");
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    ::testing::internal::CaptureStderr();
    const int code = line.run(static_cast<int>(arguments.size()), argv.data());
    said = ::testing::internal::GetCapturedStderr();
    set_json(false);
    return code;
  }
  std::string said;
};

TEST(CommandLine, AWrongOptionEndsWithTwo) {
  Program program;
  EXPECT_EQ(program.run({"--nonsense"}), 2);
  EXPECT_EQ(program.called, "");
}

TEST(CommandLine, TheFirstArgumentChoosesTheCommand) {
  EXPECT_EQ(Program().run({}), 2);
  Program usual;
  EXPECT_EQ(usual.run({"x.h5", "--count", "3"}), 0);
  EXPECT_EQ(usual.called, "usual x.h5");
  Program file;
  EXPECT_EQ(file.run({"./statics"}), 0);
  EXPECT_EQ(file.called, "usual ./statics");
  Program command;
  EXPECT_EQ(command.run({"statics", "statics", "--json"}), 0);
  EXPECT_EQ(command.called, "statics statics json");
}

TEST(CommandLine, ACommandHasOptionsOfItsOwn) {
  Program program;
  EXPECT_EQ(program.run({"statics", "x.h5", "--count", "3"}), 2);
  EXPECT_NE(program.said.find("(see t statics --help)"), std::string::npos) << program.said;
  Program later;
  EXPECT_EQ(later.run({"x.h5", "statics"}), 2);  // a second file, not a command
  EXPECT_EQ(later.called, "");
}

TEST(CommandLine, AnOptionThatBecameACommandIsNamed) {
  Program program;
  EXPECT_EQ(program.run({"x.h5", "--static"}), 2);
  EXPECT_EQ(program.said, "t: error: --static is now a command: t statics MODEL (see t --help)\n");
}

TEST(WriteArtefact, HasProvenanceAndTimingAndKeepsTheOlderFileOnAnError) {
  const auto folder = test::scratch_path("write_artefact_test");
  std::filesystem::create_directories(folder);
  const auto output = folder / "a.h5", input = folder / "a.toml";
  write_whole_file(input, "x = 1\n");
  StepClock clock;
  clock.lap("step");
  CommonOptions common;
  common.depfile = folder / "a.d";
  write_artefact(output, {"clatter/test/1", "x = 1\n", {input}}, clock, common,
                 [](H5File& file) { file.write("x", std::vector<double>{1.0}); });
  EXPECT_THROW(write_artefact(output, {"clatter/test/1", "", {}}, clock, {},
                              [](H5File&) { throw NumericsError("not converged"); }),
               NumericsError);
  EXPECT_FALSE(exists(folder / "a.h5.part"));
  const H5File file = open_artefact(output, "clatter/test/1");
  EXPECT_EQ(file.read_doubles("x"), std::vector<double>{1.0});
  EXPECT_EQ(file.get_string("/", "config"), "x = 1\n");
  EXPECT_EQ(file.read_strings("inputs/sha256"), std::vector<std::string>{sha256_of_file(input)});
  EXPECT_EQ(file.read_strings("timing/step"), std::vector<std::string>{"step"});
  std::stringstream text;
  text << std::ifstream(common.depfile).rdbuf();
  EXPECT_EQ(text.str(), output.string() + ": " + input.string() + "\n" + input.string() + ":\n");
  std::filesystem::remove_all(folder);
}

TEST(CommandLine, TheDepfileNamesEachInputTwice) {
  const auto path = test::scratch_path("depfile_test.d");
  write_depfile(path, "a.h5", {"a.toml", "b.csv"});
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "a.h5: a.toml b.csv\na.toml:\nb.csv:\n");
  std::filesystem::remove(path);
}

TEST(ErrorPositions, AreParsedFromTheMessage) {
  const auto folder = test::scratch_path("error_positions: 7");
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
