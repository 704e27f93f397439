// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "core/base/artefact.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/refusal.hpp"
#include "core/base/threads.hpp"
#include "core/base/whole_file.hpp"

namespace clatter {

struct CommandLine::Impl {
  CLI::App app;
  CommonOptions common;
  std::string program;
  bool with_blas = false;
  std::string blas;
  double memory_gib = 0.0;
  int exit_code = 0;
  std::vector<std::pair<CLI::Option*, std::function<std::vector<std::filesystem::path>()>>> inputs,
      outputs;

  /// Registers inputs and outputs in core/base/planned_files.hpp.
  void plan_files() const {
    for (const auto& [option, paths] : inputs)
      if (option->count() > 0)
        for (const auto& path : paths()) will_read(path);
    for (const auto& [option, paths] : outputs)
      if (option->count() > 0)
        for (const auto& path : paths()) will_write(option->get_name(), path);
  }

  void refuse(const char* what) {
    exit_code = report_error(program, fmt::format("{} (see {} --help)", what, program),
                             ExitCode::kBadInput);
  }
};

namespace {

using Paths = std::vector<std::filesystem::path>;

Paths paths_of(const std::filesystem::path& value) { return {value}; }
Paths paths_of(const Paths& value) { return value; }

/// Adds an option whose value, one path or several, is recorded in `role`.
template <class Role, class Value>
CLI::Option* add(CLI::App& app, Role& role, const std::string& flags, Value& value,
                 const std::string& help) {
  CLI::Option* option = app.add_option(flags, value, help);
  role.emplace_back(option, [&value] { return paths_of(value); });
  return option;
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& summary,
                         const std::string& epilog)
    : impl_(std::make_unique<Impl>()) {
  impl_->program = program;
  auto& app = impl_->app;
  app.name(program);
  app.description(summary);
  app.footer(epilog);
  app.set_version_flag("--version", program + " " + version());
  app.add_option("--threads", impl_->common.threads, "threads to use; 0 means all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--quiet", impl_->common.quiet, "results, warnings and errors only");
  app.add_flag("--json", impl_->common.json,
               "print the results, or the error, as one machine-readable line on stdout");
  output("--depfile", impl_->common.depfile, "write the files that were read, for make");
}

CommandLine::~CommandLine() = default;

void CommandLine::positional(const std::string& name, std::filesystem::path& value,
                             const std::string& help, bool required) {
  add(impl_->app, impl_->inputs, name, value, help)->required(required);
}

void CommandLine::positional(const std::string& name, std::vector<std::filesystem::path>& value,
                             const std::string& help, bool required) {
  add(impl_->app, impl_->inputs, name, value, help)->required(required);
}

void CommandLine::option(const std::string& flags, std::filesystem::path& value,
                         const std::string& help, bool required) {
  add(impl_->app, impl_->inputs, flags, value, help)->required(required);
}

void CommandLine::output(const std::string& flags, std::filesystem::path& value,
                         const std::string& help, bool required) {
  add(impl_->app, impl_->outputs, flags, value, help)->required(required);
}

void CommandLine::output(const std::string& flags, std::vector<std::filesystem::path>& value,
                         const std::string& help) {
  add(impl_->app, impl_->outputs, flags, value, help);
}

void CommandLine::option(const std::string& flags, std::vector<std::string>& value,
                         const std::string& help) {
  impl_->app.add_option(flags, value, help)->allow_extra_args(false);
}

void CommandLine::option(const std::string& flags, std::string& value, const std::string& help) {
  impl_->app.add_option(flags, value, help)->capture_default_str();
}

void CommandLine::option(const std::string& flags, double& value, const std::string& help) {
  impl_->app.add_option(flags, value, help)->capture_default_str();
}

void CommandLine::option(const std::string& flags, int& value, const std::string& help) {
  impl_->app.add_option(flags, value, help)->capture_default_str();
}

void CommandLine::flag(const std::string& flags, bool& value, const std::string& help) {
  impl_->app.add_flag(flags, value, help);
}

void CommandLine::memory_limit(const std::string& effect) {
  impl_->app
      .add_option("--memory-limit", impl_->memory_gib,
                  "GiB that the process may take (default: the machine's): " + effect)
      ->check(CLI::PositiveNumber);
}

void CommandLine::blas() {
  impl_->with_blas = true;
  impl_->app.add_option("--blas", impl_->blas,
                        "OpenBLAS kernel, overrides OPENBLAS_CORETYPE: a name (Haswell, "
                        "SkylakeX, Zen ...), or auto for the best one of this CPU");
}

bool CommandLine::parse(int argc, char** argv) {
  // --json also applies to errors in the command line.
  set_json(std::find(argv, argv + argc, std::string_view("--json")) != argv + argc);
  try {
    impl_->app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      impl_->app.exit(error);
    } else {
      impl_->refuse(error.what());
    }
    return false;
  }
  try {
    impl_->plan_files();
  } catch (const Error& error) {
    impl_->exit_code = report_error(impl_->program, error.what(), error.code());
    return false;
  }
  set_quiet(impl_->common.quiet);
  set_json(impl_->common.json);
  set_thread_count(impl_->common.threads);
  set_memory_limit_gib(impl_->memory_gib);
  set_blas_threads(thread_count());
  try {
    if (impl_->with_blas) report_blas(impl_->blas);
  } catch (const InputError& error) {
    impl_->refuse(error.what());
    return false;
  }
  return true;
}

int CommandLine::exit_code() const { return impl_->exit_code; }

const CommonOptions& CommandLine::common() const { return impl_->common; }

void write_depfile(const std::filesystem::path& depfile, const std::filesystem::path& target,
                   const std::vector<std::filesystem::path>& inputs) {
  if (depfile.empty()) return;
  WholeFile file(depfile);
  std::ostream& stream = file.stream();
  stream << target.string() << ":";
  for (const auto& input : inputs) stream << " " << input.string();
  stream << "\n";
  // A deleted input must not stop make: each is also a target without a recipe.
  for (const auto& input : inputs) stream << input.string() << ":\n";
  file.commit();
}

}  // namespace clatter
