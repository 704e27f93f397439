// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The modes of a part by all ranks of an MPI program.
#include "core/ranks/ranks.hpp"
#include "modal/modes_command.hpp"

namespace clatter::modal {

/// Below so many DoFs rank 0 computes alone, as clatter-modal does.
inline constexpr int kFewestShared = 1500;

/// By all ranks; rank 0 receives the modes, prints and writes. @param all must outlive the result.
ModeFinder shared_finder(const ranks::Ranks& all);

}  // namespace clatter::modal
