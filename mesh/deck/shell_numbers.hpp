// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Numbers of shells in files of other programs, for all writers.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh::deck {

/// Block by block: those of the imported file; a missing number, or one that a solid or another
/// shell has, counts on from the largest of all. InputError where 32 bits do not suffice.
/// @param solids numbers of the solids as they are written, block by block.
std::vector<std::vector<int32_t>> shell_numbers(const Mesh& mesh,
                                                const std::vector<std::vector<int32_t>>& solids);

}  // namespace clatter::mesh::deck
