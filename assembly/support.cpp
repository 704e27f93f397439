#include "assembly/support.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

namespace clatter::assembly {
namespace {

constexpr double kSameDirection = 1e-6;  // sine of the angle to what is held already
constexpr double kAlongAxis = 1e-12;

/// The part of `direction` that the group does not hold yet is large enough.
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

std::string place_name(DofPlace place, const mesh::Mesh& mesh, const DofNumbers& numbers) {
  if (place.is_point()) return numbers.points()[static_cast<size_t>(place.point())].name;
  const auto node = static_cast<size_t>(place.index);
  return fmt::format("{}", node < mesh.node_ids.size() ? mesh.node_ids[node] : place.index + 1);
}

}  // namespace

std::vector<DofPlace> places_of(const Place& place, const mesh::Mesh& mesh,
                                const DofNumbers& numbers) {
  std::vector<DofPlace> places;
  if (!place.point.empty()) {
    const std::vector<ReferencePoint>& points = numbers.points();
    const auto found = std::find_if(points.begin(), points.end(), [&](const ReferencePoint& point) {
      return point.name == place.point;
    });
    return {DofPlace::of_point(static_cast<int32_t>(found - points.begin()))};
  }
  const std::vector<int32_t> nodes = place.surface.empty()
                                         ? mesh.node_set(place.node_set)
                                         : mesh::nodes_of(mesh.surface(place.surface));
  for (const int32_t node : nodes) places.push_back(DofPlace::of_node(node));
  return places;
}

Functional held_functional(const HeldDof& held, const DofNumbers& numbers) {
  Functional row;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(held.direction(d)) <= kAlongAxis) continue;
    row.dofs.push_back(numbers.of(held.place, held.is_rotation ? d + 3 : d));
    row.values.push_back(held.direction(d));
  }
  return row;
}

std::vector<HeldGroup> plan_supports(const Recipe& recipe, const mesh::Mesh& mesh,
                                     const DofNumbers& numbers) {
  std::map<int32_t, HeldGroup> groups;  // by the first id of their three: a shared node is one
  for (size_t s = 0; s < recipe.supports.size(); ++s) {
    const SupportSpec& spec = recipe.supports[s];
    for (const DofPlace place : places_of(spec.place, mesh, numbers)) {
      const Eigen::Matrix3d axes = spec.axes.at(numbers.position(place));
      for (const int d : spec.directions) {
        HeldDof held;
        held.support = static_cast<int>(s);
        held.place = place;
        held.is_rotation = d >= 3;
        held.direction = axes.col(d % 3);
        held.label = fmt::format("{}.{}.{}", spec.name, place_name(place, mesh, numbers),
                                 kDofNames[static_cast<size_t>(d)]);
        HeldGroup& group = groups[numbers.of(place, held.is_rotation ? 3 : 0)];
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
