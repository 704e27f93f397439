// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The outward side of shells, the same for neighbours.
#include <cstdint>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace clatter::mesh {

/// Turns shells so that the two cells of each edge that just two have agree on the outward
/// side: of cells that hang together by such edges the fewer ones are turned, with their thickness
/// and offset. Where no choice agrees (a Moebius strip) all of them keep their side.
/// @param shells offsets of regions are 0 or in ShellBlock::offset.
/// @param keep by block, or empty: its cells are not turned, as those with layers; their neighbours
/// are, unless some of these cells have other sides.
/// @return how many cells were turned.
int64_t orient_shells(std::vector<ShellBlock>& shells, const std::vector<bool>& keep = {});

}  // namespace clatter::mesh
