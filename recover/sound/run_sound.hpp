// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Radiated sound of a piece of a run.
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/h5_file.hpp"
#include "recover/sound/directivity.hpp"
#include "recover/sound/panel_sound.hpp"

namespace clatter::recover {

/// Sound of one microphone.
struct MicrophoneResult {
  std::string name{};
  Eigen::VectorXcd pressure{};  // lines up to RunSound::to_hz, peak [Pa]; of one segment
  Eigen::VectorXd square{};     // mean square per line, mean of the segments [Pa2]
  Eigen::VectorXd band_db{};    // per third octave that ends below to_hz, re 20 uPa
  double total_db = 0.0, total_dba = 0.0;
  LevelError error{};
};

/// The level on the measurement surface: the mean square of its microphones, and the sound power
/// level L_p + 10 lg(S / 1 m2) that it stands for, without corrections.
struct SurfaceResult {
  std::string name{};                                   // of the set; empty without one
  double area = 0.0;                                    // S [m2]
  Eigen::VectorXd band_pressure_db{}, band_power_db{};  // re 20 uPa, re 1 pW
  double pressure_db = 0.0, power_db = 0.0;
  double above_power_db = 0.0;  // power_db less the level of the power by R in the same lines
};

/// Sound of a piece: by the table up to `to_hz`, by the ERP of the exposed faces above it.
struct RunSound {
  double to_hz = 0.0;
  Eigen::VectorXd power{};                // per line of the analysis [W]
  Eigen::VectorXd band_db{}, band_dba{};  // per third octave of the analysis, re 1 pW
  double total = 0.0, total_a = 0.0;      // [W], lines inside the spectrum's band
  LevelError error{};                     // of both
  std::vector<MicrophoneResult> microphones{};
  SurfaceResult surface{};
  /// |v^H R v less the power of F|, of the line where it is largest, over the power of all lines: R
  /// leaves out what the mesh breaks of reciprocity.
  double resistance_difference = 0.0;
  PanelSound panels{};
  Directivity directivity{};
};

/// P_k = power_factor_k int |F_k|^2 / (rho c), F_k = G(f_k) Q v_k, and p_k = H(f_k) v_k of each
/// line; of several segments the mean of their powers.
/// @param segment those of segment k, with the panel whose ERP is taken above the table
/// @param parts of the body by panels, panel_parts()
RunSound run_sound(const SoundTable& table, const Analysis& analysis,
                   const std::function<SegmentLines(int64_t k)>& segment, const PanelParts& parts,
                   const Options& options);

/// Writes `analysis/<piece>/sound`.
void write_run_sound(H5File& file, const Analysis& analysis, const RunSound& sound,
                     const LevelReferences& references);

/// Sound power, of an event its energy, and levels at the microphones as lines of the summary.
std::string sound_summary(const RunSound& sound, const Piece& piece,
                          const LevelReferences& references);

}  // namespace clatter::recover
