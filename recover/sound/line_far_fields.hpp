// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Far fields that the parts of a body send in the lines of a piece of a run.
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
PanelParts panel_parts(const SoundTable& table, const rom::Skin& skin,
                       const std::vector<Panel>& panels);

/// Number of lines up to the end of the table.
Eigen::Index lines_of_table(const SoundTable& table, const LineSpectrum& velocity);

/// The third octaves of a spectrum that end below the end of the table.
ThirdOctaves bands_of_table(const SoundTable& table, const Analysis& analysis,
                            const Options& options);

/// The far fields by one sample of the table of the lines that are interpolated from it. Whatever
/// is quadratic in F, a line has the sum over its samples of weight times the sample's.
struct SampleFields {
  std::vector<Eigen::Index> lines{};  // ascending
  std::vector<double> weight{};       // of power_stencil()
  Eigen::MatrixXcd F{};               // (degree + 1)^2 x (lines x parts) [Pa m], part by part
  auto of_line(size_t index, Eigen::Index parts) const {
    return F.middleCols(static_cast<Eigen::Index>(index) * parts, parts);
  }
};

/// One element for each sample, lines at 0 Hz left out.
std::vector<SampleFields> line_far_fields(const SoundTable& table, const LineSpectrum& velocity,
                                          const std::vector<RowMatrix>& flows);

}  // namespace clatter::recover
