// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/shell_joints.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace clatter::mesh::deck {
namespace {

constexpr DofMask kRotations = kAllDofs & ~kTranslations;

/// The nodes whose rotations something else than shells has.
class Clamped {
 public:
  explicit Clamped(const Deck& deck)
      : is_(static_cast<size_t>(deck.mesh.nodes.rows()) + deck.points.size(), false) {
    for (const Rigid& rigid : deck.rigid) {
      add({rigid.reference}, kAllDofs);
      add(rigid.dependents, rigid.dofs);
    }
    for (const Distributing& one : deck.distributing) {
      add({one.reference}, one.dofs);
      for (const Distributing::Term& term : one.terms) add(term.node_indices, term.dofs);
    }
    for (const Equation& equation : deck.equations)
      for (const Equation::Term& term : equation.terms)
        add({term.node_index}, static_cast<DofMask>(1 << term.direction));
    add_all(deck.supports);
    for (const Step& step : deck.steps) add_all(step.supports);
  }

  bool all(const std::vector<NodeIndex>& nodes) const {
    return std::ranges::all_of(nodes,
                               [&](NodeIndex node) { return is_[static_cast<size_t>(node)]; });
  }

 private:
  void add(const std::vector<NodeIndex>& nodes, DofMask dofs) {
    if ((dofs & kRotations) == 0) return;
    for (const NodeIndex node : nodes) is_[static_cast<size_t>(node)] = true;
  }
  void add_all(const std::vector<Support>& supports) {
    for (const Support& support : supports) add(support.node_indices, support.dofs);
  }

  std::vector<bool> is_;
};

}  // namespace

std::vector<bool> turning_flags(const Mesh& mesh) {
  std::vector<bool> turns(static_cast<size_t>(mesh.nodes.rows()), false);
  for (const int32_t node : turning_nodes(mesh)) turns[node] = true;
  return turns;
}

void refuse_hinges(const Deck& deck, const std::vector<ShellHinge>& hinges, Refusals& refusals) {
  if (hinges.empty()) return;
  const Clamped clamped(deck);
  const ShellHinge* first = nullptr;
  int64_t count = 0;
  for (const ShellHinge& hinge : hinges) {
    if (clamped.all(hinge.nodes)) continue;
    if (first == nullptr) first = &hinge;
    ++count;
  }
  if (first == nullptr) return;
  refusals.add(fmt::format(
      "{}: found {} on nodes of solids, which do not turn: a hinge{}; nodes of its own for the "
      "shell, which a [[tie]] of its edge or a rigid or distributing coupling (RBE2, RBE3, "
      "*COUPLING) joins to the solid, clamp it",
      first->where, first->what,
      count == 1 ? "" : fmt::format(" ({} shells have such nodes)", count)));
}

}  // namespace clatter::mesh::deck
