// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Where the sound of a piece of a run goes.
#include "core/sound/far_field.hpp"
#include "recover/sound/line_far_fields.hpp"
#include "recover/spectrum/analysis.hpp"

namespace clatter::recover {

/// Mean square pressures far away, per third octave and direction.
struct Directivity {
  sound::Directions directions{};          // that integrate |F|^2 exactly, n_d
  Eigen::VectorXd theta_deg{}, phi_deg{};  // n_d: from +z; around z, from +x toward +y
  ThirdOctaves bands{};                    // those that end below the end of the table
  Eigen::MatrixXd mean_square{};           // n_b x n_d, p^2 r^2 [Pa2 m2]; 0 below a ground plane
  Eigen::VectorXd index_db{};  // n_b: largest directivity index, 10 lg(p^2 r^2 4 pi / (P rho c))
  std::vector<int32_t> loudest{};  // n_b: its direction
  /// The power through the distant sphere over that of the body in the band less 1, the largest.
  double power_difference = 0.0;
};

/// The degree of the largest far field of the table: sphere_directions() of it integrate |F|^2.
int far_degree(const SoundTable& table);

/// @param sums line_sums() in these directions
/// @param bands bands_of_table()
Directivity directivity(const SoundTable& table, const LineSpectrum& velocity, const LineSums& sums,
                        const sound::Directions& directions, const ThirdOctaves& bands);

/// Writes `analysis/<piece>/sound/directivity`.
void write_directivity(H5File& file, const std::string& piece, const Directivity& directivity);

}  // namespace clatter::recover
