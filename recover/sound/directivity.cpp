// SPDX-License-Identifier: GPL-3.0-or-later
#include "recover/sound/directivity.hpp"

#include <cmath>
#include <numbers>

#include "core/sound/far_harmonics.hpp"
#include "recover/field/field_values.hpp"

namespace clatter::recover {
int far_degree(const SoundTable& table) {
  Eigen::Index rows = 1;
  for (const SoundSample& sample : table.samples) rows = std::max(rows, sample.far.rows());
  return static_cast<int>(std::lround(std::sqrt(static_cast<double>(rows)))) - 1;
}

Directivity directivity(const SoundTable& table, const LineSpectrum& velocity, const LineSums& sums,
                        const sound::Directions& directions, const ThirdOctaves& bands) {
  Directivity out{.directions = directions, .bands = bands};
  const RowMatrix& unit = out.directions.unit;
  const Eigen::VectorXd frequency_hz = velocity.frequency_hz.head(sums.power.size());
  const auto in_bands = [&](const Eigen::VectorXd& values) {
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
    out.mean_square.col(d) = in_bands(sums.mean_square.col(d)).cwiseMax(0.0);
  }
  const Eigen::VectorXd band_power = in_bands(sums.power);
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
