// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound_command.hpp"

#include <fmt/format.h>

#include "core/base/log.hpp"
#include "core/base/write_artefact.hpp"
#include "recover/sound/sound_file.hpp"

namespace clatter::recover {
namespace {

struct SoundArguments {
  std::filesystem::path rom, config, output;
};

JsonMembers json_of(const PartSound& sound) {
  JsonMembers members{
      {"frequencies", json_number(static_cast<double>(sound.table.samples.size()))},
      {"microphones", json_number(static_cast<double>(sound.table.microphones.size()))},
      {"to_hz", json_number(sound.table.to_hz())}};
  for (const auto& [name, value] : certificate_numbers(sound.certificate))
    members.emplace_back(name, json_number(value));
  return members;
}

void print(const PartSound& sound) {
  print_result(fmt::format("{} frequencies from {:g} to {:g} Hz, {} coordinates",
                           sound.table.samples.size(), sound.table.from_hz(), sound.table.to_hz(),
                           sound.table.size()));
  for (const Microphone& microphone : sound.table.microphones)
    print_result(fmt::format("microphone {:<12} ({:.3f}, {:.3f}, {:.3f}) m", microphone.name,
                             microphone.position[0], microphone.position[1],
                             microphone.position[2]));
  for (const auto& [name, value] : certificate_numbers(sound.certificate))
    print_result(fmt::format("{} = {:.4g}", name, value));
}

void make_sound(const SoundArguments& a, const CommonOptions& common) {
  StepClock clock;
  const Config config = a.config.empty() ? Config::parse("", "defaults") : Config::load(a.config);
  SoundOptions options = sound_keys().read(config);
  options.set = options.chosen_set();
  const std::string resolved = sound_keys().toml_of(options);
  say("options:\n" + resolved);
  const rom::ReducedModel model = rom::read_reduced_model(a.rom);
  const std::string rom_sha256 = sha256_of_file(a.rom);
  clock.lap("read");
  const EarlierSamples earlier = [&](const PartSound& sound) {
    return earlier_samples(a.output, rom_sha256, sound);
  };
  const PartSound sound =
      with_context(a.rom.string(), [&] { return part_sound(model, options, clock, earlier); });
  std::vector<std::filesystem::path> inputs{a.rom};
  if (!a.config.empty()) inputs.push_back(a.config);
  write_artefact(a.output, {kSoundSchema, resolved, inputs}, clock, common,
                 [&](H5File& file) { write_sound(file, sound, options, rom_sha256); });
  print(sound);
  print_json_result(a.output, json_of(sound), clock, common);
}

}  // namespace

void declare_sound(CommandLine& program) {
  CommandLine& line = program.command(
      "sound",
      "Computes the sound that a part radiates, per reduced velocity, by boundary elements.",
      "Samples:\n"
      "  clatter-recover sound block.rom.h5 -o block.sound.h5\n"
      "  clatter-recover sound block.rom.h5 -c block.sound.toml -o block.sound.h5\n"
      "Once per part; then name it in a field.toml, `sound = \"block.sound.h5\"`: every run of the "
      "part\ngets sound power and pressures at the microphones in a second.\n"
      "Where the output is there already, from the same part, skin and space, only its microphones "
      "and new\nfrequencies are computed.\n"
      "What may be in a sound.toml: clatter-recover keys sound.toml.");
  const auto a = std::make_shared<SoundArguments>();
  line.positional("rom", a->rom, "reduced part with a skin, block.rom.h5");
  line.option("-c,--config", a->config, "options, block.sound.toml; defaults without it");
  line.output("-o,--output", a->output, "sound file, block.sound.h5", true);
  line.blas();
  line.memory_limit("refused when the matrices need more");
  line.action([a](const CommonOptions& common) { make_sound(*a, common); });
}

}  // namespace clatter::recover
