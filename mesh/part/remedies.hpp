// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Advice for a part that could not be meshed: what is advised has been tried.
#include <string>

#include "mesh/part/part_in_child.hpp"

namespace clatter::mesh {

/// Meshes the part with other settings, each in a child process, until one gives a mesh that is not
/// refused: near faces of its solids joined, narrow faces removed (both just wider than its
/// narrowest), smaller elements, 12 of them on a full circle, larger ones. Together they take at
/// most `seconds` of wall time.
///
/// Returns what the user can set, with the number of cells that it gives, "this works, it was
/// tried: [cad] join_within = 0.003 (20134 cells)"; else what was tried, and the smallest edges,
/// faces and radii of the part with their positions, to be mended in the CAD program. Nothing is
/// printed but one line for each trial.
std::string tried_advice(const PartJob& job, const MeshSettings& refused, const ChildLimits& limits,
                         double seconds);

}  // namespace clatter::mesh
