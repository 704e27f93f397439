// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a [[coupling]] couples, and its reference node.
#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "assembly/constraint/part_data.hpp"
#include "assembly/coupling/member_group.hpp"
#include "assembly/coupling/rigid_coupling.hpp"

namespace clatter::assembly {

/// The members of a distributing coupling. InputError for rotations of nodes, which have none.
std::vector<Member> coupling_members(const PartData& part, const CouplingSpec& spec);

/// The given position of a coupling's own reference node, or the centre of its members [m].
Eigen::Vector3d reference_position(const CouplingSpec& spec, const std::vector<Member>& members);

/// Index of the [[point]] of that name, which exists.
int32_t point_named(const PartData& part, const std::string& name);

/// Ids and position of a point.
ReferenceDofs point_dofs(const DofNumbers& numbers, int32_t point);

}  // namespace clatter::assembly
