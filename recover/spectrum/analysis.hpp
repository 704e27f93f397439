// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Results derived from one piece of a run: sensor histories and spectra, mean square normal
// velocity and radiated power per panel, over lines, third octaves and time.
#include <string>
#include <vector>

#include "recover/options/options.hpp"
#include "recover/options/piece.hpp"
#include "recover/run/run_input.hpp"
#include "recover/skin/radiated_power.hpp"
#include "recover/skin/sensors.hpp"
#include "recover/spectrum/level_error.hpp"
#include "recover/spectrum/levels.hpp"
#include "recover/spectrum/spectra.hpp"

namespace clatter::recover {

/// Radiation of one panel. Mean squares are over time and surface, so RMS^2 [m2/s2].
struct PanelResult {
  std::string name{};
  double area = 0.0;                       // [m2]
  Eigen::VectorXd mean_square_velocity{};  // per line [m2/s2]
  Eigen::VectorXd erp{};                   // per line [W]
  Eigen::VectorXd band_velocity_db{};      // per third octave, re LevelReferences::velocity
  Eigen::VectorXd band_erp_db{};           // per third octave, re 1 pW
  Eigen::VectorXd band_erp_dba{};          // the same, each line A-weighted before the sum
  Eigen::VectorXd instant_mean_square{};   // per sample: surface mean of v_n^2 [m2/s2]; without
                                           // OutputRule::samples of the first panel only
  double total_erp = 0.0;                  // [W], lines inside the spectrum's band
  double total_erp_a = 0.0;                // [W], A-weighted
  LevelError erp_error{};                  // of both
};

/// Motion of one sensor; rows are samples, lines or bands, columns are channels.
struct SensorResult {
  const Sensor* sensor = nullptr;
  RowMatrix displacement{}, velocity{}, acceleration{};  // samples: [m], [m/s], [m/s2]
  Eigen::MatrixXcd displacement_lines{}, velocity_lines{}, acceleration_lines{};  // peak amplitudes
  Eigen::MatrixXd band_acceleration_db{};  // third octaves, re LevelReferences::acceleration
  Eigen::MatrixXd band_velocity_db{};
  /// Of a window in segments, instead of the complex lines: mean squares per line, averaged.
  Eigen::MatrixXd displacement_powers{}, velocity_powers{}, acceleration_powers{};
};

struct Analysis {
  Piece piece{};
  Eigen::VectorXd time_s{};     // samples, from firing TDC
  Eigen::VectorXd angle_deg{};  // samples, from firing TDC; empty without a crank
  double speed_hz = 0.0;        // mean revolutions of the crank per second, 0 without a crank
  /// Reduced coordinates, n_l x r; of a window in several segments without amplitudes, 0 x r.
  LineSpectrum velocity{};
  ThirdOctaves bands{};
  std::vector<PanelResult> panels{};
  std::vector<SensorResult> sensors{};
};

/// Analyses one piece up to `to_hz`, which the caller has checked against the basis; over the angle
/// up to Piece::limit_hz. Powers of a window in segments are averaged over these (Welch 1967).
Analysis analyse(const RunBody& body, const Piece& piece, const Options& options, double to_hz,
                 const std::vector<PanelForm>& forms, const std::vector<Sensor>& sensors);

/// Number of independent segments with the same variance of an averaged power as the segments of
/// `window`, which overlap: n / (1 + 2 sum_j (1 - j/n) rho_j), rho_j the squared correlation of the
/// taper with itself, moved by j hops, over that at j = 0 (Welch 1967).
double equivalent_averages(const Piece& window);

/// Lines of one segment of a piece: reduced velocities, and what a panel radiates.
struct SegmentLines {
  LineSpectrum velocity{};
  Eigen::VectorXd erp{};  // [W]
};
SegmentLines segment_lines(const RunBody& body, const Piece& segment, const PanelForm& panel,
                           const Air& air, double to_hz);

/// Share of the skin's mean square normal velocity in the last tenth of the samples: of an event
/// that the window holds it is small, of steady motion a tenth.
double last_tenth_share(const Analysis& analysis);

/// Relative difference between the last two cycles: sqrt of the time mean of the surface integral
/// of (v_n - v_n,before)^2 over that of v_n^2. Negative when the run has no two cycles.
double cycle_to_cycle_difference(const RunBody& body, const Piece& cycle, const PanelForm& skin);

/// Jump between the end and the beginning of a cycle, which a transform treats as one instant:
/// surface RMS of v_n(end) - v_n(begin) over the cycle's RMS of v_n. Negative when the run ends
/// before the end of the cycle.
double cycle_end_jump(const RunBody& body, const Piece& cycle, const PanelForm& skin);

}  // namespace clatter::recover
