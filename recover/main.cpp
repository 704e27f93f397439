// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-recover: from reduced coordinates to surface velocity, spectra, levels and radiated
// power.
#include <fmt/format.h>

#include "core/base/artefact.hpp"
#include "core/base/command_line.hpp"
#include "core/base/config.hpp"
#include "core/base/error.hpp"
#include "core/base/json_line.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "recover/recover.hpp"

namespace {

namespace fs = std::filesystem;
using namespace clatter;

constexpr const char* kSummary =
    "Recovers surface displacement, velocity and radiated power of one body of a run.";

std::string epilog() {
  return "Samples:\n"
         "  clatter-recover slap.run.h5 -o slap.field.h5\n"
         "  clatter-recover slap.run.h5 -c slap.field.toml -o slap.field.h5\n"
         "Open slap.field.xdmf (time) and slap.field.lines.xdmf (frequencies) in ParaView.\n\n" +
         recover::options_help();
}

void print_summary(const fs::path& output, const recover::Summary& summary, double seconds) {
  const recover::PanelResult& skin = summary.analyses.front().panels.front();
  print_json({{"output", json_text(output.string())},
              {"faces", json_number(static_cast<double>(summary.n_faces))},
              {"frames", json_number(static_cast<double>(summary.frames.size()))},
              {"lines", json_number(static_cast<double>(summary.line_hz.size()))},
              {"erp_w", json_number(skin.total_erp)},
              {"erp_db", json_number(recover::level_db(skin.total_erp, 1e-12))},
              {"spectra_to_hz", json_number(summary.limit.to_hz)},
              {"seconds", json_number(seconds)}});
}

int recover_run(int argc, char** argv) {
  CommandLine line("clatter-recover", kSummary, epilog());
  fs::path input, settings, output;
  line.positional("run", input, "run file, slap.run.h5");
  line.option("-c,--config", settings, "what to recover, slap.field.toml; defaults without it");
  line.output("-o,--output", output, "field file, slap.field.h5", true);
  if (!line.parse(argc, argv)) return line.exit_code();

  will_write("--output", recover::frame_export_path(output));
  will_write("--output", recover::line_export_path(output));
  StepClock clock;
  const Config config = settings.empty() ? Config::parse("", "defaults") : Config::load(settings);
  const recover::Options options = recover::read_options(config);
  const std::string resolved = recover::resolved_text(options);
  say("options:\n" + resolved);
  const recover::RunBody body(input, options.body);
  const rom::ReducedModel model = body.read_model();
  clock.lap("read");

  H5File file = H5File::create(output);
  const recover::Summary summary = recover::recover(body, model, options, file, clock);
  std::vector<fs::path> inputs{input, body.rom_path()};
  if (!settings.empty()) inputs.push_back(settings);
  write_provenance(file, {recover::kFieldSchema, resolved, inputs});
  write_timing(file, clock);
  file.commit();
  recover::write_exports(output, summary);
  write_depfile(line.common().depfile, output, inputs);

  print_result(recover::summary_text(summary));
  if (line.common().json) print_summary(output, summary, clock.total_seconds());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return clatter::run_guarded("clatter-recover", [&] { return recover_run(argc, argv); });
}
