// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/panel_sound.hpp"

#include <cmath>

#include "recover/field/field_file.hpp"
#include "recover/field/field_values.hpp"

namespace clatter::recover {
namespace {

/// Sums over lines into bands of each entry.
std::vector<Eigen::MatrixXd> band_exchange(const LineSpectrum& velocity, const ThirdOctaves& bands,
                                           const std::vector<Eigen::MatrixXd>& lines) {
  const Eigen::Index n = lines.empty() ? 0 : lines.front().rows();
  const auto n_l = static_cast<Eigen::Index>(lines.size());
  std::vector<Eigen::MatrixXd> out(static_cast<size_t>(bands.size()), Eigen::MatrixXd::Zero(n, n));
  Eigen::VectorXd line(n_l);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b) {
      for (Eigen::Index k = 0; k < n_l; ++k) line[k] = lines[k](a, b);
      const Eigen::VectorXd sums =
          band_sums(velocity.frequency_hz.head(n_l), line, bands, velocity.periodic);
      for (Eigen::Index band = 0; band < bands.size(); ++band) out[band](a, b) = sums[band];
    }
  return out;
}

}  // namespace

PanelSound panel_sound(const Analysis& analysis, const PanelParts& parts, LineSums sums,
                       const ThirdOctaves& bands, const Options& options) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::Index lines = sums.power.size();
  const auto n_p = static_cast<Eigen::Index>(parts.panels.size());
  PanelSound out{.panels = parts.panels,
                 .power = Eigen::MatrixXd(lines, n_p),
                 .own = Eigen::MatrixXd(lines, n_p),
                 .bands = bands,
                 .total = Eigen::VectorXd::Zero(n_p),
                 .total_a = Eigen::VectorXd::Zero(n_p)};
  double largest = 0.0;
  for (Eigen::Index k = 0; k < lines; ++k) {
    Eigen::MatrixXd& E = sums.exchange[k];
    largest = std::max(largest, std::abs(E.sum() - sums.power[k]));
    out.power.row(k) = E.rowwise().sum().transpose() * parts.belongs;
    E = (parts.belongs.transpose() * E * parts.belongs).eval();
    out.own.row(k) = E.diagonal().transpose();
    const double f = velocity.frequency_hz[k];
    if (f < options.spectrum.from_hz) continue;
    out.all += sums.power[k];
    out.total += out.power.row(k).transpose();
    out.total_a += a_weighting_power(f) * out.power.row(k).transpose();
  }
  const double sum = sums.power.sum();
  out.sum_difference = sum > 0.0 ? largest / sum : 0.0;
  out.exchange = band_exchange(velocity, out.bands, sums.exchange);
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(lines);
  const Eigen::VectorXd weighting = frequency_hz.unaryExpr(&a_weighting_power);
  out.band_db.resize(out.bands.size(), n_p);
  out.band_dba.resize(out.bands.size(), n_p);
  for (Eigen::Index p = 0; p < n_p; ++p) {
    const auto levels = [&](const Eigen::VectorXd& of_lines) {
      return levels_db(band_sums(frequency_hz, of_lines, out.bands, velocity.periodic),
                       options.references.power);
    };
    out.band_db.col(p) = levels(out.power.col(p));
    out.band_dba.col(p) = levels(out.power.col(p).cwiseProduct(weighting));
  }
  return out;
}

void write_panel_sound(H5File& file, const std::string& piece, const PanelSound& sound,
                       const LevelReferences& references) {
  for (size_t p = 0; p < sound.panels.size(); ++p) {
    const auto column = static_cast<Eigen::Index>(p);
    const std::string at = "analysis/" + piece + "/panels/" + sound.panels[p];
    put(file, at + "/sound_power", Eigen::VectorXd(sound.power.col(column)), "W",
        "sound power of the panel per line up to boundary_elements_to_hz, with its half of the "
        "exchange with other faces; negative where others send more through it than it sends");
    put(file, at + "/own_sound_power", Eigen::VectorXd(sound.own.col(column)), "W",
        "sound power of the panel per line if all other faces were at rest");
    put_level(file, at + "/third_octave/sound_power_db", Eigen::VectorXd(sound.band_db.col(column)),
              references.power, "W", "sound power, the first third octaves of the analysis");
    put_level(file, at + "/third_octave/sound_power_dba",
              Eigen::VectorXd(sound.band_dba.col(column)), references.power, "W",
              "A-weighted sound power, the first third octaves of the analysis");
    file.set(at, "sound_power_w", sound.total[column]);
    file.set(at, "sound_power_db", level_db(sound.total[column], references.power));
    file.set(at, "sound_power_dba", level_db(sound.total_a[column], references.power));
    file.set(at, "sound_power_share", sound.all > 0.0 ? sound.total[column] / sound.all : 0.0);
  }
  const std::string at = "analysis/" + piece + "/sound/exchange";
  file.write(at + "/panels", sound.panels);
  for (size_t band = 0; band < sound.exchange.size(); ++band)
    put(file, at + "/third_octave/" + member_name(band), sound.exchange[band], "W",
        "powers P_ab between panels in the third octave of this number; panels that share faces "
        "share their power");
}

}  // namespace clatter::recover
