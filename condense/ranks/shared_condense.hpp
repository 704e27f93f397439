// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The part of a reduction by all ranks of an MPI program.
#include "condense/condense_command.hpp"
#include "core/ranks/ranks.hpp"

namespace clatter::condense {

/// Below so many DoFs rank 0 reduces alone, as clatter-condense does: the ranks would wait for each
/// other.
inline constexpr int kFewestShared = 1500;

/// By all ranks; rank 0 prints and writes. @param all must outlive the result.
PartSource shared_source(const ranks::Ranks& all);

}  // namespace clatter::condense
