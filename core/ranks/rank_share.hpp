// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Threads and memory of each rank.
#include "core/base/command_line.hpp"
#include "core/ranks/ranks.hpp"

namespace clatter::ranks {

/// --threads counts the threads of each rank; without it the ranks of a machine divide its cores
/// among themselves, at least one each. So does --memory-limit for its memory. Rank 0 says which.
void set_rank_share(const Ranks& ranks, const CommonOptions& common);

}  // namespace clatter::ranks
