// SPDX-License-Identifier: GPL-3.0-or-later
// CONM2.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/node_sets.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// All nodes of the cells around those nodes of solids that have a mass with an offset or inertia.
class Neighbours {
 public:
  explicit Neighbours(const Mesh& mesh) : mesh_(mesh) {}
  void request(NodeIndex node) { of_[node]; }
  void find() {
    if (of_.empty()) return;
    for (const CellBlock& block : mesh_.cells)
      for (Eigen::Index c = 0; c < block.nodes.rows(); ++c) {
        const auto row = block.nodes.row(c);
        for (const int32_t node : row)
          if (const auto at = of_.find(node); at != of_.end())
            at->second.insert(at->second.end(), row.begin(), row.end());
      }
    for (auto& [node, all] : of_) sort_unique(all);
  }
  const std::vector<NodeIndex>& of(NodeIndex node) const { return of_.at(node); }

 private:
  const Mesh& mesh_;
  std::map<NodeIndex, std::vector<NodeIndex>> of_;
};

bool needs_rotations(const RawMass& raw) {
  return raw.offset != std::array<double, 3>{} || raw.inertia != std::array<double, 6>{} ||
         raw.system < 0;
}

// A mass beside a node of solids acts on it by a force and a couple, which such a node cannot take:
// a point at the mass that follows the cells around the node takes both.
void hang_on_neighbours(Model& model, const RawMass& raw, Mass mass, const Neighbours& neighbours) {
  const NodeIndex node = mass.node_index;
  Distributing patch;
  patch.name = fmt::format("conm2_{}", raw.id);
  patch.where = mass.where;
  patch.terms = {{1.0, kTranslations, neighbours.of(node)}};
  model.spend(16 * static_cast<int64_t>(patch.terms[0].node_indices.size()), raw.origin);
  const NodeIndex point = model.add_point(model.node_map.position(node) + mass.offset, raw.origin);
  patch.reference = point;
  mass.node_index = point;
  model.hung[point] = node;
  mass.offset.setZero();
  model.deck.notes.push_back(fmt::format(
      "{}: CONM2 {}: nodes of solids have no rotations: its {} hangs on the {} nodes of the cells "
      "around grid {}",
      mass.where, raw.id, raw.offset == std::array<double, 3>{} ? "inertia" : "offset mass",
      patch.terms[0].node_indices.size(), raw.grid));
  model.deck.distributing.push_back(std::move(patch));
  model.deck.masses.push_back(std::move(mass));
}

void add_mass(Model& model, const RawMass& raw, const Neighbours& neighbours) {
  Mass mass;
  mass.where = model.source.where(raw.origin);
  mass.node_index = model.require(raw.grid, raw.origin);
  const double factor = model.raw.control.mass_factor;
  mass.mass = factor * raw.mass;
  const Vector3d offset(raw.offset[0], raw.offset[1], raw.offset[2]);
  const auto& i = raw.inertia;
  Matrix3d inertia;
  // I21, I31, I32 are integrals of products; the tensor has their negatives.
  inertia << i[0], -i[1], -i[3], -i[1], i[2], -i[4], -i[3], -i[4], i[5];
  if (raw.system < 0) {
    mass.offset = offset - model.node_map.position(mass.node_index);
    mass.inertia = factor * inertia;
  } else {
    const Matrix3d axes =
        model.systems.directions(raw.system, model.node_map.position(mass.node_index), raw.origin);
    mass.offset = axes * offset;
    mass.inertia = factor * axes * inertia * axes.transpose();
  }
  if (!mass.offset.allFinite() || !mass.inertia.allFinite() || !std::isfinite(mass.mass)) {
    model.source.fail(raw.origin, "CONM2: its numbers are too large");
  }
  if (model.node_map.turns(mass.node_index) ||
      (mass.offset.isZero(0.0) && mass.inertia.isZero(0.0))) {
    model.deck.masses.push_back(mass);
  } else {
    hang_on_neighbours(model, raw, mass, neighbours);
  }
}

}  // namespace

void build_masses(Model& model) {
  Neighbours neighbours(model.deck.mesh);
  for (const RawMass& raw : model.raw.masses) {
    const int32_t row = needs_rotations(raw) ? model.grids.find(raw.grid) : -1;
    const NodeIndex index =
        row < 0 ? NodeMap::kNone : model.node_map.find(static_cast<size_t>(row));
    if (index != NodeMap::kNone && !model.node_map.turns(index)) neighbours.request(index);
  }
  neighbours.find();
  for (const RawMass& raw : model.raw.masses) {
    model.refusals.attempt([&] { add_mass(model, raw, neighbours); });
  }
}

}  // namespace clatter::mesh::deck::nastran
