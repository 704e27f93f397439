// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/listen_command.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/write_artefact.hpp"
#include "recover/sound/wav.hpp"

namespace clatter::recover {
namespace {

struct ListenArguments {
  std::filesystem::path field, wav;
  std::string microphone = "plus_y";
  WavRule rule;
};

void listen(const ListenArguments& a, const CommonOptions& common) {
  constexpr double kLongest = 600.0;  // [s], 58 MB
  constexpr double kShortest = 0.01;  // [s]
  if (!(a.rule.seconds >= kShortest && a.rule.seconds <= kLongest) ||
      !(a.rule.full_scale_pa >= 0.0))
    throw InputError(fmt::format(
        "command line: found --seconds {:g} --full-scale-pa {:g}, expected {:g} to {:g} s and a "
        "positive pressure",
        a.rule.seconds, a.rule.full_scale_pa, kShortest, kLongest));
  write_exports({a.wav, {a.wav}, {a.field}}, common, [&] {
    const WavSummary made = write_wav(a.field, a.microphone, a.rule, a.wav);
    return fmt::format("{}, up to {:g} Hz: peak {:.3g} Pa, RMS {:.3g} Pa, full scale {:.4g} Pa",
                       a.microphone, made.to_hz, made.peak_pa, made.rms_pa, made.full_scale_pa);
  });
}

}  // namespace

void declare_listen(CommandLine& program) {
  CommandLine& line = program.command(
      "listen",
      "Writes the sound of a run at a microphone as a WAV file: its cycle repeated, or its first "
      "window.",
      "Samples:\n"
      "  clatter-recover listen slap.field.h5 slap.wav\n"
      "  clatter-recover listen slap.field.h5 slap.wav --microphone top --full-scale-pa 2\n"
      "The field needs `sound` in its field.toml. To compare runs by ear give them the same full "
      "scale.");
  const auto a = std::make_shared<ListenArguments>();
  line.positional("field", a->field, "field file with sound, slap.field.h5");
  line.output("wav", a->wav, "16 bits, 48 kHz, one channel", true);
  line.option("--microphone", a->microphone, "its name, default plus_y");
  line.option("--seconds", a->rule.seconds, "length, default 4");
  line.option("--full-scale-pa", a->rule.full_scale_pa,
              "pressure of the largest sample; default: 1.25 times the peak");
  line.action([a](const CommonOptions& common) { listen(*a, common); });
}

}  // namespace clatter::recover
