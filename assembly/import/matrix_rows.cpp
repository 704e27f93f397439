// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/import/matrix_rows.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/error.hpp"

namespace clatter::assembly {
namespace {

using Kind = rom::MappedDof::Kind;

/// DoFs of each node, for the check of their directions.
void check_directions(const MatrixRows& layout, const std::string& file) {
  std::vector<std::vector<size_t>> of_node(static_cast<size_t>(layout.nodes.rows()));
  for (size_t j = 0; j < layout.dofs.size(); ++j) {
    const rom::MappedDof& dof = layout.dofs[j];
    if (dof.kind != Kind::kDisplacement) continue;
    auto& others = of_node[layout.node[j]];
    for (const size_t other : others) {
      // More than three cannot be orthogonal either.
      if (std::abs(layout.dofs[other].direction.dot(dof.direction)) > 1e-6)
        throw InputError(
            fmt::format("{}: rows {} and {}: found directions of node {} that are not orthogonal, "
                        "expected orthogonal ones, or two nodes",
                        file, other + 1, j + 1, dof.node));
    }
    others.push_back(j);
  }
}

}  // namespace

MatrixRows matrix_rows(const mesh::Mesh& mesh) {
  MatrixRows layout;
  layout.nodes = mesh.nodes;
  std::vector<int32_t> order(static_cast<size_t>(mesh.nodes.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto number = [&](int32_t a) { return mesh.node_ids.empty() ? a + 1 : mesh.node_ids[a]; };
  std::sort(order.begin(), order.end(),
            [&](int32_t a, int32_t b) { return number(a) < number(b); });
  std::vector<int32_t> first(order.size());  // DoF of each node
  for (const int32_t a : order) {
    first[a] = static_cast<int32_t>(layout.dofs.size());
    for (int d = 0; d < 3; ++d) {
      rom::MappedDof dof;
      dof.kind = Kind::kDisplacement;
      dof.node = number(a);
      dof.component = d + 1;
      dof.position = mesh.nodes.row(a);
      dof.direction = Eigen::Vector3d::Unit(d);
      dof.label = fmt::format("{}.{}", number(a), "xyz"[d]);
      layout.dofs.push_back(dof);
      layout.node.push_back(a);
    }
  }
  for (const auto& [name, nodes] : mesh.node_sets)
    for (const int32_t a : nodes)
      for (int d = 0; d < 3; ++d) layout.sets[name].push_back(first[a] + d);
  return layout;
}

MatrixRows matrix_rows(std::vector<rom::MappedDof> map, const std::string& file) {
  MatrixRows layout;
  std::map<int, int32_t> rows;
  std::vector<Eigen::Vector3d> positions;
  for (size_t j = 0; j < map.size(); ++j) {
    const rom::MappedDof& dof = map[j];
    layout.node.push_back(-1);
    if (dof.kind == Kind::kModal) continue;
    const auto [at, added] = rows.emplace(dof.node, static_cast<int32_t>(positions.size()));
    if (added) positions.push_back(dof.position);
    layout.node.back() = at->second;
    if (!dof.set.empty()) layout.sets[dof.set].push_back(static_cast<int32_t>(j));
  }
  layout.nodes.resize(static_cast<Eigen::Index>(positions.size()), 3);
  for (size_t a = 0; a < positions.size(); ++a)
    layout.nodes.row(static_cast<Eigen::Index>(a)) = positions[a];
  layout.dofs = std::move(map);
  check_directions(layout, file);
  return layout;
}

Eigen::MatrixXd rigid_motions(const std::vector<rom::MappedDof>& dofs) {
  Eigen::MatrixXd rigid = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(dofs.size()), 6);
  for (size_t j = 0; j < dofs.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const rom::MappedDof& dof = dofs[j];
    if (dof.kind == Kind::kRotation) rigid.row(row).tail<3>() = dof.direction;
    if (dof.kind != Kind::kDisplacement) continue;
    rigid.row(row).head<3>() = dof.direction;
    rigid.row(row).tail<3>() = dof.position.cross(dof.direction);  // d . (w x p) = w . (p x d)
  }
  return rigid;
}

SparseMatrix displacement_of(const MatrixRows& layout, const std::vector<int32_t>& coordinate,
                             int32_t size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t j = 0; j < coordinate.size(); ++j) {
    const rom::MappedDof& dof = layout.dofs[j];
    if (coordinate[j] < 0 || dof.kind != Kind::kDisplacement) continue;
    for (int d = 0; d < 3; ++d)
      if (dof.direction[d] != 0.0)
        entries.emplace_back(3 * layout.node[j] + d, coordinate[j], dof.direction[d]);
  }
  SparseMatrix T(static_cast<int>(3 * layout.nodes.rows()), size);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

std::map<std::string, rom::DofSet> sets_of(const MatrixRows& layout,
                                           const std::vector<int32_t>& coordinate) {
  std::map<std::string, rom::DofSet> sets;
  for (const auto& [name, members] : layout.sets) {
    std::vector<int32_t> left;
    for (const int32_t j : members)
      if (coordinate[j] >= 0) left.push_back(j);
    if (left.empty()) continue;
    rom::DofSet& set = sets[name];
    set.kind = "node";
    set.position.resize(static_cast<Eigen::Index>(left.size()), 3);
    set.direction.resize(static_cast<Eigen::Index>(left.size()), 3);
    for (size_t k = 0; k < left.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const rom::MappedDof& dof = layout.dofs[left[k]];
      set.dofs.push_back(coordinate[left[k]]);
      set.labels.push_back(dof.label);
      set.position.row(row) = dof.position;
      set.direction.row(row) = dof.direction;
      set.is_rotation.push_back(dof.kind == Kind::kRotation ? 1 : 0);
      set.node_ids.push_back(dof.node);
    }
  }
  return sets;
}

}  // namespace clatter::assembly
