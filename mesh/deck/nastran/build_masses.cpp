// SPDX-License-Identifier: GPL-3.0-or-later
// CONM2.
#include <fmt/format.h>

#include <cmath>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void add_mass(Model& model, const RawMass& raw) {
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
  model.deck.masses.push_back(mass);
}

}  // namespace

void build_masses(Model& model) {
  for (const RawMass& raw : model.raw.masses) {
    model.refusals.attempt([&] { add_mass(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
