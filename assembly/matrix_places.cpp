#include "assembly/matrix_places.hpp"

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
void check_directions(const MatrixPlaces& places, const std::string& file) {
  std::vector<std::vector<size_t>> of_node(static_cast<size_t>(places.nodes.rows()));
  for (size_t j = 0; j < places.dofs.size(); ++j) {
    const rom::MappedDof& dof = places.dofs[j];
    if (dof.kind != Kind::kDisplacement) continue;
    auto& others = of_node[static_cast<size_t>(places.node[j])];
    for (const size_t other : others) {
      // More than three cannot be at right angles either.
      if (std::abs(places.dofs[other].direction.dot(dof.direction)) > 1e-6)
        throw InputError(fmt::format(
            "{}: rows {} and {}: found directions of node {} that are not at right angles, "
            "expected so, or two nodes",
            file, other + 1, j + 1, dof.node));
    }
    others.push_back(j);
  }
}

}  // namespace

MatrixPlaces places_of(const mesh::Mesh& mesh) {
  MatrixPlaces places;
  places.nodes = mesh.nodes;
  std::vector<int32_t> order(static_cast<size_t>(mesh.nodes.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto number = [&](int32_t a) {
    return mesh.node_ids.empty() ? a + 1 : mesh.node_ids[static_cast<size_t>(a)];
  };
  std::sort(order.begin(), order.end(),
            [&](int32_t a, int32_t b) { return number(a) < number(b); });
  std::vector<int32_t> first(order.size());  // DoF of each node
  for (const int32_t a : order) {
    first[static_cast<size_t>(a)] = static_cast<int32_t>(places.dofs.size());
    for (int d = 0; d < 3; ++d) {
      rom::MappedDof dof;
      dof.kind = Kind::kDisplacement;
      dof.node = number(a);
      dof.component = d + 1;
      dof.position = mesh.nodes.row(a);
      dof.direction = Eigen::Vector3d::Unit(d);
      dof.label = fmt::format("{}.{}", number(a), "xyz"[d]);
      places.dofs.push_back(dof);
      places.node.push_back(a);
    }
  }
  for (const auto& [name, nodes] : mesh.node_sets)
    for (const int32_t a : nodes)
      for (int d = 0; d < 3; ++d) places.sets[name].push_back(first[static_cast<size_t>(a)] + d);
  return places;
}

MatrixPlaces places_of(std::vector<rom::MappedDof> map, const std::string& file) {
  MatrixPlaces places;
  std::map<int, int32_t> rows;
  std::vector<Eigen::Vector3d> positions;
  for (size_t j = 0; j < map.size(); ++j) {
    const rom::MappedDof& dof = map[j];
    places.node.push_back(-1);
    if (dof.kind == Kind::kModal) continue;
    const auto [at, added] = rows.emplace(dof.node, static_cast<int32_t>(positions.size()));
    if (added) positions.push_back(dof.position);
    places.node.back() = at->second;
    if (!dof.set.empty()) places.sets[dof.set].push_back(static_cast<int32_t>(j));
  }
  places.nodes.resize(static_cast<Eigen::Index>(positions.size()), 3);
  for (size_t a = 0; a < positions.size(); ++a)
    places.nodes.row(static_cast<Eigen::Index>(a)) = positions[a];
  places.dofs = std::move(map);
  check_directions(places, file);
  return places;
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

SparseMatrix displacement_of(const MatrixPlaces& places, const std::vector<int32_t>& place,
                             int32_t size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (size_t j = 0; j < place.size(); ++j) {
    const rom::MappedDof& dof = places.dofs[j];
    if (place[j] < 0 || dof.kind != Kind::kDisplacement) continue;
    for (int d = 0; d < 3; ++d)
      if (dof.direction[d] != 0.0)
        entries.emplace_back(3 * places.node[j] + d, place[j], dof.direction[d]);
  }
  SparseMatrix T(static_cast<int>(3 * places.nodes.rows()), size);
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

std::map<std::string, rom::DofSet> sets_of(const MatrixPlaces& places,
                                           const std::vector<int32_t>& place) {
  std::map<std::string, rom::DofSet> sets;
  for (const auto& [name, members] : places.sets) {
    std::vector<int32_t> left;
    for (const int32_t j : members)
      if (place[static_cast<size_t>(j)] >= 0) left.push_back(j);
    if (left.empty()) continue;
    rom::DofSet& set = sets[name];
    set.kind = "node";
    set.position.resize(static_cast<Eigen::Index>(left.size()), 3);
    set.direction.resize(static_cast<Eigen::Index>(left.size()), 3);
    for (size_t k = 0; k < left.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      const rom::MappedDof& dof = places.dofs[static_cast<size_t>(left[k])];
      set.dofs.push_back(place[static_cast<size_t>(left[k])]);
      set.labels.push_back(dof.label);
      set.position.row(row) = dof.position;
      set.direction.row(row) = dof.direction;
      set.is_rotation.push_back(dof.kind == Kind::kRotation ? 1 : 0);
    }
  }
  return sets;
}

}  // namespace clatter::assembly
