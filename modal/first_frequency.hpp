// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Warning about an implausible first elastic frequency, a sign of inconsistent units.
#include "core/modes/analysis.hpp"

namespace clatter::modal {

/// Warns if the first elastic frequency is implausible for a part of this size
/// (core/base/plausible.hpp); no effect without elastic modes.
void warn_of_first_frequency(const modes::PartModes& part);

}  // namespace clatter::modal
