// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The most expensive part of a certificate: comparison with modes of the full model.
#include "core/fe/fe_model.hpp"
#include "core/modes/compare.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::condense {

/// Computes the modes of `model`, with the count proved, compares those of `reduced` with them
/// (core/modes/compare.hpp) and adds to its certificate: verified_to_hz; verified_modes, the
/// elastic ones; verified_frequency_error, the largest |f_reduced / f_full - 1|; verified_mac, the
/// smallest.
/// @param to_hz all modes below [Hz]; 0: as far as the certificate states an accuracy.
/// Without an elastic mode below, a warning is printed and the certificate is unchanged. Throws
/// NumericsError when the models differ in the number of their modes.
modes::Comparison verify(rom::ReducedModel& reduced, const fe::FeModel& model, double to_hz);

/// The same with the full model's modes by another solver. Collective where several processes share
/// it: the one that receives the vectors compares.
modes::Comparison verify(rom::ReducedModel& reduced, const fe::FeModel& model, double to_hz,
                         const modes::ModeSolver& solve);

}  // namespace clatter::condense
