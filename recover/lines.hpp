#pragma once
// Which frequency lines are written for the whole skin.
#include <cstdint>
#include <string>
#include <vector>

#include "recover/analysis.hpp"
#include "recover/options.hpp"

namespace clatter::recover {

/// How far spectra may go.
struct FrequencyLimit {
  double to_hz = 0.0;  // highest frequency of any spectrum
  std::string reason;  // what sets it, for messages
};

/// The limit from what the basis holds (0: not stated by the model), the sampling of the run, and
/// what the user asked for.
/// @throws InputError when the user asks for more than basis or sampling hold
FrequencyLimit frequency_limit(const SpectrumBand& asked, double valid_to_hz, double step_s);

struct ChosenLine {
  Eigen::Index index = 0;     // into Analysis::velocity
  double requested_hz = 0.0;  // what was asked for; the line's own frequency when nothing was
};

/// The lines nearest to the frequencies and orders asked for, rising; with neither the strongest
/// local peaks of the A-weighted ERP inside the spectrum's band, of panel "exposed" when there is
/// one, else of the whole skin.
/// @throws InputError for a frequency above the limit, or orders when nothing turns
std::vector<ChosenLine> choose_lines(const LineRule& rule, const SpectrumBand& band,
                                     const Analysis& analysis, const FrequencyLimit& limit);

}  // namespace clatter::recover
