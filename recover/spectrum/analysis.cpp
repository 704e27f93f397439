// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/spectrum/analysis.hpp"

#include <cmath>
#include <utility>

#include "recover/spectrum/piece_samples.hpp"

namespace clatter::recover {
namespace {

/// Line powers: mean square per line of each column.
Eigen::MatrixXd line_powers(const LineSpectrum& spectrum) {
  return spectrum.power_factor.asDiagonal() * spectrum.amplitude.cwiseAbs2();
}

Eigen::MatrixXd band_levels(const LineSpectrum& axis, const Eigen::MatrixXd& power,
                            const ThirdOctaves& bands, double reference) {
  Eigen::MatrixXd levels(bands.size(), power.cols());
  for (Eigen::Index c = 0; c < power.cols(); ++c)
    levels.col(c) = levels_db(band_sums(axis.frequency_hz, power.col(c), bands, axis.periodic),
                              reference * reference);
  return levels;
}

/// Mean square normal velocity per line of a panel, of one segment.
Eigen::VectorXd panel_powers(const PanelForm& form, const LineSpectrum& velocity) {
  return velocity.power_factor.cwiseProduct(normal_velocity_integral(form.W, velocity.amplitude)) /
         form.area;
}

PanelResult radiate(const PanelForm& form, const LineSpectrum& velocity,
                    const Eigen::VectorXd& mean_square, const ThirdOctaves& bands,
                    const Options& options) {
  PanelResult result{.name = form.name, .area = form.area};
  result.mean_square_velocity = mean_square;
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
  return result;
}

/// Powers of the segments of a piece, averaged. The first segment is `axis`, with its amplitudes;
/// samples(k) are those of segment k.
template <typename Samples, typename Powers>
auto averaged(const Piece& piece, const Samples& samples, double to_hz, const LineSpectrum& axis,
              const Powers& powers) {
  auto sum = powers(axis);
  const int64_t segments = piece.segments();
  for (int64_t k = 1; k < segments; ++k) {
    sum += powers(line_spectrum(segment_of(piece, k), samples(k), to_hz));
  }
  sum /= static_cast<double>(segments);
  return sum;
}

/// Rows of one segment of a piece.
RowMatrix segment_rows(const Piece& piece, const RowMatrix& samples, int64_t k) {
  return samples.middleRows(k * piece.hop, segment_of(piece, k).count);
}

/// Spectrum of the first segment of a piece.
LineSpectrum first_segment(const Piece& piece, const RowMatrix& samples, double to_hz) {
  return line_spectrum(segment_of(piece, 0), segment_rows(piece, samples, 0), to_hz);
}

/// Motions of the sensors over a piece.
std::vector<SensorResult> follow(const RunBody& body, const Piece& piece, Eigen::Index coordinates,
                                 const std::vector<Sensor>& sensors) {
  std::vector<SensorResult> found;
  for (const Sensor& sensor : sensors) {
    SensorResult& result = found.emplace_back();
    result.sensor = &sensor;
    result.displacement = result.velocity = result.acceleration =
        RowMatrix(piece.count, sensor.rows.rows());
  }
  const std::pair<const char*, RowMatrix SensorResult::*> quantities[] = {
      {"q", &SensorResult::displacement},
      {"v", &SensorResult::velocity},
      {"a", &SensorResult::acceleration}};
  for (const auto& [quantity, member] : quantities) {
    if (sensors.empty()) break;
    for_each_block(body, piece, quantity, coordinates, [&](int64_t first, const RowMatrix& rows) {
      for (SensorResult& one : found)
        (one.*member).middleRows(first, rows.rows()) = rows * one.sensor->rows.transpose();
    });
  }
  return found;
}

void observe(const Piece& piece, const ThirdOctaves& bands, double to_hz,
             const LevelReferences& references, SensorResult& result) {
  const LineSpectrum displacement = first_segment(piece, result.displacement, to_hz);
  const LineSpectrum velocity = first_segment(piece, result.velocity, to_hz);
  const LineSpectrum acceleration = first_segment(piece, result.acceleration, to_hz);
  const auto powers = [&](const RowMatrix& samples, const LineSpectrum& first) {
    const auto rows = [&](int64_t k) { return segment_rows(piece, samples, k); };
    return averaged(piece, rows, to_hz, first, line_powers);
  };
  const Eigen::MatrixXd velocity_powers = powers(result.velocity, velocity);
  const Eigen::MatrixXd acceleration_powers = powers(result.acceleration, acceleration);
  result.band_velocity_db = band_levels(velocity, velocity_powers, bands, references.velocity);
  result.band_acceleration_db =
      band_levels(acceleration, acceleration_powers, bands, references.acceleration);
  if (piece.segments() > 1) {
    result.displacement_powers = powers(result.displacement, displacement);
    result.velocity_powers = velocity_powers;
    result.acceleration_powers = acceleration_powers;
    return;
  }
  result.displacement_lines = displacement.amplitude;
  result.velocity_lines = velocity.amplitude;
  result.acceleration_lines = acceleration.amplitude;
}

/// Run times and crank angles of the values of a piece, from firing TDC.
void set_axes(const RunClock& clock, Analysis& analysis) {
  const Piece& piece = analysis.piece;
  if (piece.domain == Domain::kAngle) {
    const auto steps =
        Eigen::ArrayXd::LinSpaced(piece.count, 0.0, static_cast<double>(piece.count - 1));
    analysis.angle_deg = piece.first_deg - piece.ftdc_deg + piece.step_deg * steps;
    analysis.time_s = clock.time[0] +
                      clock.step_s * positions(clock, piece, 0, piece.count).array() -
                      clock.time_at(piece.ftdc_deg);
    return;
  }
  analysis.time_s = clock.time.segment(piece.first, piece.count).array() - piece.ftdc_s;
  if (clock.has_crank())
    analysis.angle_deg = clock.angle_deg.segment(piece.first, piece.count).array() - piece.ftdc_deg;
}

}  // namespace

Analysis analyse(const RunBody& body, const Piece& piece, const Options& options, double to_hz,
                 const std::vector<PanelForm>& forms, const std::vector<Sensor>& sensors) {
  const RunClock& clock = body.clock();
  to_hz = piece.limit_hz(to_hz, clock.step_s);
  const Eigen::Index coordinates = forms.front().W.rows();
  const auto segment_v = [&](int64_t k) {
    return piece_samples(body, piece, "v", k * piece.hop, segment_of(piece, k).count).value();
  };
  Analysis analysis{.piece = piece, .speed_hz = piece.mean_speed_hz};
  set_axes(clock, analysis);
  analysis.velocity = line_spectrum(segment_of(piece, 0), segment_v(0), to_hz);
  const LineSpectrum& lines = analysis.velocity;
  analysis.bands =
      third_octaves(options.spectrum.from_hz,
                    covered_to_hz(lines.frequency_hz, to_hz, lines.periodic), lines.spacing_hz());
  // One transform of a segment serves all panels: their powers are adjacent columns.
  const double averages = equivalent_averages(piece);
  std::vector<SegmentTotals> totals(forms.size(), SegmentTotals(options.spectrum.from_hz));
  const auto powers = [&](const LineSpectrum& velocity) {
    Eigen::MatrixXd columns(velocity.frequency_hz.size(), static_cast<Eigen::Index>(forms.size()));
    for (size_t p = 0; p < forms.size(); ++p) {
      const Eigen::VectorXd power = panel_powers(forms[p], velocity);
      totals[p].add(velocity.frequency_hz, power);
      columns.col(static_cast<Eigen::Index>(p)) = power;
    }
    return columns;
  };
  const Eigen::MatrixXd mean_square = averaged(piece, segment_v, to_hz, analysis.velocity, powers);
  for (size_t p = 0; p < forms.size(); ++p) {
    analysis.panels.push_back(radiate(forms[p], analysis.velocity,
                                      mean_square.col(static_cast<Eigen::Index>(p)), analysis.bands,
                                      options));
    PanelResult& panel = analysis.panels.back();
    panel.erp_error = totals[p].error(averages);
    if (p == 0 || options.output.samples) panel.instant_mean_square.resize(piece.count);
  }
  for_each_block(body, piece, "v", coordinates, [&](int64_t first, const RowMatrix& v) {
    for (size_t p = 0; p < forms.size(); ++p)
      if (Eigen::VectorXd& square = analysis.panels[p].instant_mean_square; square.size() > 0)
        square.segment(first, v.rows()) = normal_velocity_integral(forms[p].W, v) / forms[p].area;
  });
  if (piece.segments() > 1) analysis.velocity.amplitude.resize(0, coordinates);
  analysis.sensors = follow(body, piece, coordinates, sensors);
  for (SensorResult& sensor : analysis.sensors)
    observe(piece, analysis.bands, to_hz, options.references, sensor);
  return analysis;
}

double equivalent_averages(const Piece& window) {
  const int64_t n = window.segments(), length = window.hop > 0 ? window.segment : window.count;
  const Eigen::VectorXd taper = taper_values(window.taper, length);
  double sum = 1.0;
  for (int64_t j = 1; j < n && j * window.hop < length; ++j) {
    const int64_t common = length - j * window.hop;
    const double rho = taper.head(common).dot(taper.tail(common)) / taper.squaredNorm();
    sum += 2.0 * (1.0 - static_cast<double>(j) / static_cast<double>(n)) * rho * rho;
  }
  return static_cast<double>(n) / sum;
}

SegmentLines segment_lines(const RunBody& body, const Piece& segment, const PanelForm& panel,
                           const Air& air, double to_hz) {
  SegmentLines lines{line_spectrum(segment, piece_samples(body, segment, "v"),
                                   segment.limit_hz(to_hz, body.clock().step_s))};
  lines.erp = equivalent_radiated_power(air, panel.area, 1.0) * panel_powers(panel, lines.velocity);
  return lines;
}

double last_tenth_share(const Analysis& analysis) {
  const Eigen::VectorXd& square = analysis.panels.front().instant_mean_square;
  const double all = square.sum();
  return all > 0.0 ? square.tail((square.size() + 9) / 10).sum() / all : 0.0;
}

double cycle_to_cycle_difference(const RunBody& body, const Piece& cycle, const PanelForm& skin) {
  const auto before = piece_samples(body, cycle, "v", -cycle.count, cycle.count);
  if (!before) return -1.0;
  const RowMatrix now = piece_samples(body, cycle, "v");
  const double size = normal_velocity_integral(skin.W, now).sum();
  const RowMatrix difference = now - *before;
  if (!(size > 0.0)) return 0.0;
  return std::sqrt(normal_velocity_integral(skin.W, difference).sum() / size);
}

double cycle_end_jump(const RunBody& body, const Piece& cycle, const PanelForm& skin) {
  const auto v = piece_samples(body, cycle, "v", 0, cycle.count + 1);
  if (!v) return -1.0;
  const RowMatrix jump = v->bottomRows(1) - v->topRows(1);
  const double mean = normal_velocity_integral(skin.W, *v).mean();
  return mean > 0.0 ? std::sqrt(normal_velocity_integral(skin.W, jump)[0] / mean) : 0.0;
}

}  // namespace clatter::recover
