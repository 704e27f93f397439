// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The edge of a sheet on a face of a solid: a rib, a sheet welded upright.
//
// The footprint of the edge, as wide as the sheet is thick, is a slave surface of a mortar tie. Its
// corners are at x + (o +- t/2) V on both sides of the mid-surface, V the director of the edge's
// node and o the shell's offset; they follow the solid by u+ and u- (mortar.hpp). Then
//   theta x V = (u+ - u-) / t,   u = (1/2 - o/t) u+ + (1/2 + o/t) u-
// of the node: the displacement is the mean of the face's over the footprint, the two rotations
// across the director are (12 / t^3) int y u dy, those of the strip. The dual multipliers give just
// that, and along the edge cells of the sheet and of the solid need not match. The rotation about
// the director stays free: no plate resists it. Where sheets of different directions meet, all
// three are those that fit both strips best.
//
// The foot is stiffer than the solid's by 2 to 3 % of a frequency where the solid's cells are wider
// than three thicknesses: a warning.
#include <vector>

#include "assembly/constraint/constraint_graph.hpp"
#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "assembly/tie/mortar.hpp"

namespace clatter::assembly {

/// The edge's nodes as the means of their footprint: what their temperatures follow. InputError as
/// tie_edge().
Projection project_edge(const PartData& part, const TieSpec& spec);

/// The dependences of the edge's nodes. InputError where the node set has no free edge of a shell,
/// and where none lies on the master.
std::vector<Dependence> tie_edge(const PartData& part, const TieSpec& spec, ConstraintGraph& graph);

}  // namespace clatter::assembly
