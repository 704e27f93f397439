// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The cut-off needed for a requested accuracy of the body's frequencies.
#include <string>

#include "condense/basis/craig_bampton.hpp"
#include "core/rom/reduced_certificate.hpp"

namespace clatter::condense {

/// Request and result of the search.
struct CutOffSearch {
  double target = 0.0;   // relative frequency error below InteriorModes::accurate_to_hz
  double reached = 0.0;  // bound of it by cutoff_error_bound
  int tried = 0;         // how many cut-offs
};

/// A basis with the search that found its cut-off.
struct SearchedBasis {
  CraigBampton basis;
  CutOffSearch search;
};

/// The estimate of residual_modes.hpp uses the static response of the truncated modes, 1 /
/// lambda_k. At a frequency f below the cut-off f_c their true response is 1 / (lambda_k - lambda),
/// so the error is at most estimate / (1 - (f / f_c)^2).
double cutoff_error_bound(double estimate, double hz, double cutoff_hz);

/// A Craig-Bampton basis whose modes below `request.accurate_to_hz` have frequencies within
/// `request.frequency_error` (> 0) by cutoff_error_bound: the cut-off begins at 1.5 times that
/// frequency and grows by a quarter, up to 4 times, while residual modes do not reach the target.
/// Own modes are exact: their cut-off is the frequency itself. Throws NumericsError when no cut-off
/// reaches the target, otherwise as craig_bampton.
SearchedBasis search_cutoff(const PartitionedModel& part, const StaticPart& statics,
                            const ModeRequest& request, StepClock& clock);

/// frequency_error_target, frequency_error_bound and cutoffs_tried of a certificate.
void record(const CutOffSearch& search, rom::ReducedCertificate& certificate);
/// A line for the user from such a certificate.
std::string cutoff_line(const rom::ReducedCertificate& certificate);

}  // namespace clatter::condense
