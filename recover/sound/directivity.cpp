// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/directivity.hpp"

#include <cmath>
#include <numbers>

#include "core/sound/far_harmonics.hpp"
#include "core/sound/spherical_harmonics.hpp"
#include "recover/field/field_values.hpp"

namespace clatter::recover {
namespace {

/// The degree of the largest far field of the table.
int highest_degree(const SoundTable& table) {
  Eigen::Index rows = 1;
  for (const SoundSample& sample : table.samples) rows = std::max(rows, sample.far.rows());
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(rows)))) - 1;
}

/// Mean square pressures of the lines in each direction, n_l x n_d.
Eigen::MatrixXd line_mean_squares(const LineSpectrum& velocity, Eigen::Index lines,
                                  Eigen::Index parts, const std::vector<SampleFields>& fields,
                                  const Eigen::MatrixXd& harmonics) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(lines, harmonics.rows());
  for (const SampleFields& sample : fields) {
    const auto count = static_cast<Eigen::Index>(sample.lines.size());
    if (count == 0) continue;
    Eigen::MatrixXd F(sample.F.rows(), 2 * count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::VectorXcd all = sample.of_line(static_cast<size_t>(i), parts).rowwise().sum();
      F.col(i) = all.real();
      F.col(count + i) = all.imag();
    }
    const Eigen::MatrixXd p = harmonics.leftCols(F.rows()) * F;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Index k = sample.lines[static_cast<size_t>(i)];
      out.row(k) += velocity.power_factor[k] * sample.weight[static_cast<size_t>(i)] *
                    (p.col(i).cwiseAbs2() + p.col(count + i).cwiseAbs2()).transpose();
    }
  }
  return out;
}

}  // namespace

Directivity directivity(const SoundTable& table, const Analysis& analysis, Eigen::Index parts,
                        const std::vector<SampleFields>& fields, const Eigen::VectorXd& power,
                        const Options& options) {
  const LineSpectrum& velocity = analysis.velocity;
  const Eigen::Index lines = lines_of_table(table, velocity);
  const int degree = highest_degree(table);
  Directivity out{.directions = sound::sphere_directions(degree),
                  .bands = bands_of_table(table, analysis, options)};
  const RowMatrix& unit = out.directions.unit;
  const Eigen::MatrixXd of_lines =
      line_mean_squares(velocity, lines, parts, fields, sound::spherical_harmonics(unit, degree));
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(lines);
  const auto sums = [&](const Eigen::VectorXd& values) {
    return band_sums(frequency_hz, values, out.bands, velocity.periodic);
  };
  const Eigen::Index n_d = unit.rows();
  out.theta_deg.resize(n_d);
  out.phi_deg.resize(n_d);
  out.mean_square.resize(out.bands.size(), n_d);
  const double to_deg = 180.0 / std::numbers::pi;
  for (Eigen::Index d = 0; d < n_d; ++d) {
    out.theta_deg[d] = to_deg * std::acos(unit(d, 2));
    out.phi_deg[d] = to_deg * std::atan2(unit(d, 1), unit(d, 0));
    // Interpolation between squares may leave rounding of the size of its error.
    out.mean_square.col(d) = sums(of_lines.col(d)).cwiseMax(0.0);
  }
  const Eigen::VectorXd band_power = sums(power.head(lines));
  const Eigen::VectorXd through =
      sound::power_of_far_field(table.space()) * (out.mean_square * out.directions.weight);
  out.index_db = Eigen::VectorXd::Zero(out.bands.size());
  for (Eigen::Index b = 0; b < out.bands.size(); ++b) {
    for (Eigen::Index d = 0; d < n_d; ++d)
      if (table.ground && table.ground->normal.dot(unit.row(d).transpose()) < 0.0)
        out.mean_square(b, d) = 0.0;
    Eigen::Index at = 0;
    const double most = out.mean_square.row(b).maxCoeff(&at);
    out.loudest.push_back(static_cast<int32_t>(at));
    if (!(band_power[b] > 0.0)) continue;
    out.index_db[b] = 10.0 * std::log10(most * 4.0 * std::numbers::pi /
                                        (band_power[b] * table.fluid.impedance()));
    out.power_difference =
        std::max(out.power_difference, std::abs(through[b] / band_power[b] - 1.0));
  }
  return out;
}

void write_directivity(H5File& file, const std::string& piece, const Directivity& directivity) {
  const std::string at = "analysis/" + piece + "/sound/directivity";
  put(file, at + "/theta_deg", directivity.theta_deg, "deg", "directions, from +z");
  put(file, at + "/phi_deg", directivity.phi_deg, "deg", "directions, around z from +x toward +y");
  put(file, at + "/weight", directivity.directions.weight, "sr",
      "of each direction in an integral over the sphere, exact for mean_square_pressure");
  put(file, at + "/third_octave/mean_square_pressure", directivity.mean_square, "Pa2 m2",
      "mean square pressure far away times the distance squared, bands x directions: the first "
      "third octaves of the analysis; 0 below a ground plane");
  put(file, at + "/third_octave/index_db", directivity.index_db, "dB",
      "largest directivity index: mean square pressure over that of a source of the same power "
      "that sends equally in all directions of free space");
  put(file, at + "/third_octave/loudest", directivity.loudest, "1",
      "the direction of the largest index");
}

}  // namespace clatter::recover
