// SPDX-License-Identifier: GPL-3.0-or-later
// Gathers relations: supports, sensors, rigid couplings, equations and couplings onto points.
#include <fmt/format.h>

#include <algorithm>

#include "assembly/constraint/constrainer.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/mesh/mid_side_nodes.hpp"

namespace clatter::assembly {
namespace {

constexpr double kGrounded = 1e-9;  // of the motion of an equation's terms taken one by one

}  // namespace

Constrainer::Constrainer(const mesh::Mesh& mesh, const Recipe& recipe, const DofNumbers& numbers,
                         SurfaceCache& surfaces)
    : mesh_(mesh),
      recipe_(recipe),
      numbers_(numbers),
      surfaces_(surfaces),
      graph_([this](int32_t id) { return numbers_.name(id, mesh_.node_ids); }),
      next_own_(static_cast<int32_t>(numbers.count())) {}

int32_t Constrainer::point_named(const std::string& name) const {
  return selected({"", "", name, ""}, mesh_, numbers_)[0].point();
}

ReferenceDofs Constrainer::point_dofs(int32_t point) const {
  ReferenceDofs dofs;
  for (int d = 0; d < 6; ++d) dofs.ids[static_cast<size_t>(d)] = numbers_.of_point(point, d);
  dofs.position = numbers_.position(NodeOrPoint::of_point(point));
  return dofs;
}

void Constrainer::depend(int32_t dof, Functional on, int relation) {
  graph_.depend(dof, on.dofs, relation);
  dependences_[dof] = std::move(on);
}

void Constrainer::gather_supports() {
  std::vector<int> relations;
  for (const SupportSpec& spec : recipe_.supports)
    relations.push_back(graph_.add_relation(spec.selection.where));
  supports_ = plan_supports(recipe_, mesh_, numbers_);
  for (const HeldGroup& group : supports_)
    for (const HeldDof& held : group.held)
      for (const int32_t dof : held_functional(held, numbers_).dofs)
        graph_.hold(dof, relations[static_cast<size_t>(held.support)]);
}

/// Sensors use the nearest node of their surface. All these displacements stay coordinates.
void Constrainer::gather_node_sets() {
  for (const NodeSpec& spec : recipe_.nodes) {
    const int relation = graph_.add_relation(spec.selection.where);
    std::vector<int32_t> nodes;
    for (const NodeOrPoint owner : selected(spec.selection, mesh_, numbers_))
      nodes.push_back(owner.index);
    if (spec.near) {
      const auto distance = [&](int32_t node) {
        return (mesh_.nodes.row(node).transpose() - *spec.near).norm();
      };
      const int32_t nearest =
          *std::min_element(nodes.begin(), nodes.end(),
                            [&](int32_t a, int32_t b) { return distance(a) < distance(b); });
      nodes = {nearest};
      say(fmt::format(
          "{}: node {} at ({:.4f}, {:.4f}, {:.4f}) m, {:.4f} m from the requested position",
          spec.name, nearest, mesh_.nodes(nearest, 0), mesh_.nodes(nearest, 1),
          mesh_.nodes(nearest, 2), distance(nearest)));
    }
    for (const int32_t node : nodes)
      for (int d = 0; d < 3; ++d) {
        graph_.keep(3 * node + d, relation);
        kept_.push_back(3 * node + d);
      }
    set_nodes_.push_back(std::move(nodes));
  }
}

/// The members of a distributing coupling.
std::vector<Member> Constrainer::members(const CouplingSpec& spec) {
  std::vector<Member> all;
  for (const TermSpec& term : spec.terms) {
    std::vector<Member> found;
    if (!term.selection.surface.empty()) {
      found = members_of(mesh_.nodes, surfaces_.at(term.selection.surface));
    } else {
      for (const NodeOrPoint owner : selected(term.selection, mesh_, numbers_)) {
        Member member;
        for (int d = 0; d < 6; ++d) member.dofs[static_cast<size_t>(d)] = numbers_.of(owner, d);
        member.position = numbers_.position(owner);
        member.weight = 1.0;
        found.push_back(member);
      }
    }
    for (Member& member : found) {
      member.weight *= term.weight;
      for (int d = 0; d < 6; ++d) {
        const bool requested = std::count(term.directions.begin(), term.directions.end(), d) > 0;
        if (requested && !member.has(d))
          throw InputError(
              fmt::format("{}: found {} of a node, expected displacements (nodes have "
                          "no rotations)",
                          term.selection.where, kDofNames[static_cast<size_t>(d)]));
        if (!requested) member.dofs[static_cast<size_t>(d)] = -1;
      }
    }
    all.insert(all.end(), found.begin(), found.end());
  }
  return all;
}

/// The given position of a coupling's own reference node, or the centre of its members.
Eigen::Vector3d Constrainer::own_position(const CouplingSpec& spec,
                                          const std::vector<Member>& members) {
  if (spec.at) return *spec.at;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double weight = 0.0;
  for (const Member& member : members) {
    centre += member.weight * member.position;
    weight += member.weight;
  }
  return centre / weight;
}

void Constrainer::add_rigid(const CouplingSpec& spec) {
  const int relation = graph_.add_relation(spec.where);
  ReferenceDofs reference;
  if (spec.on_point.empty()) {
    for (int32_t& id : reference.ids) id = next_own_++;
    reference.position = own_position(spec, members(spec));
    own_references_[spec.name] = reference;
    out_.sets[spec.name] =
        reference_set(spec.name, spec.kind, reference.position, {0, 1, 2, 3, 4, 5});
  } else {
    reference = point_dofs(point_named(spec.on_point));
  }
  std::set<int32_t> done;  // a node in two selections follows once
  for (const TermSpec& followers : spec.terms)
    for (const NodeOrPoint owner : selected(followers.selection, mesh_, numbers_)) {
      note_rigid(spec, owner, reference.ids[3]);
      for (Dependence& one : rigid_dependences(numbers_, owner, spec.directions, reference))
        if (done.insert(one.dof).second) depend(one.dof, std::move(one.on), relation);
    }
  if (spec.on_point.empty()) return;
  const int32_t node = numbers_.points()[static_cast<size_t>(point_named(spec.on_point))].node;
  if (node >= 0) out_.rigid_of_node[static_cast<size_t>(node)] = reference.ids[3];
}

/// Cells between nodes of one rigid body do not deform.
void Constrainer::note_rigid(const CouplingSpec& spec, NodeOrPoint owner, int32_t reference) {
  const bool wholly = std::count_if(spec.directions.begin(), spec.directions.end(),
                                    [](int d) { return d < 3; }) == 3;
  if (wholly && !owner.is_point()) out_.rigid_of_node[static_cast<size_t>(owner.index)] = reference;
}

void Constrainer::add_onto_point(const CouplingSpec& spec) {
  const int relation = graph_.add_relation(spec.where);
  const ReferenceDofs reference = point_dofs(point_named(spec.on_point));
  Onto onto;
  onto.where = spec.where;
  onto.coupling = distribute(members(spec), reference.position, spec.directions, spec.where);
  std::set<int32_t> on;
  for (const Functional& row : onto.coupling.nodal_rows())
    on.insert(row.dofs.begin(), row.dofs.end());
  for (const int d : spec.directions) {
    onto.ids.push_back(reference.ids[static_cast<size_t>(d)]);
    graph_.depend(onto.ids.back(), {on.begin(), on.end()}, relation, true);
  }
  onto_.push_back(std::move(onto));
}

void Constrainer::gather_couplings() {
  for (const CouplingSpec& spec : recipe_.couplings) {
    if (spec.rigid)
      add_rigid(spec);
    else if (!spec.on_point.empty())
      add_onto_point(spec);
  }
}

Functional Constrainer::term(const EquationSpec::Term& term) const {
  const NodeOrPoint owner = selected(term.selection, mesh_, numbers_)[0];
  return {{numbers_.of(owner, term.direction)}, {term.coefficient}};
}

/// Stores the value of a sum of terms for the unit rigid motions, unless it is zero.
void Constrainer::note_grounded(const std::vector<EquationSpec::Term>& terms) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(6), alone = sum;
  for (const EquationSpec::Term& part : terms) {
    const Functional one = term(part);
    const Eigen::RowVectorXd motion = one.values[0] * out_.nodal_rigid.row(one.dofs[0]);
    sum += motion;
    alone += motion.cwiseAbs();
  }
  if ((sum.cwiseAbs().array() > kGrounded * alone.maxCoeff()).any())
    grounded_.push_back(sum / alone.maxCoeff());
}

void Constrainer::gather_equations() {
  for (const EquationSpec& spec : recipe_.equations) {
    const int relation = graph_.add_relation(spec.where);
    const int32_t dof = term(spec.terms[0]).dofs[0];
    Functional on;
    for (const EquationSpec::Term& part : spec.terms) {
      if (&part == &spec.terms[0]) continue;
      const Functional one = term(part);
      on.dofs.push_back(one.dofs[0]);
      on.values.push_back(-one.values[0] / spec.terms[0].coefficient);
    }
    depend(dof, std::move(on), relation);
    note_grounded(spec.terms);
  }
}

/// Springs are no relations: dependences of their ends are unchanged.
void Constrainer::gather_springs() {
  for (const SpringSpec& spec : recipe_.springs) {
    Functional elongation;
    for (const EquationSpec::Term& part : spec.terms) {
      const Functional one = term(part);
      elongation.dofs.push_back(one.dofs[0]);
      elongation.values.push_back(one.values[0]);
    }
    out_.springs.push_back(std::move(elongation));
    note_grounded(spec.terms);
  }
}

void Constrainer::gather_straight_edges() {
  for (const StraightEdgesSpec& spec : recipe_.straight_edges) {
    const int relation = graph_.add_relation(spec.where);
    const std::vector<int32_t>& nodes = mesh_.node_set(spec.node_set);
    const auto ends = mesh::ends_of_mid_side_nodes(mesh_, nodes, spec.where);
    for (size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < 3; ++d)
        depend(3 * nodes[n] + d, {{3 * ends[n][0] + d, 3 * ends[n][1] + d}, {0.5, 0.5}}, relation);
  }
}

}  // namespace clatter::assembly
