// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/coupling_members.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "assembly/constraint/support.hpp"
#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

/// Nodes of a surface by their areas, or nodes and points of weight one; all their DoFs.
std::vector<Member> members_of_selection(const PartData& part, const Selection& selection) {
  if (!selection.surface.empty())
    return members_of(part.mesh.nodes, part.surfaces.at(selection.surface));
  std::vector<Member> found;
  for (const NodeOrPoint owner : selected(selection, part.mesh, part.numbers)) {
    Member member;
    for (int d = 0; d < 6; ++d) member.dofs[d] = part.numbers.of(owner, d);
    member.position = part.numbers.position(owner);
    member.weight = 1.0;
    found.push_back(member);
  }
  return found;
}

}  // namespace

std::vector<Member> coupling_members(const PartData& part, const CouplingSpec& spec) {
  std::vector<Member> all;
  for (const TermSpec& term : spec.terms) {
    std::vector<Member> found = members_of_selection(part, term.selection);
    for (Member& member : found) {
      member.weight *= term.weight;
      for (int d = 0; d < 6; ++d) {
        const bool requested = std::count(term.directions.begin(), term.directions.end(), d) > 0;
        if (requested && !member.has(d))
          throw InputError(
              fmt::format("{}: found {} of a node of solids, expected displacements (it has no "
                          "rotations)",
                          term.selection.where, kDofNames[d]));
        if (!requested) member.dofs[d] = -1;
      }
    }
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

Eigen::Vector3d reference_position(const CouplingSpec& spec, const std::vector<Member>& members) {
  if (spec.at) return *spec.at;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Member& member : members) {
    centre += member.weight * member.position;
    weight += member.weight;
  }
  return centre / weight;
}

int32_t point_named(const PartData& part, const std::string& name) {
  return selected({.point = name}, part.mesh, part.numbers)[0].point();
}

ReferenceDofs point_dofs(const DofNumbers& numbers, int32_t point) {
  ReferenceDofs dofs;
  for (int d = 0; d < 6; ++d) dofs.ids[d] = numbers.of_point(point, d);
  dofs.position = numbers.position(NodeOrPoint::of_point(point));
  return dofs;
}

}  // namespace clatter::assembly
