// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Radiated sound of a piece of a run.
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/sound/sound_table.hpp"
#include "recover/spectrum/analysis.hpp"

namespace clatter::recover {

/// Sound of one microphone.
struct MicrophoneResult {
  std::string name{};
  Eigen::VectorXcd pressure{};  // lines up to RunSound::to_hz, peak [Pa]
  Eigen::VectorXd band_db{};    // per third octave that ends below to_hz, re 20 uPa
  double total_db = 0.0, total_dba = 0.0;
};

/// Sound of a piece: by the table up to `to_hz`, by the ERP of the exposed faces above it.
struct RunSound {
  double to_hz = 0.0;
  Eigen::VectorXd power{};                // per line of the analysis [W]
  Eigen::VectorXd band_db{}, band_dba{};  // per third octave of the analysis, re 1 pW
  double total = 0.0, total_a = 0.0;      // [W], lines inside the spectrum's band
  std::vector<MicrophoneResult> microphones{};
};

/// P_k = power_factor_k v_k^H R(f_k) v_k and p_k = H(f_k) v_k of each line.
/// @param erp panel whose ERP is taken above the table
RunSound run_sound(const SoundTable& table, const Analysis& analysis, const PanelResult& erp,
                   const Options& options);

/// Writes `analysis/<piece>/sound`.
void write_run_sound(H5File& file, const Analysis& analysis, const RunSound& sound,
                     const LevelReferences& references);

/// Sound power and levels at the microphones as lines of the summary.
std::string sound_summary(const RunSound& sound, const LevelReferences& references);

}  // namespace clatter::recover
