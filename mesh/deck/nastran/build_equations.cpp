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
    const int direction = model.direction_at(term.grid, term.direction, raw.origin);
    for (const Equation::Term& one :
         terms_along(model, node_index, direction, term.coefficient, raw.origin))
      equation.terms.push_back(one);
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

std::vector<Equation::Term> terms_along(Model& model, NodeIndex node_index, int direction,
                                        double factor, Origin origin) {
  std::vector<Equation::Term> terms;
  const int32_t system = model.node_map.displacement_system(node_index);
  if (system == 0) {
    add_term(terms, node_index, direction, factor);
    return terms;
  }
  const int base = direction < 3 ? 0 : 3;
  const Vector3d t =
      factor * model.systems.directions(system, model.node_map.position(node_index), origin)
                   .col(direction - base);
  Eigen::Index largest = 0;
  t.cwiseAbs().maxCoeff(&largest);
  add_term(terms, node_index, base + static_cast<int>(largest), t[largest]);
  for (int k = 0; k < 3; ++k) {
    if (k != largest) add_term(terms, node_index, base + k, t[k]);
  }
  return terms;
}

void build_equations(Model& model) {
  model.refusals.attempt([&] { add_chosen_mpc(model); });
}

}  // namespace clatter::mesh::deck::nastran
