// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/run_command.hpp"

#include <fmt/format.h>

#include <atomic>
#include <csignal>

#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/write_artefact.hpp"
#include "dynamics/run/run_file.hpp"
#include "dynamics/run/run_summary.hpp"

namespace clatter::dynamics {
namespace {

std::atomic<bool> stop_requested{false};

void request_stop(int) { stop_requested.store(true); }

struct RunArguments {
  std::filesystem::path scene, output;
  bool resume = false;
};

/// Stops on signals, writes checkpoints, and continues from one where that was requested.
RunControl control_of(const RunArguments& a, const Scene& scene) {
  const std::filesystem::path checkpoint = checkpoint_path(a.output);
  const std::string mark = fingerprint(scene);
  RunControl control;
  control.stop = &stop_requested;
  control.checkpoint = [=](const Checkpoint& point) { write_checkpoint(checkpoint, point, mark); };
  control.film_every = scene.film_every;
  control.label = fmt::format("integrating {}", a.scene.stem().stem().string());
  if (a.resume) control.resume_from = read_checkpoint(checkpoint, mark);
  if (control.resume_from) {
    say(fmt::format("resuming after cycle {}", control.resume_from->cycle));
  } else if (a.resume && std::filesystem::exists(checkpoint)) {
    say(fmt::format("{} belongs to another scene, other inputs or another program: starting again",
                    checkpoint.string()));
  }
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, request_stop);
  return control;
}

void run_scene(const RunArguments& a, const CommonOptions& common) {
  plan_run_files(a.output);
  StepClock clock;
  const Scene scene = read_scene(a.scene);
  const LoadedBodies bodies = load_bodies(scene);
  clock.lap("read and modal bodies");
  say("effects:");
  for (const auto& row : build_model(scene, bodies)->effects.lines(false)) say(row);

  const RunResult result = simulate(scene, bodies, control_of(a, scene));
  clock.lap("integration");
  for (const std::string& warning : result.warnings) warn(warning);

  CommonOptions finished = common;
  if (!is_finished(result)) finished.depfile.clear();  // for make the run is still to be done
  write_artefact(written_file(a.output, result), provenance_of(scene), clock, finished,
                 [&](H5File& file) {
                   write_run(file, scene, bodies, result);
                   clock.lap("writing");
                 });
  require_finished(result, a.output);
  remove_unfinished(a.output);
  for (const std::string& line : describe(result, clock.total_seconds())) print_result(line);
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
  line.blas();
  line.action([a](const CommonOptions& common) {
    if (a->output.empty()) {
      a->output = std::filesystem::path(a->scene).replace_extension(".h5");
      will_write("--output by default", a->output);
    }
    run_scene(*a, common);
  });
}

}  // namespace clatter::dynamics
