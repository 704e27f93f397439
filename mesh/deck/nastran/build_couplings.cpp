// SPDX-License-Identifier: GPL-3.0-or-later
// RBE2 and RBE3.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>

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

// Transforms rows t so that each has its own pivot column (1 there, 0 in the other rows), by
// elimination with the largest pivots. Returns the pivots.
std::vector<int> reduce_rows(std::vector<Vector3d>& rows) {
  std::vector<int> pivots;
  for (size_t i = 0; i < rows.size(); ++i) {
    Eigen::Index pivot = 0;
    rows[i].cwiseAbs().maxCoeff(&pivot);
    rows[i] /= rows[i][pivot];
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j] -= rows[j][pivot] * rows[i];
    }
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j][pivot] = 0.0;
    }
    pivots.push_back(static_cast<int>(pivot));
  }
  return pivots;
}

// RBE2 in some directions of a displacement system: for each direction t of the dependent d,
// t . (u_d - u_r - theta_r x (x_d - x_r)) = 0, and for rotations t . (theta_d - theta_r) = 0.
void add_rigid_rows(Model& model, const RawRigid& raw, NodeIndex reference, NodeIndex dependent) {
  const Matrix3d axes = model.systems.directions(model.node_map.displacement_system(dependent),
                                                 model.node_map.position(dependent), raw.origin);
  const Vector3d arm = model.node_map.position(dependent) - model.node_map.position(reference);
  for (const int base : {0, 3}) {
    if (base == 3 && !model.node_map.is_point(dependent)) break;
    std::vector<Vector3d> rows;
    for (int k = 0; k < 3; ++k) {
      if (raw.dofs >> (base + k) & 1) rows.push_back(axes.col(k));
    }
    const std::vector<int> pivots = reduce_rows(rows);
    for (size_t i = 0; i < rows.size(); ++i) {
      const Vector3d& t = rows[i];
      const Vector3d turn = arm.cross(t);
      Equation equation;
      equation.where = model.source.where(raw.origin);
      add_term(equation.terms, dependent, base + pivots[i], 1.0);
      for (int k = 0; k < 3; ++k) {
        if (k != pivots[i]) add_term(equation.terms, dependent, base + k, t[k]);
      }
      for (int k = 0; k < 3; ++k) add_term(equation.terms, reference, base + k, -t[k]);
      for (int k = 0; base == 0 && k < 3; ++k) add_term(equation.terms, reference, 3 + k, -turn[k]);
      model.deck.equations.push_back(std::move(equation));
    }
  }
}

void add_rigid(Model& model, const RawRigid& raw) {
  Rigid rigid;
  rigid.name = fmt::format("rbe2_{}", raw.id);
  rigid.where = model.source.where(raw.origin);
  rigid.reference = model.require(raw.reference, raw.origin);
  rigid.dofs = raw.dofs;
  for (const NodeIndex node_index : model.node_indices(raw.dependents, raw.origin, true)) {
    if (node_index == rigid.reference) {
      model.source.fail(raw.origin, fmt::format("RBE2 {}: its reference {} is a dependent, too",
                                                raw.id, raw.reference));
    }
    const bool basic = model.node_map.displacement_system(node_index) == 0;
    if (basic || frame_free(raw.dofs, model.node_map.is_point(node_index))) {
      rigid.dependents.push_back(node_index);
    } else if (!model.node_map.is_point(rigid.reference)) {
      model.source.fail(
          raw.origin,
          fmt::format("RBE2 {}: found some directions of a displacement system (CD) and "
                      "a node of solids as reference, expected one of both",
                      raw.id));
    } else {
      add_rigid_rows(model, raw, rigid.reference, node_index);
    }
  }
  if (!rigid.dependents.empty()) model.deck.rigid.push_back(std::move(rigid));
}

void add_distributing(Model& model, const RawDistributing& raw) {
  Distributing rbe3;
  rbe3.name = fmt::format("rbe3_{}", raw.id);
  rbe3.where = model.source.where(raw.origin);
  rbe3.reference = model.require(raw.reference, raw.origin);
  rbe3.dofs = raw.dofs;
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
      if (!model.node_map.is_point(node_index) && (term.dofs & kRotations) != 0) {
        model.source.fail(
            raw.origin,
            fmt::format("RBE3 {}: found rotations of node {} of solids, which has none; "
                        "expected components 123",
                        raw.id, model.deck.mesh.node_ids[static_cast<size_t>(node_index)]));
      }
    }
    rbe3.terms.push_back(std::move(term));
  }
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
