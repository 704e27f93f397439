// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Far fields that the parts of a body send in the lines of a piece of a run: powers, exchange,
// directions.
#include <Eigen/Core>
#include <vector>

#include "recover/skin/panels.hpp"
#include "recover/sound/sound_table.hpp"
#include "recover/spectrum/analysis.hpp"

namespace clatter::recover {

/// The faces of a body by the panels that they belong to. Panels may overlap, parts do not.
struct PanelParts {
  std::vector<std::string> panels{};
  Eigen::MatrixXd belongs{};       // parts x panels: 1 where the faces of a part are of the panel
  std::vector<RowMatrix> flows{};  // per part: n_v x r, flow of the acoustic skin's nodes
};

/// Divides the faces that send sound.
/// @throws InputError for a sound file of another skin
PanelParts panel_parts(const SoundTable& table, const IndexMatrix& triangles,
                       const rom::SkinRows& T, const std::vector<Panel>& panels);

/// Number of lines up to the end of the table.
Eigen::Index lines_of_table(const SoundTable& table, const LineSpectrum& velocity);

/// The third octaves of a spectrum that end below the end of the table.
ThirdOctaves bands_of_table(const SoundTable& table, const Analysis& analysis,
                            const Options& options);

/// What far fields give in each line: power_stencil() sums over the samples of the table.
struct LineSums {
  Eigen::VectorXd power{};                  // n_l [W], of the sum of the parts; 0 at 0 Hz
  std::vector<Eigen::MatrixXd> exchange{};  // n_l: parts x parts [W], symmetric
  Eigen::MatrixXd mean_square{};            // n_l x n_d, p^2 r^2 in each direction [Pa2 m2]

  LineSums& operator+=(const LineSums& other);
  LineSums& operator/=(double count);
};

/// Sums over the lines up to the end of the table, some hundred lines at a time.
/// @param harmonics n_d x (degree + 1)^2, spherical_harmonics() of the directions, of a degree that
///        no sample exceeds
LineSums line_sums(const SoundTable& table, const LineSpectrum& velocity, const PanelParts& parts,
                   const Eigen::MatrixXd& harmonics);

}  // namespace clatter::recover
