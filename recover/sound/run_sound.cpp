// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/run_sound.hpp"

#include <fmt/format.h>

#include <cmath>

#include "recover/field/field_values.hpp"

namespace clatter::recover {
namespace {

constexpr double kPressureReference = 20e-6;  // [Pa] ISO 1683

/// Sum over the lines from `from_hz`, A-weighted or not.
double total(const Eigen::VectorXd& frequency_hz, const Eigen::VectorXd& power, double from_hz,
             bool weighted) {
  double sum = 0.0;
  for (Eigen::Index k = 0; k < power.size(); ++k)
    if (frequency_hz[k] >= from_hz)
      sum += power[k] * (weighted ? a_weighting_power(frequency_hz[k]) : 1.0);
  return sum;
}

/// Number of lines up to the end of the table.
Eigen::Index lines_of_table(const SoundTable& table, const LineSpectrum& velocity) {
  Eigen::Index count = 0;
  while (count < velocity.frequency_hz.size() && covers(table, velocity.frequency_hz[count]))
    ++count;
  return count;
}

MicrophoneResult microphone_result(const std::string& name, const Eigen::VectorXcd& pressure,
                                   const Analysis& analysis, const Options& options, double to_hz) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::Index lines = pressure.size();
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(lines);
  const Eigen::VectorXd squares =
      velocity.power_factor.head(lines).cwiseProduct(pressure.cwiseAbs2());
  const ThirdOctaves bands = third_octaves(options.spectrum.from_hz, to_hz, velocity.spacing_hz());
  const double reference = kPressureReference * kPressureReference;
  const double from_hz = options.spectrum.from_hz;
  return {name, pressure,
          levels_db(band_sums(frequency_hz, squares, bands, velocity.periodic), reference),
          level_db(total(frequency_hz, squares, from_hz, false), reference),
          level_db(total(frequency_hz, squares, from_hz, true), reference)};
}

}  // namespace

RunSound run_sound(const SoundTable& table, const Analysis& analysis, const PanelResult& erp,
                   const Options& options) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::Index lines = lines_of_table(table, velocity);
  RunSound out{.to_hz = table.to_hz(), .power = erp.erp};
  Eigen::MatrixXcd pressure = Eigen::MatrixXcd::Zero(table.distance.size(), lines);
  for (Eigen::Index k = 0; k < lines; ++k) {
    const double f = velocity.frequency_hz[k];
    out.power[k] = 0.0;
    if (!(f > 0.0)) continue;  // a motion at 0 Hz radiates nothing
    const Eigen::VectorXcd v = velocity.amplitude.row(k).transpose();
    const Eigen::MatrixXd R = resistance_at(table, f);
    const double form = v.real().dot(R * v.real()) + v.imag().dot(R * v.imag());
    // Interpolation between semidefinite matrices may leave rounding of the size of its error.
    out.power[k] = velocity.power_factor[k] * std::max(form, 0.0);
    pressure.col(k) = microphones_at(table, f) * v;
  }
  const Eigen::VectorXd weighted =
      out.power.cwiseProduct(velocity.frequency_hz.unaryExpr(&a_weighting_power));
  const auto sums = [&](const Eigen::VectorXd& power) {
    return band_sums(velocity.frequency_hz, power, analysis.bands, velocity.periodic);
  };
  out.band_db = levels_db(sums(out.power), options.references.power);
  out.band_dba = levels_db(sums(weighted), options.references.power);
  out.total = total(velocity.frequency_hz, out.power, options.spectrum.from_hz, false);
  out.total_a = total(velocity.frequency_hz, out.power, options.spectrum.from_hz, true);
  for (size_t m = 0; m < table.microphones.size(); ++m)
    out.microphones.push_back(microphone_result(
        table.microphones[m].name, pressure.row(static_cast<Eigen::Index>(m)).transpose(), analysis,
        options, std::min(out.to_hz, velocity.frequency_hz.maxCoeff())));
  return out;
}

void write_run_sound(H5File& file, const Analysis& analysis, const RunSound& sound,
                     const LevelReferences& references) {
  const std::string at = "analysis/" + analysis.piece.name + "/sound";
  put(file, at + "/power", sound.power, "W",
      "radiated sound power per line; above boundary_elements_to_hz the ERP");
  put_level(file, at + "/third_octave/power_db", sound.band_db, references.power, "W",
            "sound power per third octave of the analysis");
  put_level(file, at + "/third_octave/power_dba", sound.band_dba, references.power, "W",
            "A-weighted sound power per third octave, weighted line by line");
  file.set(at, "boundary_elements_to_hz", sound.to_hz);
  file.set(at, "power_w", sound.total);
  file.set(at, "power_db", level_db(sound.total, references.power));
  file.set(at, "power_dba", level_db(sound.total_a, references.power));
  for (const MicrophoneResult& microphone : sound.microphones) {
    const std::string name = at + "/microphones/" + microphone.name;
    put_complex<Eigen::VectorXd>(file, name + "/pressure", microphone.pressure, "Pa",
                                 "pressure per line up to boundary_elements_to_hz");
    put_level(file, name + "/third_octave/pressure_db", microphone.band_db, kPressureReference,
              "Pa", "sound pressure, the first third octaves of the analysis");
    file.set(name, "pressure_db", microphone.total_db);
    file.set(name, "pressure_dba", microphone.total_dba);
  }
}

std::string sound_summary(const RunSound& sound, const LevelReferences& references) {
  std::string text = fmt::format(
      "sound power {:.1f} dB, {:.1f} dB(A) re 1 pW (boundary elements up to {:g} Hz, ERP above)\n",
      level_db(sound.total, references.power), level_db(sound.total_a, references.power),
      sound.to_hz);
  for (const MicrophoneResult& microphone : sound.microphones)
    text += fmt::format("microphone {:<14} {:.1f} dB, {:.1f} dB(A) re 20 uPa\n", microphone.name,
                        microphone.total_db, microphone.total_dba);
  return text;
}

}  // namespace clatter::recover
