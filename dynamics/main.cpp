// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-dynamics: runs a scene in the time domain.
#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <filesystem>

#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/stopwatch.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/gas_cycle.hpp"
#include "dynamics/run/run_file.hpp"

namespace {

using namespace clatter;
using namespace clatter::dynamics;

constexpr const char* kEpilog =
    R"(A scene is a TOML file: [engine] [rod] [piston] [block] [gas] [contact] [[mount]] for piston slap,
or [[body]] and [[load]] for any reduced bodies without an engine. `base = "other.toml"` takes all
keys that a scene does not set from another scene, so a variant is a few lines:

    base = "slap.run.toml"
    [contact]
    lubrication = "none"

dynamics/README.md lists every key, the equations and the error test. Ctrl-C or SIGTERM stops after a step with a valid
file, stem.run.interrupted.h5 (attribute complete = 0); --resume continues from the last finished cycle.

sample commands
  clatter-dynamics slap.run.toml -o slap.run.h5
  clatter-dynamics slap.run.toml -o slap.run.h5 --resume
  clatter-dynamics --write-motored-cycle motored.csv --bore-mm 107 --stroke-mm 130 --rod-mm 210 \
      --compression-ratio 17 --exponent 1.34

see also: clatter-condense (makes .rom.h5), clatter-recover (surface velocity from .run.h5))";

std::atomic<bool> stop_requested{false};

void request_stop(int) { stop_requested.store(true); }

struct Arguments {
  std::filesystem::path scene, output, motored;
  bool resume = false;
  MotoredCycle cycle;
  double bore_mm = 107.0, stroke_mm = 130.0, rod_mm = 210.0, offset_mm = 0.0, intake_bar = 1.0,
         closed_deg = 180.0, step_deg = 1.0;
};

void declare(CommandLine& line, Arguments& a) {
  line.positional("scene", a.scene, "the scene, stem.run.toml", false);
  line.output("-o,--output", a.output, "the run file to write; default: the scene's stem.run.h5");
  line.flag("--resume", a.resume,
            "continue from the checkpoint beside the output, if it belongs to this scene");
  line.output("--write-motored-cycle", a.motored,
              "write a motored cycle's pressure table and exit");
  line.option("--bore-mm", a.bore_mm, "motored cycle: bore [mm]");
  line.option("--stroke-mm", a.stroke_mm, "motored cycle: stroke [mm]");
  line.option("--rod-mm", a.rod_mm, "motored cycle: rod length [mm]");
  line.option("--pin-offset-mm", a.offset_mm, "motored cycle: pin offset [mm]");
  line.option("--compression-ratio", a.cycle.compression_ratio, "motored cycle: ratio");
  line.option("--exponent", a.cycle.exponent, "motored cycle: polytropic exponent");
  line.option("--intake-bar", a.intake_bar, "motored cycle: pressure at valve closing [bar]");
  line.option("--closed-deg", a.closed_deg,
              "motored cycle: valves closed within +- this of TDC [deg]");
  line.option("--step-deg", a.step_deg, "motored cycle: rows every ... [deg]");
}

int write_table(Arguments& a) {
  a.cycle.bore = 1e-3 * a.bore_mm;
  a.cycle.stroke = 1e-3 * a.stroke_mm;
  a.cycle.rod_length = 1e-3 * a.rod_mm;
  a.cycle.pin_offset = 1e-3 * a.offset_mm;
  a.cycle.intake_pressure = 1e5 * a.intake_bar;
  a.cycle.valves_closed_half = kDegree * a.closed_deg;
  write_motored_cycle(a.motored, a.cycle, kDegree * a.step_deg);
  print_result(fmt::format("{}: peak {:.2f} bar", a.motored.string(),
                           1e-5 * motored_pressure(a.cycle, 0.0)));
  return 0;
}

std::filesystem::path default_output(const std::filesystem::path& scene) {
  return std::filesystem::path(scene).replace_extension(".h5");
}

// Only a complete run gets the requested name, which make and recover treat as finished.
constexpr const char *kFailed = ".failed.h5", *kInterrupted = ".interrupted.h5";

std::filesystem::path written_file(std::filesystem::path output, const RunResult& result) {
  if (!result.failure.empty()) return output.replace_extension(kFailed);
  if (!result.complete) return output.replace_extension(kInterrupted);
  return output;
}

void print_summary(const RunResult& result, const Arguments& a, double seconds) {
  print_result("effects (seconds of their elements):");
  for (const auto& row : result.model->effects.lines(true)) print_result(row);
  const StepStatistics& s = result.statistics;
  print_result(fmt::format(
      "steps: {} accepted, {} rejected by error, {} by Newton, {} refused; {:.3g} to {:.3g} "
      "s; {} evaluations, {} factorisations",
      s.accepted, s.rejected_error, s.rejected_newton, s.rejected_refused, s.smallest_step,
      s.largest_step, s.evaluations, s.factorizations));
  for (const auto& [reason, count] : s.refusals)
    print_result(fmt::format("  refused {}x: {}", count, reason));
  print_result(fmt::format(
      "seconds: {:.2f} stepping, of which elements {:.2f}, factorisations {:.2f}, operators "
      "{:.2f}; {:.2f} in total",
      s.total_seconds, s.element_seconds, s.factor_seconds, s.operator_seconds, seconds));
  for (const std::string& text : periodicity_lines(result.periodicity)) print_result(text);
  print_result(fmt::format("energy residue: {:.2e} of {:.4g} J exchanged", result.energy_residue,
                           result.energy_exchanged));
  say(fmt::format("{} written", a.output.string()));
}

int run(const Arguments& a, const CommonOptions& common) {
  const auto checkpoint = checkpoint_path(a.output);
  will_write("--output", checkpoint);
  for (const char* ending : {kFailed, kInterrupted})
    will_write("--output", std::filesystem::path(a.output).replace_extension(ending));
  StepClock clock;
  const Scene scene = read_scene(a.scene);
  const LoadedBodies bodies = load_bodies(scene);
  clock.lap("read and modal bodies");
  say("effects:");
  for (const auto& row : build_model(scene, bodies)->effects.lines(false)) say(row);

  const std::string mark = fingerprint(scene);
  RunControl control;
  control.stop = &stop_requested;
  control.checkpoint = [&](const Checkpoint& point) { write_checkpoint(checkpoint, point, mark); };
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
  const RunResult result = simulate(scene, bodies, control);
  clock.lap("integration");
  for (const std::string& warning : result.warnings) warn(warning);

  const auto output = written_file(a.output, result);
  H5File file = H5File::create(output);
  write_run(file, scene, bodies, result);
  clock.lap("writing");
  write_timing(file, clock);
  file.commit();
  if (!result.failure.empty()) {
    throw NumericsError(
        fmt::format("{}; the results up to there are in {}", result.failure, output.string()));
  }
  if (!result.complete) {
    throw NumericsError(fmt::format(
        "{}: interrupted after {} complete cycles, the results so far are in {}; continue "
        "with --resume",
        a.output.string(), result.cycles, output.string()));
  }
  std::filesystem::remove(checkpoint);
  std::filesystem::remove(written_file(a.output, {}));
  write_depfile(common.depfile, a.output, scene.inputs);
  print_summary(result, a, clock.total_seconds());
  if (common.json) {
    print_json({{"output", json_text(a.output.string())},
                {"steps", json_number(static_cast<double>(result.statistics.accepted))},
                {"energy_residue", json_number(result.energy_residue)},
                {"seconds", json_number(clock.total_seconds())}});
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  ensure_fast_blas(argv);
  Arguments arguments;
  CommandLine line("clatter-dynamics",
                   "Runs a scene of reduced elastic bodies, joints and a lubricated piston-liner "
                   "contact in the time domain.",
                   kEpilog);
  declare(line, arguments);
  line.blas();
  if (!line.parse(argc, argv)) return line.exit_code();
  return run_guarded("clatter-dynamics", [&] {
    if (!arguments.motored.empty()) return write_table(arguments);
    if (arguments.scene.empty())
      throw InputError("no scene given, expected stem.run.toml (see --help)");
    if (arguments.output.empty()) {
      arguments.output = default_output(arguments.scene);
      will_write("--output by default", arguments.output);
    }
    return run(arguments, line.common());
  });
}
