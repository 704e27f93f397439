#pragma once
// The command line that all executables share: --help, --version, --threads, --quiet, --json,
// --depfile.
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace clatter {

/// Options that every stage has.
struct CommonOptions {
  int threads = 0;  // 0: all cores
  bool quiet = false;
  bool json = false;              // results or error as one machine-readable line on stdout
  std::filesystem::path depfile;  // make-style list of the files that were read
};

/// Declares and parses one executable's arguments. A wrong command line ends with exit code 2.
class CommandLine {
 public:
  /// `summary` says in a sentence what the stage does; `epilog` teaches: sample commands, see-also.
  CommandLine(const std::string& program, const std::string& summary, const std::string& epilog);
  ~CommandLine();

  /// Files that are read: parse() says so to core/base/planned_files.hpp.
  void positional(const std::string& name, std::filesystem::path& value, const std::string& help,
                  bool required = true);
  void positional(const std::string& name, std::vector<std::filesystem::path>& value,
                  const std::string& help, bool required = true);
  void option(const std::string& flags, std::filesystem::path& value, const std::string& help,
              bool required = false);
  /// Files that are written: parse() refuses those that are also read, and those that cannot be.
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
  /// Declares --memory-limit GIB, for stages that ask core/base/memory_limit.hpp; parse() sets it.
  /// `effect`: what happens at the limit.
  void memory_limit(const std::string& effect =
                        "fewer Lanczos vectors, then vectors on disk; refused when it cannot be");

  /// Parses; returns false when the program should end at once with exit_code() (help, version, or
  /// a wrong command line, already reported). Applies --quiet and --threads.
  bool parse(int argc, char** argv);
  int exit_code() const;
  const CommonOptions& common() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes "target: input input ..." for make. Nothing happens when `depfile` is empty.
void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs);

}  // namespace clatter
