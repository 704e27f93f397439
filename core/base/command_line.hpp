// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The command line of an executable: its usual job, its further commands, and the options common to
// all: --help, --version, --threads, --quiet, --json, --depfile.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace clatter {

/// Options of every stage.
struct CommonOptions {
  int threads = 0;  // 0: all cores
  bool quiet = false;
  bool json = false;              // results or error as one machine-readable line on stdout
  std::filesystem::path depfile;  // make-style list of the files read
};

/// Declares, parses and runs the arguments of an executable, or of one command of it:
///   clatter-modal block.fe.h5 -o block.modes.h5             the usual job, without a command
///   clatter-modal statics block.fe.h5 -o block.static.h5    the command `statics`
/// An invalid command line gives exit code 2.
class CommandLine {
 public:
  using Action = std::function<void(const CommonOptions&)>;

  /// `summary` describes the stage in one sentence; `epilog` holds sample commands and references.
  CommandLine(const std::string& program, const std::string& summary, const std::string& epilog);
  ~CommandLine();

  /// Adds a command, which is chosen when its name is the first argument (a file of that name is
  /// ./name). It has its own help and options, and the common ones; it lives as long as the
  /// program.
  CommandLine& command(const std::string& name, const std::string& summary,
                       const std::string& epilog);
  /// `flag` was an option that is now a command: the error message of the usual job gives
  /// `instead`, the command line to use.
  void moved(const std::string& flag, const std::string& instead);
  /// What run() does after parsing; each line and each command has one.
  void action(Action action);

  /// Input files; run() registers them in core/base/planned_files.hpp.
  void positional(const std::string& name, std::filesystem::path& value, const std::string& help,
                  bool required = true);
  void option(const std::string& flags, std::filesystem::path& value, const std::string& help,
              bool required = false);
  /// A word that is no file, which may be left out.
  void word(const std::string& name, std::string& value, const std::string& help);
  /// Output files, options or positional; run() refuses those that are also inputs and those that
  /// cannot be written.
  void output(const std::string& flags, std::filesystem::path& value, const std::string& help,
              bool required = false);
  void output(const std::string& flags, std::vector<std::filesystem::path>& value,
              const std::string& help, bool required = false);
  void option(const std::string& flags, std::string& value, const std::string& help);
  void option(const std::string& flags, std::vector<std::string>& value, const std::string& help);
  void option(const std::string& flags, double& value, const std::string& help);
  void option(const std::string& flags, int& value, const std::string& help);
  void flag(const std::string& flags, bool& value, const std::string& help);

  /// Declares --blas NAME|auto, for stages that call ensure_fast_blas(); run() reports it.
  void blas();
  /// Declares --memory-limit GIB, for stages that use core/base/memory_limit.hpp; run() sets it.
  /// `effect`: what happens at the limit.
  void memory_limit(const std::string& effect =
                        "fewer Lanczos vectors, then vectors on disk; refused when it cannot be");

  /// Parses, applies the common options and calls the action of the chosen command; returns the
  /// exit code. Every error is one line on stderr (core/base/error.hpp).
  int run(int argc, char** argv);
  /// The same, but errors are the caller's, as in programs of several processes.
  int run_or_throw(int argc, char** argv);

 private:
  struct Impl;
  explicit CommandLine(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter
