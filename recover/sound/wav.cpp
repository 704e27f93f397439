// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/wav.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/artefact.hpp"
#include "core/base/error.hpp"
#include "core/base/whole_file.hpp"
#include "recover/field/field_file.hpp"

namespace clatter::recover {
namespace {

/// The piece of the run that is heard: the cycle, else the first window with pressures at
/// microphones, which means over segments have not.
std::string heard_piece(const H5File& file) {
  std::vector<std::string> pieces = file.list("analysis");
  std::ranges::stable_partition(pieces, [](const std::string& name) { return name == "cycle"; });
  for (const std::string& name : pieces)
    if (const std::string at = "analysis/" + name;
        file.has(at + "/sound/microphones") && file.get_int(at, "averages") == 1)
      return name;
  throw InputError(fmt::format(
      "{}: analysis: found no microphones, expected a field with a cycle or a window in "
      "one segment and `sound` in its field.toml",
      file.path().string()));
}

/// Appends the lowest bytes of a number, the lowest first.
void append_little_endian(std::string& bytes, uint32_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 0xFF));
}

Eigen::VectorXcd read_pressure(const H5File& file, const std::string& piece,
                               const std::string& microphone) {
  const std::string group = "analysis/" + piece + "/sound/microphones";
  const std::vector<std::string> names = file.list(group);
  if (std::find(names.begin(), names.end(), microphone) == names.end())
    throw InputError(fmt::format("{}: microphones: found [{}], expected {}", file.path().string(),
                                 fmt::join(names, ", "), microphone));
  const std::string at = group + "/" + microphone;
  const Eigen::VectorXd re = file.read_vector(at + "/pressure_re");
  const Eigen::VectorXd im = file.read_vector(at + "/pressure_im");
  if (re.size() != im.size() || !re.allFinite() || !im.allFinite())
    throw InputError(
        fmt::format("{}: {}: found parts of {} and {} values, expected as many finite "
                    "ones",
                    file.path().string(), at, re.size(), im.size()));
  Eigen::VectorXcd pressure(re.size());
  pressure.real() = re;
  pressure.imag() = im;
  return pressure;
}

}  // namespace

Eigen::VectorXd repeated_cycle(const Eigen::VectorXcd& pressure, double spacing_hz,
                               double seconds) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(std::lround(seconds * kWavRate));
  for (Eigen::Index n = 0; n < out.size(); ++n) {
    const double turn = 2.0 * std::numbers::pi * spacing_hz * static_cast<double>(n) / kWavRate;
    const std::complex<double> step = std::polar(1.0, turn);
    std::complex<double> phase = step;  // line 0 is no sound
    for (Eigen::Index k = 1; k < pressure.size(); ++k, phase *= step)
      out[n] += pressure[k].real() * phase.real() - pressure[k].imag() * phase.imag();
  }
  return out;
}

std::string wav_bytes(const Eigen::VectorXd& pressure, double full_scale_pa) {
  const double peak = pressure.size() > 0 ? pressure.cwiseAbs().maxCoeff() : 0.0;
  if (peak > full_scale_pa)
    throw InputError(
        fmt::format("WAV: found a full scale of {:.4g} Pa, expected at least the peak "
                    "of {:.4g} Pa",
                    full_scale_pa, peak));
  const auto size = static_cast<uint32_t>(2 * pressure.size());
  std::string bytes = "RIFF";
  append_little_endian(bytes, 36 + size, 4);
  bytes += "WAVEfmt ";
  append_little_endian(bytes, 16, 4);
  append_little_endian(bytes, 1, 2);  // PCM
  append_little_endian(bytes, 1, 2);  // channel
  append_little_endian(bytes, kWavRate, 4);
  append_little_endian(bytes, 2 * kWavRate, 4);
  append_little_endian(bytes, 2, 2);
  append_little_endian(bytes, 16, 2);
  bytes += "data";
  append_little_endian(bytes, size, 4);
  for (double p : pressure) {
    const double scaled = full_scale_pa > 0.0 ? p / full_scale_pa : 0.0;
    append_little_endian(bytes, static_cast<uint32_t>(std::lround(32767.0 * scaled)), 2);
  }
  return bytes;
}

WavSummary write_wav(const std::filesystem::path& field, const std::string& microphone,
                     const WavRule& rule, const std::filesystem::path& wav) {
  const H5File file = open_artefact(field, kFieldSchema);
  const std::string piece = heard_piece(file);
  const Eigen::VectorXcd lines = read_pressure(file, piece, microphone);
  const double spacing_hz = file.get_double("analysis/" + piece, "line_spacing_hz");
  const Eigen::VectorXd pressure = repeated_cycle(lines, spacing_hz, rule.seconds);
  WavSummary out{.full_scale_pa = rule.full_scale_pa,
                 .peak_pa = pressure.cwiseAbs().maxCoeff(),
                 .rms_pa = std::sqrt(pressure.squaredNorm() / static_cast<double>(pressure.size())),
                 .to_hz = spacing_hz * static_cast<double>(lines.size() - 1)};
  if (out.full_scale_pa == 0.0) out.full_scale_pa = 1.25 * out.peak_pa;
  write_whole_file(wav, wav_bytes(pressure, out.full_scale_pa));
  return out;
}

}  // namespace clatter::recover
