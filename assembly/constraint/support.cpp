// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/support.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace clatter::assembly {
namespace {

constexpr double kSameDirection = 1e-6;  // sine of the angle to the directions already held
constexpr double kAlongAxis = 1e-12;

/// True when `direction` is independent of the directions that the group already holds.
bool is_new(const HeldGroup& group, const Eigen::Vector3d& direction) {
  std::vector<Eigen::Vector3d> basis;
  for (const HeldDof& held : group.held) {
    Eigen::Vector3d v = held.direction;
    for (const Eigen::Vector3d& b : basis) v -= v.dot(b) * b;
    basis.push_back(v.normalized());
  }
  Eigen::Vector3d rest = direction;
  for (const Eigen::Vector3d& b : basis) rest -= rest.dot(b) * b;
  return rest.norm() > kSameDirection;
}

std::string owner_name(NodeOrPoint owner, const mesh::Mesh& mesh, const DofNumbers& numbers) {
  if (owner.is_point()) return numbers.points()[owner.point()].name;
  const auto node = static_cast<size_t>(owner.index);
  return fmt::format("{}", node < mesh.node_ids.size() ? mesh.node_ids[node] : owner.index + 1);
}

}  // namespace

std::vector<NodeOrPoint> selected(const recipe::Selection& selection, const mesh::Mesh& mesh,
                                  const DofNumbers& numbers) {
  std::vector<NodeOrPoint> owners;
  if (!selection.point.empty()) {
    const std::vector<ReferencePoint>& points = numbers.points();
    const auto found = std::find_if(points.begin(), points.end(), [&](const ReferencePoint& point) {
      return point.name == selection.point;
    });
    return {NodeOrPoint::of_point(static_cast<int32_t>(found - points.begin()))};
  }
  const std::vector<int32_t> nodes = selection.surface.empty()
                                         ? mesh.node_set(selection.node_set)
                                         : mesh::nodes_of(mesh.surface(selection.surface));
  for (const int32_t node : nodes) owners.push_back(NodeOrPoint::of_node(node));
  return owners;
}

Functional held_functional(const HeldDof& held, const DofNumbers& numbers) {
  Functional row;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(held.direction(d)) <= kAlongAxis) continue;
    row.dofs.push_back(numbers.of(held.owner, held.is_rotation ? d + 3 : d));
    row.values.push_back(held.direction(d));
  }
  return row;
}

std::vector<HeldGroup> plan_supports(const Recipe& recipe, const mesh::Mesh& mesh,
                                     const DofNumbers& numbers) {
  std::map<int32_t, HeldGroup> groups;  // by the first of the three ids: a shared node is one group
  for (size_t s = 0; s < recipe.supports.size(); ++s) {
    const SupportSpec& spec = recipe.supports[s];
    for (const NodeOrPoint owner : selected(spec.selection, mesh, numbers)) {
      const Eigen::Matrix3d axes = spec.axes.at(numbers.position(owner));
      for (const int d : spec.directions) {
        if (numbers.of(owner, d) < 0) continue;  // a rotation of a node of solids
        HeldDof held;
        held.support = static_cast<int>(s);
        held.owner = owner;
        held.is_rotation = d >= 3;
        held.direction = axes.col(d % 3);
        held.label =
            fmt::format("{}.{}.{}", spec.name, owner_name(owner, mesh, numbers), kDofNames[d]);
        HeldGroup& group = groups[numbers.of(owner, held.is_rotation ? 3 : 0)];
        if (!is_new(group, held.direction)) continue;
        group.along_axes =
            group.along_axes && held.direction.cwiseAbs().maxCoeff() > 1.0 - kAlongAxis;
        group.held.push_back(std::move(held));
      }
    }
  }
  std::vector<HeldGroup> out;
  for (auto& [id, group] : groups) out.push_back(std::move(group));
  return out;
}

}  // namespace clatter::assembly
