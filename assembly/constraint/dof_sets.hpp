// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The named sets of a model's coordinates.
#include <map>
#include <string>

#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/part_data.hpp"
#include "assembly/constraint/relations.hpp"
#include "core/rom/reduced_model.hpp"

namespace clatter::assembly {

/// The relations, and the id of each DoF of Relations::kept.
struct KeptRelations {
  const Relations& relations;
  const std::vector<std::vector<int32_t>>& ids;
};

/// The sets of reference nodes, bolts, sensors, node sets and points, and the `generalised` ones,
/// whose DoFs are ids. DoFs that are no coordinates of the model are left out, and so are sets
/// without any other.
std::map<std::string, rom::DofSet> sets_of_coordinates(
    const PartData& part, const KeptRelations& kept,
    const std::map<std::string, rom::DofSet>& generalised, const Elimination& elimination);

}  // namespace clatter::assembly
