// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Ties and bolts: nodes of a slave surface that follow a master surface.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "assembly/constraint/constraint_graph.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/tie_rows.hpp"
#include "assembly/coupling/rigid_coupling.hpp"
#include "assembly/tie/mortar.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// The relations of all ties and bolts.
struct TieRelations {
  std::vector<Dependence> dependences;
  std::map<std::string, rom::DofSet> bolts;  // the shortening of each; its DoF is an id
};

/// Projects the slave surface of a tie; `spec` gets its default distance. InputError when nothing
/// is tied.
Projection project_tie(const PartData& part, TieSpec& spec);

/// The displacement of a slave node that follows its masters. @param size of the slave's faces, in
/// mean [m]: an arm far below is rounding.
PointMotion following(const PartData& part, const ProjectedNode& row, double size,
                      const std::string& where);

/// Projects each slave surface and adds its dependences to the graph. Displacements that a support
/// holds are not tied. InputError when nothing is tied and for conflicts with relations in `graph`.
/// @param first_id of the bolts' shortenings.
TieRelations gather_ties(const PartData& part, int32_t first_id, ConstraintGraph& graph);

}  // namespace clatter::assembly
