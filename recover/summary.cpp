// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clatter::recover {

namespace {

/// Of the displacements, and of a set that only turns of the rotations.
std::string peaks_of(const SensorResult& result) {
  const std::vector<int>& turns = result.sensor->is_rotation;
  const bool moves = std::ranges::count(turns, 0) > 0;
  double peak = 0.0;
  for (Eigen::Index c = 0; c < result.acceleration.cols(); ++c)
    if ((turns[static_cast<size_t>(c)] == 0) == moves)
      peak = std::max(peak, result.acceleration.col(c).cwiseAbs().maxCoeff());
  return fmt::format("sensor {:<17} peak acceleration {:.4g} {}\n", result.sensor->name, peak,
                     moves ? "m/s2" : "rad/s2");
}

}  // namespace

bool has_sound(const Summary& summary) {
  return !summary.sounds.empty() && summary.sounds.front().power.size() > 0;
}

JsonMembers json_of(const Summary& summary) {
  const PanelResult& skin = summary.analyses.front().panels.front();
  JsonMembers members{{"faces", json_number(static_cast<double>(summary.n_faces))},
                      {"frames", json_number(static_cast<double>(summary.frames.size()))},
                      {"lines", json_number(static_cast<double>(summary.lines.size()))},
                      {"erp_w", json_number(skin.total_erp)},
                      {"erp_db", json_number(level_db(skin.total_erp, 1e-12))},
                      {"spectra_to_hz", json_number(summary.limit.to_hz)}};
  if (has_sound(summary)) {
    const RunSound& sound = summary.sounds.front();
    const double reference = summary.options.references.power;
    members.emplace_back("sound_power_w", json_number(sound.total));
    members.emplace_back("sound_power_db", json_number(level_db(sound.total, reference)));
    members.emplace_back("sound_power_dba", json_number(level_db(sound.total_a, reference)));
    if (const Piece& piece = summary.analyses.front().piece; piece.has_energy()) {
      const double duration = piece.duration_s();
      members.emplace_back("sound_energy_db",
                           json_number(level_db(sound.total * duration, reference)));
      members.emplace_back("sound_energy_dba",
                           json_number(level_db(sound.total_a * duration, reference)));
    }
  }
  return members;
}

namespace {

/// How the energy of a window follows from its power, and whether the window holds all of it.
std::string energy_text(const Analysis& analysis) {
  constexpr double kOver = 0.01;
  const double duration = analysis.piece.duration_s(), left = last_tenth_share(analysis);
  const std::string means = fmt::format("powers are means over {:.4g} s", duration);
  if (left > kOver)
    return fmt::format(
        "{}; the motion goes on at their end: the last tenth has {:.2g} % of its "
        "energy, and a longer window has more\n",
        means, 100.0 * left);
  return fmt::format(
      "{}: the energy level is the power level {:+.2f} dB re 1 pJ, of any window "
      "that holds the event\n",
      means, level_db(duration, 1.0));
}

/// "'mean': sound power 91.9 dB(A) +- 0.3 dB re 1 pW (8 cycles)" of each mean over segments.
std::string means_text(const Summary& summary) {
  std::string text;
  for (size_t i = 0; i < summary.analyses.size(); ++i) {
    const Analysis& analysis = summary.analyses[i];
    const Piece& piece = analysis.piece;
    if (piece.segments() == 1) continue;
    const auto add = [&](const std::string& what, double power, const LevelError& error) {
      text += fmt::format("'{}': {} {:.1f} dB(A){} re 1 pW ({} {})\n", piece.name, what,
                          level_db(power, summary.options.references.power),
                          error.dba ? fmt::format(" +- {:.2f} dB", *error.dba) : "",
                          piece.segments(), piece.is_mean_of_cycles() ? "cycles" : "segments");
    };
    const PanelResult& panel = radiating_panel(analysis.panels);
    add("ERP of " + panel.name, panel.total_erp_a, panel.erp_error);
    if (has_sound(summary)) add("sound power", summary.sounds[i].total_a, summary.sounds[i].error);
  }
  return text;
}

}  // namespace

std::string summary_text(const Summary& summary) {
  const Analysis& analysis = summary.analyses.front();
  const LevelReferences& ref = summary.options.references;
  std::string text =
      fmt::format("'{}': {} samples, lines every {:.4g} Hz up to {:.5g} Hz ({})\n",
                  analysis.piece.name, analysis.piece.count, analysis.velocity.spacing_hz(),
                  summary.limit.to_hz, summary.limit.reason);
  text += fmt::format("{:<24}{:>11}{:>14}{:>13}{:>13}\n", "panel", "area [m2]", "v_n rms [m/s]",
                      "ERP [dB]", "ERP [dB(A)]");
  for (const PanelResult& panel : analysis.panels) {
    const double mean_square =
        panel.total_erp / equivalent_radiated_power(summary.options.air, panel.area, 1.0);
    text += fmt::format("{:<24}{:>11.4g}{:>14.4g}{:>13.1f}{:>13.1f}\n", panel.name, panel.area,
                        std::sqrt(mean_square), level_db(panel.total_erp, ref.power),
                        level_db(panel.total_erp_a, ref.power));
  }
  text +=
      fmt::format("ERP re 1 pW, rho c = {:.1f} Pa s/m, radiation loss factor {:g}; from {:g} Hz\n",
                  summary.options.air.density * summary.options.air.sound_speed,
                  summary.options.air.loss_factor, summary.options.spectrum.from_hz);
  if (has_sound(summary)) text += sound_summary(summary.sounds.front(), analysis.piece, ref);
  if (analysis.piece.has_energy()) text += energy_text(analysis);
  text += means_text(summary);
  for (const SensorResult& result : analysis.sensors) text += peaks_of(result);
  for (const auto& [name, value] : certificate_numbers(summary.certificate))
    text += fmt::format("{} = {:.4g}\n", name, value);
  text += fmt::format("{} frames of the skin, {} complex lines", summary.frames.size(),
                      summary.lines.size());
  return text;
}

}  // namespace clatter::recover
