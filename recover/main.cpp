// SPDX-License-Identifier: GPL-3.0-or-later
// clatter-recover: from reduced coordinates to surface velocity, spectra, levels and radiated
// power.
#include "core/base/blas_kernel.hpp"
#include "core/base/command_line.hpp"
#include "core/base/config.hpp"
#include "core/base/log.hpp"
#include "core/base/planned_files.hpp"
#include "core/base/write_artefact.hpp"
#include "core/keys/describe.hpp"
#include "recover/listen_command.hpp"
#include "recover/recover.hpp"
#include "recover/sound/sound_options.hpp"
#include "recover/sound_command.hpp"

namespace {

std::string epilog() {
  return "Samples:\n"
         "  clatter-recover slap.run.h5 -o slap.field.h5\n"
         "  clatter-recover slap.run.h5 -c slap.field.toml -o slap.field.h5\n"
         "  clatter-recover sound block.rom.h5 -o block.sound.h5\n"
         "  clatter-recover listen slap.field.h5 slap.wav\n"
         "Open slap.field.xdmf (time) and slap.field.lines.xdmf (frequencies) in ParaView.\n"
         "What may be in a field.toml: clatter-recover keys field.toml";
}

struct Arguments {
  std::filesystem::path run, config, output;
};

void recover_run(const Arguments& a, const clatter::CommonOptions& common) {
  using namespace clatter;
  will_write("--output", recover::frame_export_path(a.output));
  will_write("--output", recover::line_export_path(a.output));
  StepClock clock;
  const Config config = a.config.empty() ? Config::parse("", "defaults") : Config::load(a.config);
  const recover::Options options = recover::field_keys().read(config);
  const std::string resolved = recover::field_keys().toml_of(options);
  say("options:\n" + resolved);
  const recover::RunBody body(a.run, options.body);
  const rom::ReducedModel model = body.read_model();
  clock.lap("read");

  std::vector<std::filesystem::path> inputs{a.run, body.rom_path()};
  if (!a.config.empty()) inputs.push_back(a.config);
  if (!options.sound.empty()) inputs.push_back(options.sound);
  recover::Summary summary;
  write_artefact(
      a.output, {recover::kFieldSchema, resolved, inputs}, clock, common,
      [&](H5File& file) { summary = recover::recover(body, model, options, file, clock); },
      [&] { recover::write_exports(a.output, summary); });
  print_result(recover::summary_text(summary));
  print_json_result(a.output, recover::json_of(summary), clock, common);
}

}  // namespace

int main(int argc, char** argv) {
  clatter::ensure_fast_blas(argv);
  clatter::CommandLine line(
      "clatter-recover",
      "Recovers surface displacement, velocity and radiated power of one body of a run.", epilog());
  Arguments a;
  line.positional("run", a.run, "run file, slap.run.h5");
  line.option("-c,--config", a.config, "what to recover, slap.field.toml; defaults without it");
  line.output("-o,--output", a.output, "field file, slap.field.h5", true);
  clatter::recover::declare_sound(line);
  clatter::recover::declare_listen(line);
  clatter::keys::add_keys_command(
      line, {&clatter::recover::field_keys().table(), &clatter::recover::sound_keys().table()});
  line.action([&a](const clatter::CommonOptions& common) { recover_run(a, common); });
  return line.run(argc, argv);
}
