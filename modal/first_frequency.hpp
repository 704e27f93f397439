#pragma once
// A first elastic frequency that no engine part has: units that do not belong together.
#include "core/modes/analysis.hpp"

namespace clatter::modal {

/// One warning where the first elastic frequency cannot be that of a part of this size
/// (core/base/plausible.hpp); nothing without elastic modes.
void warn_of_first_frequency(const modes::PartModes& part);

}  // namespace clatter::modal
