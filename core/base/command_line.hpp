// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Command-line options common to all executables: --help, --version, --threads, --quiet, --json,
// --depfile.
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

/// Declares and parses the arguments of an executable. An invalid command line gives exit code 2.
class CommandLine {
 public:
  /// `summary` describes the stage in one sentence; `epilog` holds sample commands and references.
  CommandLine(const std::string& program, const std::string& summary, const std::string& epilog);
  ~CommandLine();

  /// Input files; parse() registers them in core/base/planned_files.hpp.
  void positional(const std::string& name, std::filesystem::path& value, const std::string& help,
                  bool required = true);
  void positional(const std::string& name, std::vector<std::filesystem::path>& value,
                  const std::string& help, bool required = true);
  void option(const std::string& flags, std::filesystem::path& value, const std::string& help,
              bool required = false);
  /// Output files; parse() refuses those that are also inputs and those that cannot be written.
  void output(const std::string& flags, std::filesystem::path& value, const std::string& help,
              bool required = false);
  void output(const std::string& flags, std::vector<std::filesystem::path>& value,
              const std::string& help);
  void option(const std::string& flags, std::string& value, const std::string& help);
  void option(const std::string& flags, std::vector<std::string>& value, const std::string& help);
  void option(const std::string& flags, double& value, const std::string& help);
  void option(const std::string& flags, int& value, const std::string& help);
  void flag(const std::string& flags, bool& value, const std::string& help);

  /// Declares --blas NAME|auto, for stages that call ensure_fast_blas(); parse() reports it.
  void blas();
  /// Declares --memory-limit GIB, for stages that use core/base/memory_limit.hpp; parse() sets it.
  /// `effect`: what happens at the limit.
  void memory_limit(const std::string& effect =
                        "fewer Lanczos vectors, then vectors on disk; refused when it cannot be");

  /// Parses; returns false when the program should end at once with exit_code() (help, version, or
  /// an invalid command line, already reported). Applies --quiet and --threads.
  bool parse(int argc, char** argv);
  int exit_code() const;
  const CommonOptions& common() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes "target: input input ..." for make. No effect when `depfile` is empty.
void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs);

}  // namespace clatter
