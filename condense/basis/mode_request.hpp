// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The request for shapes of the interior.
#include <string>
#include <vector>

#include "core/sparse/eigen/eigen_method.hpp"

namespace clatter::condense {

/// Which shapes. Exactly one of count and fmax_hz is positive; neither for Guyan. With
/// accurate_to_hz alone cutoff_search.hpp finds fmax_hz.
struct ModeRequest : sparse::EigenChoice {
  int count = 0;
  double fmax_hz = 0.0;
  double accurate_to_hz = 0.0;  // limit of the requested frequencies of the body; 0: by the cut-off
  bool own_modes = false;       // of the body itself instead of fixed-interface modes: Craig-Chang
  std::vector<std::string> load_shapes;  // loads whose static response is in the basis
  bool prove_count = true;
  double frequency_error = 5e-4;  // aimed at by residual modes below accurate_to_hz; 0: none
  bool estimate_error = true;     // of the frequencies, also without residual modes
};

}  // namespace clatter::condense
