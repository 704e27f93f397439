// SPDX-License-Identifier: GPL-3.0-or-later
// RBE2 and RBE3.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/deck/nastran/dependent_rows.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr DofMask kRotations = kAllDofs & ~kTranslations;

// All three directions or none: independent of the frame.
bool frame_free(DofMask dofs, bool has_rotations) {
  const auto all_or_none = [dofs](DofMask three) {
    return (dofs & three) == three || (dofs & three) == 0;
  };
  return all_or_none(kTranslations) && (!has_rotations || all_or_none(kRotations));
}

// The rows of dependent_rows() for a reference with six DoFs:
// t . (u_d - u_r - theta_r x (x_d - x_r)) = 0, and for rotations t . (theta_d - theta_r) = 0.
void add_rigid_rows(Model& model, const RawRigid& raw, NodeIndex reference, NodeIndex dependent) {
  const Vector3d arm = model.node_map.position(dependent) - model.node_map.position(reference);
  for (DependentRow& row : dependent_rows(model, dependent, raw.dofs, raw.origin)) {
    const Vector3d turn = arm.cross(row.direction);
    std::vector<Equation::Term>& terms = row.equation.terms;
    for (int k = 0; k < 3; ++k) add_term(terms, reference, row.base + k, -row.direction[k]);
    for (int k = 0; row.base == 0 && k < 3; ++k) add_term(terms, reference, 3 + k, -turn[k]);
    model.deck.equations.push_back(std::move(row.equation));
  }
}

void add_rigid(Model& model, const RawRigid& raw) {
  Rigid rigid;
  rigid.name = raw.name;
  rigid.where = model.source.where(raw.origin);
  rigid.reference = model.require(raw.reference, raw.origin);
  rigid.dofs = raw.dofs;
  for (const NodeIndex node_index : model.node_indices(raw.dependents, raw.origin, true)) {
    if (node_index == rigid.reference) {
      model.source.fail(raw.origin, fmt::format("{}: its reference {} is a dependent, too",
                                                raw.name, raw.reference));
    }
    const bool basic = model.node_map.displacement_system(node_index) == 0;
    if (basic || frame_free(raw.dofs, model.node_map.turns(node_index))) {
      rigid.dependents.push_back(node_index);
    } else if (!model.node_map.turns(rigid.reference)) {
      model.source.fail(raw.origin,
                        fmt::format("{}: some directions of a displacement system (CD) and "
                                    "a node of solids as reference exclude each other",
                                    raw.name));
    } else {
      add_rigid_rows(model, raw, rigid.reference, node_index);
    }
  }
  if (!rigid.dependents.empty()) model.deck.rigid.push_back(std::move(rigid));
}

// Adds a term with rotations: nodes of solids have displacements alone. Returns how many they are.
size_t split_term(Model& model, const Distributing::Term& term, Distributing& rbe3) {
  Distributing::Term turning{term.weight, term.dofs, {}};
  Distributing::Term nodes{term.weight, static_cast<DofMask>(term.dofs & kTranslations), {}};
  for (const NodeIndex index : term.node_indices)
    (model.node_map.turns(index) ? turning : nodes).node_indices.push_back(index);
  for (const Distributing::Term& one : {turning, nodes})
    if (!one.node_indices.empty() && one.dofs != 0) rbe3.terms.push_back(one);
  return nodes.node_indices.size();
}

void add_distributing(Model& model, const RawDistributing& raw) {
  Distributing rbe3;
  rbe3.name = fmt::format("rbe3_{}", raw.id);
  rbe3.where = model.source.where(raw.origin);
  rbe3.reference = model.require(raw.reference, raw.origin);
  rbe3.dofs = raw.dofs;
  size_t turning = 0;
  const auto check_frame = [&](NodeIndex node_index, DofMask dofs) {
    if (model.node_map.displacement_system(node_index) == 0 || frame_free(dofs, true)) return;
    model.source.fail(raw.origin,
                      fmt::format("RBE3 {}: some directions of a displacement system (CD) "
                                  "are not supported, expected 123, 456 or 123456",
                                  raw.id));
  };
  check_frame(rbe3.reference, raw.dofs);
  for (const auto& raw_term : raw.terms) {
    Distributing::Term term{raw_term.weight, raw_term.dofs,
                            model.node_indices(raw_term.grids, raw.origin, true)};
    for (const NodeIndex node_index : term.node_indices) {
      check_frame(node_index, term.dofs);
    }
    if ((term.dofs & kRotations) != 0) {
      turning += split_term(model, term, rbe3);
    } else {
      rbe3.terms.push_back(std::move(term));
    }
  }
  if (turning > 0)
    model.deck.notes.push_back(
        fmt::format("{}: RBE3 {}: components 456 of {} nodes of solids are left out: they have no "
                    "rotations",
                    rbe3.where, raw.id, turning));
  model.deck.distributing.push_back(std::move(rbe3));
}

}  // namespace

void build_couplings(Model& model) {
  Refusals& refusals = model.refusals;
  for (const RawRigid& raw : model.raw.rigid) refusals.attempt([&] { add_rigid(model, raw); });
  for (const RawDistributing& raw : model.raw.distributing) {
    refusals.attempt([&] { add_distributing(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
