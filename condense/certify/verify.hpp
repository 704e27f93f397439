// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The most expensive part of a certificate: comparison with modes of the full model.
#include "condense/basis/partitioned_model.hpp"
#include "core/modes/compare.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Computes the modes of `part`, with the count proved, compares those of `reduced` with them
/// (core/modes/compare.hpp) and adds to its certificate: verified_to_hz; verified_modes, the
/// elastic ones; verified_frequency_error, the largest |f_reduced / f_full - 1|; verified_mac, the
/// smallest.
/// @param to_hz all modes below [Hz]; 0: as far as the certificate states an accuracy.
/// Without an elastic mode below, a warning is printed and the certificate is unchanged. Throws
/// NumericsError when the models differ in the number of their modes.
/// Collective in a team: rank 0 compares.
modes::Comparison verify(rom::ReducedModel& reduced, const PartitionedModel& part, double to_hz);

}  // namespace clatter::condense
