// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/base/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <string_view>

#include "core/base/artefact.hpp"
#include "core/base/blas_kernel.hpp"
#include "core/base/error.hpp"
#include "core/base/large_pages.hpp"
#include "core/base/log.hpp"
#include "core/base/memory_limit.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/threads.hpp"

namespace clatter {

struct CommandLine::Impl {
  std::unique_ptr<CLI::App> own;  // of the program; the commands are part of it
  CLI::App& app;
  std::string title;  // "clatter-modal statics"
  CommonOptions common;
  bool with_blas = false;
  std::string blas;
  double memory_gib = 0.0;
  Action action;
  std::vector<CLI::Option*> required;
  std::vector<std::pair<CLI::Option*, std::function<std::vector<std::filesystem::path>()>>> inputs,
      outputs;
  std::vector<std::unique_ptr<CommandLine>> commands;
  std::map<std::string, std::string> moved;

  Impl(std::unique_ptr<CLI::App> program, const std::string& name)
      : own(std::move(program)), app(*own), title(name) {}
  Impl(CLI::App& command, const std::string& full_name) : app(command), title(full_name) {}

  /// The line of the command that the first argument names, or this one; the others are disabled,
  /// because CLI11 would find their names among files too.
  Impl& choose(const std::string& first) {
    Impl* chosen = this;
    for (const auto& command : commands) {
      const bool named = command->impl_->app.get_name() == first;
      command->impl_->app.disabled(!named);
      if (named) chosen = command->impl_.get();
    }
    if (chosen != this)
      for (CLI::Option* option : required) option->required(false);
    return *chosen;
  }

  /// Registers inputs and outputs in core/base/planned_files.hpp.
  void plan_files() const {
    for (const auto& [option, paths] : inputs)
      if (option->count() > 0)
        for (const auto& path : paths()) will_read(path);
    for (const auto& [option, paths] : outputs)
      if (option->count() > 0)
        for (const auto& path : paths()) will_write(option->get_name(), path);
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{} (see {} --help)", what, title));
  }

  /// Parses for the chosen line; false when help or the version was printed.
  bool parse(Impl& chosen, int argc, char** argv) {
    try {
      app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
      if (error.get_exit_code() == 0) {
        app.exit(error);
        return false;
      }
      for (int i = 1; i < argc; ++i)
        if (const auto found = chosen.moved.find(argv[i]); found != chosen.moved.end())
          chosen.refuse(fmt::format("{} is now a command: {}", found->first, found->second));
      chosen.refuse(error.what());
    }
    return true;
  }

  void apply() const {
    plan_files();
    set_quiet(common.quiet);
    set_json(common.json);
    set_thread_count(common.threads);
    set_memory_limit_gib(memory_gib);
    keep_freed_memory();
    set_blas_threads(thread_count());
    reserve_blas_memory();
    try {
      if (with_blas) report_blas(blas);
    } catch (const InputError& error) {
      refuse(error.what());
    }
  }
};

namespace {

using Paths = std::vector<std::filesystem::path>;

Paths paths_of(const std::filesystem::path& value) { return {value}; }
Paths paths_of(const Paths& value) { return value; }

/// Adds an option whose value, one path or several, is recorded in `role`.
template <class Lists, class Role, class Value>
void add(Lists& lists, Role& role, const std::string& flags, Value& value, const std::string& help,
         bool required) {
  CLI::Option* option = lists.app.add_option(flags, value, help)->required(required);
  role.emplace_back(option, [&value] { return paths_of(value); });
  if (required) lists.required.push_back(option);
}

}  // namespace

CommandLine::CommandLine(const std::string& program, const std::string& summary,
                         const std::string& epilog)
    : CommandLine(std::make_unique<Impl>(std::make_unique<CLI::App>(summary, program), program)) {
  impl_->app.footer(epilog);
  impl_->app.set_version_flag("--version", program + " " + version());
}

CommandLine::CommandLine(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  CLI::App& app = impl_->app;
  app.add_option("--threads", impl_->common.threads, "threads to use; 0 means all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  app.add_flag("--quiet", impl_->common.quiet, "results, warnings and errors only");
  app.add_flag("--json", impl_->common.json,
               "print the results, or the error, as one machine-readable line on stdout");
  output("--depfile", impl_->common.depfile, "write the files that were read, for make");
}

CommandLine::~CommandLine() = default;

CommandLine& CommandLine::command(const std::string& name, const std::string& summary,
                                  const std::string& epilog) {
  CLI::App* app = impl_->app.add_subcommand(name, summary);
  app->group("Commands (each has --help)");
  app->footer(epilog);
  auto impl = std::make_unique<Impl>(*app, impl_->title + " " + name);
  impl_->commands.emplace_back(new CommandLine(std::move(impl)));
  return *impl_->commands.back();
}

void CommandLine::moved(const std::string& flag, const std::string& instead) {
  impl_->moved[flag] = instead;
}

void CommandLine::action(Action action) { impl_->action = std::move(action); }

void CommandLine::positional(const std::string& name, std::filesystem::path& value,
                             const std::string& help, bool required) {
  add(*impl_, impl_->inputs, name, value, help, required);
}

void CommandLine::option(const std::string& flags, std::filesystem::path& value,
                         const std::string& help, bool required) {
  add(*impl_, impl_->inputs, flags, value, help, required);
}

void CommandLine::word(const std::string& name, std::string& value, const std::string& help) {
  impl_->app.add_option(name, value, help);
}

void CommandLine::output(const std::string& flags, std::filesystem::path& value,
                         const std::string& help, bool required) {
  add(*impl_, impl_->outputs, flags, value, help, required);
}

void CommandLine::output(const std::string& flags, std::vector<std::filesystem::path>& value,
                         const std::string& help, bool required) {
  add(*impl_, impl_->outputs, flags, value, help, required);
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

int CommandLine::run(int argc, char** argv) {
  return run_guarded(impl_->app.get_name(), [&] { return run_or_throw(argc, argv); });
}

int CommandLine::run_or_throw(int argc, char** argv) {
  // --json also applies to errors in the command line.
  set_json(std::find(argv, argv + argc, std::string_view("--json")) != argv + argc);
  Impl& chosen = impl_->choose(argc > 1 ? argv[1] : "");
  if (!impl_->parse(chosen, argc, argv)) return 0;
  chosen.apply();
  chosen.action(chosen.common);
  return 0;
}

}  // namespace clatter
