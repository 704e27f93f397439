// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Choice of the frequency lines that are written for the entire skin.
#include <cstdint>
#include <string>
#include <vector>

#include "recover/options/options.hpp"
#include "recover/spectrum/analysis.hpp"

namespace clatter::recover {

/// The upper frequency limit of spectra.
struct FrequencyLimit {
  double to_hz = 0.0;  // highest frequency of any spectrum
  std::string reason;  // what sets it, for messages
};

/// The smallest of the limits of the basis (0: not stated by the model), the sampling of the run,
/// and the user's request.
/// @throws InputError when the user's request exceeds the limit of basis or sampling
FrequencyLimit frequency_limit(const SpectrumBand& requested, double valid_to_hz, double step_s);

struct ChosenLine {
  Eigen::Index index = 0;     // into Analysis::velocity
  double requested_hz = 0.0;  // as requested; otherwise the line's own frequency
};

/// The lines nearest to the requested frequencies and orders, and those of the requested band,
/// ascending; with none of these the strongest local peaks of the A-weighted power inside the
/// spectrum's band.
/// @param power radiated per line of the analysis [W], n_l: the sound power, or else the ERP
/// @throws InputError for a frequency above the limit, orders without a crank, or an empty band
std::vector<ChosenLine> choose_lines(const LineRule& rule, const SpectrumBand& band,
                                     const Analysis& analysis, const Eigen::VectorXd& power,
                                     const FrequencyLimit& limit);

}  // namespace clatter::recover
