// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Third octaves, A-weighting and decibels.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace clatter::recover {

/// Third-octave bands, base ten: mid-band 1000 * 10^(n/10) Hz, edges mid * 10^(+-1/20)
/// (IEC 61260-1:2014, eq. 1 to 4).
struct ThirdOctaves {
  Eigen::VectorXd mid_hz, lower_hz, upper_hz;  // exact
  std::vector<std::string> nominal;            // "31.5", "1000", "16000"
  Eigen::Index size() const { return mid_hz.size(); }
};

/// All bands with both edges inside [from_hz, to_hz] that are at least `line_spacing_hz` wide, so
/// that each contains a line. May be empty.
ThirdOctaves third_octaves(double from_hz, double to_hz, double line_spacing_hz);

/// The end of what lines cover, at most `to_hz`, from where there are none: a line of a window
/// covers half a spacing on each side (band_sums()), those of a periodic signal leave no gap.
/// @param frequency_hz lines, ascending, equally spaced, at least one
double covered_to_hz(const Eigen::VectorXd& frequency_hz, double to_hz, bool periodic);

/// Nominal frequency of band n (0 is 1000 Hz) as text.
std::string nominal_frequency(int n);

/// Sums line powers into bands.
/// @param frequency_hz lines, ascending, equally spaced
/// @param power per line, any unit
/// @param periodic true: a line belongs to the band that contains it, lower edge included. False:
///        a line represents the density over one spacing around it and is shared between bands.
Eigen::VectorXd band_sums(const Eigen::VectorXd& frequency_hz, const Eigen::VectorXd& power,
                          const ThirdOctaves& bands, bool periodic);

/// A-weighting in dB (IEC 61672-1:2013, annex E): 20 lg R_A(f) + 2.000.
double a_weighting_db(double frequency_hz);
/// The same as a factor on power, 10^(A/10).
double a_weighting_power(double frequency_hz);

/// 10 lg(power / reference); kSilence for a power of zero.
double level_db(double power, double reference);
Eigen::VectorXd levels_db(const Eigen::VectorXd& power, double reference);

/// Level of a power of zero, so that files contain only finite numbers [dB].
constexpr double kSilence = -999.0;

}  // namespace clatter::recover
