// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Sound power by panel, with the exchange between panels.
//
//   P_ab = 1/2 v_a^H Re(Z_ab) v_b = 1/(2 rho c) Re int conj(F_a) F_b dOmega,   P_a = sum_b P_ab
//
// F_a: far field of the part of the surface that is panel a, while the rest of it is rigid. P_a is
// the power of the pressures on the panel, 1/2 Re int_a p conj(v_n) dS, less the reactive power
// that flows from panel to panel in the near field, which cancels in the sum (Fahy and Gardonio
// 2007).
#include "recover/sound/line_far_fields.hpp"
#include "recover/spectrum/analysis.hpp"

namespace clatter::recover {

/// Powers of the panels in the lines of a piece up to the end of the table. Powers may be negative:
/// the panel then moves in opposite phase to what others send.
struct PanelSound {
  std::vector<std::string> panels{};
  Eigen::MatrixXd power{};                  // n_l x panels, P_a [W]
  Eigen::MatrixXd own{};                    // n_l x panels, P_aa [W], not negative
  ThirdOctaves bands{};                     // those that end below the end of the table
  Eigen::MatrixXd band_db{}, band_dba{};    // n_b x panels, of P_a, re 1 pW; silence where negative
  std::vector<Eigen::MatrixXd> exchange{};  // n_b: panels x panels, P_ab [W], symmetric
  Eigen::VectorXd total{}, total_a{};       // panels [W], lines inside the spectrum's band
  double all = 0.0;                         // [W], of the entire body in these lines
  /// |sum over all parts of the body less its power|, of the line where it is largest, over the
  /// power of all lines.
  double sum_difference = 0.0;
};

/// @param sums line_sums() of `parts`
/// @param bands bands_of_table()
PanelSound panel_sound(const Analysis& analysis, const PanelParts& parts, LineSums sums,
                       const ThirdOctaves& bands, const Options& options);

/// Writes `analysis/<piece>/panels/<panel>/sound_power` and beside it, and
/// `analysis/<piece>/sound/exchange`.
void write_panel_sound(H5File& file, const std::string& piece, const PanelSound& sound,
                       const LevelReferences& references);

}  // namespace clatter::recover
