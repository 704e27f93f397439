// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Difference of one cycle from the previous one.
#include "dynamics/run/model.hpp"
#include "dynamics/run/recorder.hpp"
#include "dynamics/run/run_certificate.hpp"

namespace clatter::dynamics {

/// The difference of the cycle `now` from the one before, whose samples are `eta_before` and
/// `v_before`; empty when there was none or `now` is incomplete.
CycleDifference cycle_difference(const Model& model, const UniformSamples& now,
                                 const RowMatrix& eta_before, const RowMatrix& v_before);

}  // namespace clatter::dynamics
