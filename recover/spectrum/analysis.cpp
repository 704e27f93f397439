// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/analysis.hpp"

#include <cmath>
#include <numbers>

namespace clatter::recover {
namespace {

/// Line powers: mean square per line of each column.
Eigen::MatrixXd line_powers(const LineSpectrum& spectrum) {
  return spectrum.power_factor.asDiagonal() * spectrum.amplitude.cwiseAbs2();
}

Eigen::MatrixXd band_levels(const LineSpectrum& spectrum, const ThirdOctaves& bands,
                            double reference) {
  const Eigen::MatrixXd power = line_powers(spectrum);
  Eigen::MatrixXd levels(bands.size(), power.cols());
  for (Eigen::Index c = 0; c < power.cols(); ++c)
    levels.col(c) =
        levels_db(band_sums(spectrum.frequency_hz, power.col(c), bands, spectrum.periodic),
                  reference * reference);
  return levels;
}

PanelResult radiate(const PanelForm& form, const LineSpectrum& velocity, const RowMatrix& v,
                    const ThirdOctaves& bands, const Options& options) {
  PanelResult result{.name = form.name, .area = form.area};
  result.mean_square_velocity =
      velocity.power_factor.cwiseProduct(normal_velocity_integral(form.W, velocity.amplitude)) /
      form.area;
  const double to_power = equivalent_radiated_power(options.air, form.area, 1.0);
  result.erp = to_power * result.mean_square_velocity;
  const Eigen::VectorXd weighted =
      result.erp.cwiseProduct(velocity.frequency_hz.unaryExpr(&a_weighting_power));
  const auto sums = [&](const Eigen::VectorXd& power) {
    return band_sums(velocity.frequency_hz, power, bands, velocity.periodic);
  };
  const LevelReferences& ref = options.references;
  result.band_velocity_db =
      levels_db(sums(result.mean_square_velocity), ref.velocity * ref.velocity);
  result.band_erp_db = levels_db(sums(result.erp), ref.power);
  result.band_erp_dba = levels_db(sums(weighted), ref.power);
  for (Eigen::Index k = 0; k < velocity.frequency_hz.size(); ++k) {
    if (velocity.frequency_hz[k] < options.spectrum.from_hz) continue;
    result.total_erp += result.erp[k];
    result.total_erp_a += weighted[k];
  }
  result.instant_mean_square = normal_velocity_integral(form.W, v) / form.area;
  return result;
}

SensorResult observe(const Sensor& sensor, const Piece& piece, const RowMatrix& q,
                     const RowMatrix& v, const RowMatrix& a, const ThirdOctaves& bands,
                     double to_hz, const LevelReferences& references) {
  SensorResult result{.sensor = &sensor};
  result.displacement = q * sensor.rows.transpose();
  result.velocity = v * sensor.rows.transpose();
  result.acceleration = a * sensor.rows.transpose();
  const LineSpectrum velocity = line_spectrum(piece, result.velocity, to_hz);
  const LineSpectrum acceleration = line_spectrum(piece, result.acceleration, to_hz);
  result.displacement_lines = line_spectrum(piece, result.displacement, to_hz).amplitude;
  result.velocity_lines = velocity.amplitude;
  result.acceleration_lines = acceleration.amplitude;
  result.band_velocity_db = band_levels(velocity, bands, references.velocity);
  result.band_acceleration_db = band_levels(acceleration, bands, references.acceleration);
  return result;
}

}  // namespace

Analysis analyse(const RunBody& body, const Piece& piece, const Options& options, double to_hz,
                 const std::vector<PanelForm>& forms, const std::vector<Sensor>& sensors) {
  const RunClock& clock = body.clock();
  const RowMatrix v = body.samples("v", piece.first, piece.count);
  Analysis analysis{.piece = piece};
  analysis.time_s = clock.time.segment(piece.first, piece.count).array() - piece.ftdc_s;
  if (clock.has_crank()) {
    analysis.angle_deg = clock.angle_deg.segment(piece.first, piece.count).array() - piece.ftdc_deg;
    analysis.speed_hz = clock.speed_deg_s() / 360.0;
  }
  analysis.velocity = line_spectrum(piece, v, to_hz);
  analysis.bands = third_octaves(options.spectrum.from_hz, to_hz, analysis.velocity.spacing_hz());
  for (const PanelForm& form : forms)
    analysis.panels.push_back(radiate(form, analysis.velocity, v, analysis.bands, options));
  if (sensors.empty()) return analysis;

  const RowMatrix q = body.samples("q", piece.first, piece.count);
  const RowMatrix a = body.samples("a", piece.first, piece.count);
  for (const Sensor& sensor : sensors)
    analysis.sensors.push_back(
        observe(sensor, piece, q, v, a, analysis.bands, to_hz, options.references));
  return analysis;
}

double cycle_to_cycle_difference(const RunBody& body, const Piece& cycle, const PanelForm& skin) {
  if (cycle.first < cycle.count) return -1.0;
  const RowMatrix now = body.samples("v", cycle.first, cycle.count);
  const RowMatrix before = body.samples("v", cycle.first - cycle.count, cycle.count);
  const double size = normal_velocity_integral(skin.W, now).sum();
  const RowMatrix difference = now - before;
  if (!(size > 0.0)) return 0.0;
  return std::sqrt(normal_velocity_integral(skin.W, difference).sum() / size);
}

double cycle_end_jump(const RunBody& body, const Piece& cycle, const PanelForm& skin) {
  if (cycle.first + cycle.count >= body.clock().time.size()) return -1.0;
  const RowMatrix v = body.samples("v", cycle.first, cycle.count + 1);
  const RowMatrix jump = v.bottomRows(1) - v.topRows(1);
  const double mean = normal_velocity_integral(skin.W, v).mean();
  return mean > 0.0 ? std::sqrt(normal_velocity_integral(skin.W, jump)[0] / mean) : 0.0;
}

}  // namespace clatter::recover
