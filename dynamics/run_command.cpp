// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>

#include "core/base/blas_kernel.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/write_artefact.hpp"
#include "dynamics/effects_command.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/run_size.hpp"
#include "dynamics/run/run_summary.hpp"

namespace clatter::dynamics {
namespace {

std::atomic<bool> stop_requested{false};

void request_stop(int) { stop_requested.store(true); }

struct RunArguments {
  std::filesystem::path scene, output;
  bool resume = false, effects = false;
  double checkpoint_seconds = RunControl().checkpoint_seconds;
};

/// From here on SIGINT, SIGTERM and SIGXCPU, a limit of processor time (hard case P15), end the run
/// after a step; an ignored signal stays ignored.
void stop_on_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGXCPU}) {
    if (std::signal(signal, request_stop) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
}

/// NumericsError when a signal came while there is nothing to write yet.
void require_no_stop(const std::filesystem::path& output) {
  if (stop_requested.load())
    throw NumericsError(
        fmt::format("{}: interrupted before the first step, nothing was written", output.string()));
}

/// Where a run with --resume begins.
std::string resume_text(const RunControl& control, const std::filesystem::path& output) {
  const std::filesystem::path checkpoint = checkpoint_path(output);
  if (const auto& from = control.resume_from)
    return from->cycle > 0 ? fmt::format("resuming after cycle {}", from->cycle)
                           : fmt::format("resuming at {:.6g} s", from->state.time);
  if (std::filesystem::exists(checkpoint))
    return fmt::format(
        "{} belongs to another scene, other inputs or another program: starting again",
        checkpoint.string());
  return fmt::format(
      "{}: nothing to resume, there is no checkpoint (one is written after each cycle, without "
      "cycles every {:g} s): the run starts at its beginning",
      output.string(), control.checkpoint_seconds);
}

/// Stops on signals, and continues from a checkpoint where that was requested.
RunControl control_of(const RunArguments& a, const Scene& scene) {
  const std::filesystem::path checkpoint = checkpoint_path(a.output);
  RunControl control;
  control.output = a.output;
  control.stop = &stop_requested;
  control.checkpoint_seconds = a.checkpoint_seconds;
  control.label = fmt::format("integrating {}", a.scene.stem().stem().string());
  if (a.resume) control.resume_from = read_checkpoint(checkpoint, fingerprint(scene));
  if (a.resume) say(resume_text(control, a.output));
  return control;
}

Reader reader_of(int stream) { return isatty(stream) != 0 ? Reader::kTerminal : Reader::kFile; }

void run_scene(const RunArguments& a, const CommonOptions& common) {
  if (!(a.checkpoint_seconds >= 0.0))
    throw InputError(
        fmt::format("--checkpoint-seconds: found {:g}, expected 0 or more", a.checkpoint_seconds));
  stop_on_signals();
  plan_run_files(a.output);
  StepClock clock;
  const Scene scene = read_scene(a.scene);
  const LoadedBodies bodies = load_bodies(scene);
  clock.lap("read and modal bodies");
  say("effects:");
  const auto model = build_model(scene, bodies);
  for (const auto& row : effect_rows(model->effects, false, reader_of(STDERR_FILENO))) say(row);
  const std::string size = check_size(scene, predict_size(scene, bodies), a.output);
  if (!size.empty()) say(size);
  require_no_stop(a.output);

  const RunResult result = simulate(scene, bodies, control_of(a, scene));
  clock.lap("integration");
  for (const std::string& warning : result.warnings) warn(warning);

  CommonOptions finished = common;
  if (!is_finished(result)) finished.depfile.clear();  // for make the run is still to be done
  write_run(scene, bodies, result);
  clock.lap("writing");
  finish_artefact(*result.file, written_file(a.output, result), provenance_of(scene), clock,
                  finished);
  require_finished(result, a.output);
  remove_unfinished(a.output);
  for (const std::string& line : describe(result, clock.total_seconds(), reader_of(STDOUT_FILENO)))
    print_result(line);
  say(fmt::format("{} written", a.output.string()));
  print_json_result(a.output, json_of(result), clock, common);
}

}  // namespace

void declare_run(CommandLine& line) {
  const auto a = std::make_shared<RunArguments>();
  line.positional("scene", a->scene, "the scene, stem.run.toml");
  line.output("-o,--output", a->output, "the run file to write; default: the scene's stem.run.h5");
  line.flag("--resume", a->resume,
            "continue from the checkpoint beside the output, if it belongs to this scene");
  line.option("--checkpoint-seconds", a->checkpoint_seconds,
              "of a scene without cycles: between checkpoints, at least; 0: as often as they take "
              "5 % of the time");
  line.flag("--effects", a->effects,
            "print the effects of the scene with equations, switches and predicted cost, and do "
            "not run it; a run of it at the output gives its measured seconds instead");
  line.blas();
  line.action([a](const CommonOptions& common) {
    const bool named = !a->output.empty();
    if (!named) a->output = std::filesystem::path(a->scene).replace_extension(".h5");
    set_blas_threads(1);  // the matrices of a stage are too small for more
    if (a->effects) return print_effects(a->scene, a->output);
    if (!named) will_write("--output by default", a->output);
    run_scene(*a, common);
  });
}

}  // namespace clatter::dynamics
