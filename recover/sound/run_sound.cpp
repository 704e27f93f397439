// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/run_sound.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/sound/spherical_harmonics.hpp"
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

/// Power by R, which has no part that is not reciprocal [W].
Eigen::VectorXd resistance_power(const SoundTable& table, const LineSpectrum& velocity,
                                 Eigen::Index lines) {
  Eigen::VectorXd power = Eigen::VectorXd::Zero(lines);
  for (Eigen::Index k = 0; k < lines; ++k) {
    if (!(velocity.frequency_hz[k] > 0.0)) continue;  // a motion at 0 Hz radiates nothing
    const Eigen::VectorXcd v = velocity.amplitude.row(k).transpose();
    const Eigen::MatrixXd R = resistance_at(table, velocity.frequency_hz[k]);
    power[k] = velocity.power_factor[k] * (v.real().dot(R * v.real()) + v.imag().dot(R * v.imag()));
  }
  return power;
}

/// Of the line where it is largest, over the sum of all lines.
double relative_difference(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const double sum = other.sum();
  return sum > 0.0 ? (one - other).cwiseAbs().maxCoeff() / sum : 0.0;
}

/// Pressures at the microphones, n_m x lines [Pa].
Eigen::MatrixXcd pressures(const SoundTable& table, const LineSpectrum& velocity,
                           Eigen::Index lines) {
  Eigen::MatrixXcd pressure = Eigen::MatrixXcd::Zero(table.distance.size(), lines);
  for (Eigen::Index k = 0; k < lines; ++k)
    if (const double f = velocity.frequency_hz[k]; f > 0.0)
      pressure.col(k) = microphones_at(table, f) * velocity.amplitude.row(k).transpose();
  return pressure;
}

/// Sets the levels of a microphone from its mean squares.
void set_levels(const Analysis& analysis, const Options& options, const ThirdOctaves& bands,
                MicrophoneResult& microphone) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::VectorXd& squares = microphone.square;
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(squares.size());
  const double reference = kPressureReference * kPressureReference;
  const double from_hz = options.spectrum.from_hz;
  microphone.band_db =
      levels_db(band_sums(frequency_hz, squares, bands, velocity.periodic), reference);
  microphone.total_db = level_db(total(frequency_hz, squares, from_hz, false), reference);
  microphone.total_dba = level_db(total(frequency_hz, squares, from_hz, true), reference);
}

/// What the segments of a piece send, their powers averaged.
struct MeanLines {
  LineSums sums{};
  Eigen::VectorXd power{}, by_R{};  // per line [W]: with the ERP above the table; by resistance
  std::vector<MicrophoneResult> microphones{};
  LevelError error{};  // of the power
};

MeanLines mean_lines(const SoundTable& table, const Analysis& analysis,
                     const std::function<SegmentLines(int64_t k)>& segment, const PanelParts& parts,
                     const Eigen::MatrixXd& harmonics, double from_hz) {
  const LineSpectrum& axis = analysis.velocity;
  const Eigen::Index lines = lines_of_table(table, axis);
  const int64_t count = analysis.piece.segments();
  MeanLines out{.power = Eigen::VectorXd::Zero(axis.frequency_hz.size()),
                .by_R = Eigen::VectorXd::Zero(lines)};
  for (const auto& microphone : table.microphones)
    out.microphones.push_back({.name = microphone.name, .square = Eigen::VectorXd::Zero(lines)});
  SegmentTotals radiated(from_hz);
  std::vector<SegmentTotals> heard(out.microphones.size(), SegmentTotals(from_hz));
  for (int64_t k = 0; k < count; ++k) {
    SegmentLines now = segment(k);
    LineSums sums = line_sums(table, now.velocity, parts, harmonics);
    // Interpolation between squares may leave rounding of the size of its error.
    now.erp.head(lines) = sums.power.cwiseMax(0.0);
    radiated.add(axis.frequency_hz, now.erp);
    out.power += now.erp;
    out.by_R += resistance_power(table, now.velocity, lines);
    const Eigen::MatrixXcd pressure = pressures(table, now.velocity, lines);
    for (size_t m = 0; m < out.microphones.size(); ++m) {
      MicrophoneResult& microphone = out.microphones[m];
      const Eigen::VectorXcd p = pressure.row(static_cast<Eigen::Index>(m)).transpose();
      const Eigen::VectorXd square = axis.power_factor.head(lines).cwiseProduct(p.cwiseAbs2());
      heard[m].add(axis.frequency_hz, square);
      microphone.square += square / static_cast<double>(count);
      if (count == 1) microphone.pressure = p;
    }
    if (k == 0)
      out.sums = std::move(sums);
    else
      out.sums += sums;
  }
  const double n = static_cast<double>(count);
  out.sums /= n;
  out.power /= n;
  out.by_R /= n;
  const double averages = equivalent_averages(analysis.piece);
  out.error = radiated.error(averages);
  for (size_t m = 0; m < heard.size(); ++m) out.microphones[m].error = heard[m].error(averages);
  return out;
}

SurfaceResult surface_result(const SoundTable& table, const Analysis& analysis,
                             const Options& options, const ThirdOctaves& bands,
                             const RunSound& sound) {
  const MeasurementSurface& surface = table.surface;
  const size_t count = surface.microphones.size();
  if (count == 0) return {};
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::Index lines = lines_of_table(table, velocity);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(lines);
  for (size_t m = 0; m < count; ++m) squares += sound.microphones[m].square;
  squares /= static_cast<double>(count);
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(lines);
  const double reference = kPressureReference * kPressureReference;
  SurfaceResult out{.name = name_of(surface.set), .area = surface.area};
  const double to_power = 10.0 * std::log10(surface.area);  // over 1 m2
  const auto raised = [to_power](double db) { return db > kSilence ? db + to_power : kSilence; };
  out.band_pressure_db =
      levels_db(band_sums(frequency_hz, squares, bands, velocity.periodic), reference);
  out.band_power_db = out.band_pressure_db.unaryExpr(raised);
  const double from_hz = options.spectrum.from_hz;
  out.pressure_db = level_db(total(frequency_hz, squares, from_hz, false), reference);
  out.power_db = raised(out.pressure_db);
  const double by_R = total(frequency_hz, sound.power.head(lines), from_hz, false);
  if (by_R > 0.0) out.above_power_db = out.power_db - level_db(by_R, options.references.power);
  return out;
}

void write_surface(H5File& file, const std::string& at, const SurfaceResult& surface,
                   const LevelReferences& references) {
  if (surface.name.empty()) return;
  put_level(file, at + "/third_octave/pressure_db", surface.band_pressure_db, kPressureReference,
            "Pa",
            "mean square sound pressure of the microphones of the set, the first third "
            "octaves of the analysis");
  put_level(file, at + "/third_octave/power_db", surface.band_power_db, references.power, "W",
            "sound power level from these pressures, 10 lg(S / 1 m2) added");
  file.set(at, "set", surface.name);
  file.set(at, "area_m2", surface.area);
  file.set(at, "pressure_db", surface.pressure_db);
  file.set(at, "power_db", surface.power_db);
  file.set(at, "above_boundary_elements_db", surface.above_power_db);
}

/// Level and share; a panel that takes up power has a share alone.
std::string panel_line(const PanelSound& sound, size_t panel, const LevelReferences& references) {
  const auto p = static_cast<Eigen::Index>(panel);
  const double share = sound.all > 0.0 ? 100.0 * sound.total[p] / sound.all : 0.0;
  const std::string level =
      sound.total[p] > 0.0
          ? fmt::format("{:.1f} dB re 1 pW", level_db(sound.total[p], references.power))
          : "takes up power";
  return fmt::format("sound of panel {:<18} {:>17}, {:.1f} %\n", sound.panels[panel], level, share);
}

}  // namespace

RunSound run_sound(const SoundTable& table, const Analysis& analysis,
                   const std::function<SegmentLines(int64_t k)>& segment, const PanelParts& parts,
                   const Options& options) {
  const LineSpectrum& velocity = analysis.velocity;
  const int degree = far_degree(table);
  const sound::Directions directions = sound::sphere_directions(degree);
  MeanLines mean =
      mean_lines(table, analysis, segment, parts,
                 sound::spherical_harmonics(directions.unit, degree), options.spectrum.from_hz);
  LineSums& sums = mean.sums;
  RunSound out{.to_hz = table.to_hz(), .power = mean.power};
  out.error = mean.error;
  out.resistance_difference = relative_difference(mean.by_R, sums.power);
  const Eigen::VectorXd weighted =
      out.power.cwiseProduct(velocity.frequency_hz.unaryExpr(&a_weighting_power));
  const auto in_bands = [&](const Eigen::VectorXd& power) {
    return band_sums(velocity.frequency_hz, power, analysis.bands, velocity.periodic);
  };
  out.band_db = levels_db(in_bands(out.power), options.references.power);
  out.band_dba = levels_db(in_bands(weighted), options.references.power);
  out.total = total(velocity.frequency_hz, out.power, options.spectrum.from_hz, false);
  out.total_a = total(velocity.frequency_hz, out.power, options.spectrum.from_hz, true);
  const ThirdOctaves bands = bands_of_table(table, analysis, options);
  out.microphones = std::move(mean.microphones);
  for (MicrophoneResult& microphone : out.microphones)
    set_levels(analysis, options, bands, microphone);
  out.surface = surface_result(table, analysis, options, bands, out);
  out.directivity = directivity(table, velocity, sums, directions, bands);
  out.panels = panel_sound(analysis, parts, std::move(sums), bands, options);
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
  set_level_error(file, at, "power", sound.error);
  if (analysis.piece.has_energy()) {
    const double duration = analysis.piece.duration_s();
    file.set(at, "energy_j", sound.total * duration);
    file.set(at, "energy_db", level_db(sound.total * duration, references.power));
    file.set(at, "energy_dba", level_db(sound.total_a * duration, references.power));
  }
  for (const MicrophoneResult& microphone : sound.microphones) {
    const std::string name = at + "/microphones/" + microphone.name;
    const std::string meaning = "pressure per line up to boundary_elements_to_hz";
    if (analysis.piece.segments() == 1)
      put_complex<Eigen::VectorXd>(file, name + "/pressure", microphone.pressure, "Pa", meaning);
    else
      put(file, name + "/pressure_power", microphone.square, "Pa2",
          "mean square " + meaning + ", averaged over the segments");
    put_level(file, name + "/third_octave/pressure_db", microphone.band_db, kPressureReference,
              "Pa", "sound pressure, the first third octaves of the analysis");
    file.set(name, "pressure_db", microphone.total_db);
    file.set(name, "pressure_dba", microphone.total_dba);
    set_level_error(file, name, "pressure", microphone.error);
  }
  write_surface(file, at + "/measurement_surface", sound.surface, references);
  write_panel_sound(file, analysis.piece.name, sound.panels, references);
  write_directivity(file, analysis.piece.name, sound.directivity);
}

std::string sound_summary(const RunSound& sound, const Piece& piece,
                          const LevelReferences& references) {
  std::string text = fmt::format(
      "sound power {:.1f} dB, {:.1f} dB(A) re 1 pW (boundary elements up to {:g} Hz, ERP above)\n",
      level_db(sound.total, references.power), level_db(sound.total_a, references.power),
      sound.to_hz);
  if (piece.has_energy())
    text += fmt::format("sound energy {:.1f} dB, {:.1f} dB(A) re 1 pJ\n",
                        level_db(sound.total * piece.duration_s(), references.power),
                        level_db(sound.total_a * piece.duration_s(), references.power));
  for (const MicrophoneResult& microphone : sound.microphones)
    text += fmt::format("microphone {:<14} {:.1f} dB, {:.1f} dB(A) re 20 uPa\n", microphone.name,
                        microphone.total_db, microphone.total_dba);
  if (const SurfaceResult& surface = sound.surface; !surface.name.empty())
    text += fmt::format(
        "{}: {:.1f} dB on {:.3g} m2, a sound power of {:.1f} dB, {:+.1f} dB from that of boundary "
        "elements\n",
        surface.name, surface.pressure_db, surface.area, surface.power_db, surface.above_power_db);
  for (size_t p = 0; p < sound.panels.panels.size(); ++p)
    text += panel_line(sound.panels, p, references);
  return text;
}

}  // namespace clatter::recover
