// SPDX-License-Identifier: GPL-3.0-or-later
// MPC and MPCADD.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"
#include "mesh/deck/nastran/set_choice.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

using Eigen::Vector3d;

void add_equation(Model& model, const RawEquation& raw) {
  Equation equation;
  equation.where = model.source.where(raw.origin);
  for (const auto& term : raw.terms) {
    const NodeIndex node_index = model.require(term.grid, raw.origin);
    const int base = term.direction < 3 ? 0 : 3;
    if (base == 3 && !model.node_map.is_point(node_index)) {
      model.source.fail(raw.origin, fmt::format("MPC: found a rotation of node {} of solids, which "
                                                "has none",
                                                term.grid));
    }
    const int32_t system = model.node_map.displacement_system(node_index);
    if (system == 0) {
      add_term(equation.terms, node_index, term.direction, term.coefficient);
      continue;
    }
    const Vector3d t =
        term.coefficient *
        model.systems.directions(system, model.node_map.position(node_index), raw.origin)
            .col(term.direction - base);
    Eigen::Index largest = 0;  // first: the first term of an equation is the dependent
    t.cwiseAbs().maxCoeff(&largest);
    add_term(equation.terms, node_index, base + static_cast<int>(largest), t[largest]);
    for (int k = 0; k < 3; ++k) {
      if (k != largest) add_term(equation.terms, node_index, base + k, t[k]);
    }
  }
  model.deck.equations.push_back(std::move(equation));
}

// The MPC set of the case control, or the only one.
int32_t chosen_mpc(const Model& model) {
  const Control& control = model.raw.control;
  if (control.has_cases) {
    const int32_t first = control.subcases.front().choice.mpc;
    for (const Subcase& subcase : control.subcases) {
      if (subcase.choice.mpc == first) continue;
      model.source.fail(
          subcase.origin,
          fmt::format("subcase {}: found MPC = {}, expected {} as in the first subcase", subcase.id,
                      subcase.choice.mpc, first));
    }
    return first;
  }
  return only_set(model, "MPC", model.raw.mpc, model.raw.mpc_sums);
}

void add_chosen_mpc(Model& model) {
  const int32_t mpc = chosen_mpc(model);
  if (mpc == 0) return;
  const Origin origin = model.raw.control.has_cases ? model.raw.control.subcases.front().origin : 0;
  for (const int32_t set :
       members_of(model, "MPC", mpc, model.raw.mpc, model.raw.mpc_sums, origin)) {
    for (const RawEquation& raw : model.raw.mpc.at(set)) {
      model.refusals.attempt([&] { add_equation(model, raw); });
    }
  }
}

}  // namespace

void build_equations(Model& model) {
  model.refusals.attempt([&] { add_chosen_mpc(model); });
}

}  // namespace clatter::mesh::deck::nastran
