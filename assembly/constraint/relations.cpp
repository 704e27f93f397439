// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/constraint/relations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_map>

#include "assembly/constraint/constraint_graph.hpp"
#include "assembly/constraint/coupling_members.hpp"
#include "assembly/constraint/tie_relations.hpp"
#include "core/base/error.hpp"
#include "core/base/near_position.hpp"
#include "core/mesh/mid_side_nodes.hpp"

namespace clatter::assembly {
namespace {

constexpr double kSameAxes = 1e-12;  // of an axis of a system to a basic one
constexpr double kGrounded = 1e-9;   // of the motion of an equation's terms taken one by one

using Dependences = std::vector<Dependence>;

/// Checks the dependence against the relations in the graph and adds it to `all`.
void depend(Dependence one, int relation, ConstraintGraph& graph, Dependences& all) {
  graph.depend(one.dof, one.on.dofs, relation);
  all.push_back(std::move(one));
}

std::vector<HeldGroup> gather_supports(const PartData& part, ConstraintGraph& graph) {
  std::vector<int> relations;
  for (const SupportSpec& spec : part.recipe.supports)
    relations.push_back(graph.add_relation(spec.where));
  std::vector<HeldGroup> supports = plan_supports(part.recipe, part.mesh, part.numbers);
  for (const HeldGroup& group : supports)
    for (const HeldDof& held : group.held)
      for (const int32_t dof : held_functional(held, part.numbers).dofs)
        graph.hold(dof, relations[held.support]);
  return supports;
}

/// The one of `nodes` that is nearest to a sensor.
int32_t nearest_node(const mesh::Mesh& mesh, const NodeSpec& spec,
                     const std::vector<int32_t>& nodes) {
  const auto distance = [&](int32_t node) {
    return (mesh.nodes.row(node).transpose() - *spec.near).norm();
  };
  const int32_t nearest = *std::min_element(
      nodes.begin(), nodes.end(), [&](int32_t a, int32_t b) { return distance(a) < distance(b); });
  double size = 0.0;
  for (const mesh::CellBlock& block : mesh.cells)
    size = std::max(size, size_around(mesh.nodes, block.nodes, nearest));
  for (const mesh::ShellBlock& block : mesh.shells)
    size = std::max(size, size_around(mesh.nodes, block.nodes, nearest));
  require_near(fmt::format("{}: near: the nearest node", spec.where), *spec.near,
               mesh.nodes.row(nearest).transpose(), size, "length_unit");
  return nearest;
}

/// The nodes and points of one selection; a sensor uses the nearest node of its surface.
std::vector<NodeOrPoint> owners_of(const PartData& part, const NodeSpec& spec,
                                   const TermSpec& term) {
  std::vector<NodeOrPoint> owners = selected(term.selection, part.mesh, part.numbers);
  if (!spec.near) return owners;
  std::vector<int32_t> nodes;
  for (const NodeOrPoint owner : owners) nodes.push_back(owner.index);
  return {NodeOrPoint::of_node(nearest_node(part.mesh, spec, nodes))};
}

/// Collects the DoFs that stay coordinates.
class KeptDofs {
 public:
  KeptDofs(const PartData& part, ConstraintGraph& graph) : part_(part), graph_(graph) {}

  std::vector<KeptDof> of(const NodeSpec& spec) {
    const int relation = graph_.add_relation(spec.where);
    std::vector<KeptDof> kept;
    std::map<int32_t, int32_t> number_of;  // by owner: one in several terms counts once
    for (const TermSpec& term : spec.terms)
      for (const NodeOrPoint owner : owners_of(part_, spec, term)) {
        const auto next = static_cast<int32_t>(number_of.size());
        const int32_t number = number_of.emplace(owner.index, next).first->second;
        const Eigen::Matrix3d axes = term.axes.at(part_.numbers.position(owner));
        const bool turned = !axes.isIdentity(kSameAxes);
        for (int d = 0; d < 6; ++d) {
          const bool wanted = term.directions.empty() || std::ranges::count(term.directions, d) > 0;
          if (!wanted || part_.numbers.of(owner, d) < 0) continue;
          kept.push_back({owner, d, number, axes.col(d % 3), turned});
          keep(kept.back(), relation, spec);
        }
      }
    return kept;
  }

 private:
  void keep(const KeptDof& dof, int relation, const NodeSpec& spec) {
    for (const int32_t id : ids_around(dof, part_.numbers)) {
      const auto [at, fresh] = turned_.emplace(id, dof.turned);
      if (at->second != dof.turned)
        throw InputError(
            fmt::format("{}: {} is kept along x y z and along the axes of a system, expected one "
                        "of them in all [[nodes]] and [[sensor]]",
                        spec.where, part_.numbers.name(id, part_.mesh.node_ids)));
      // A support in the same system may hold another direction.
      if (!dof.turned || !graph_.is_held(id)) graph_.keep(id, relation);
    }
  }

  const PartData& part_;
  ConstraintGraph& graph_;
  std::unordered_map<int32_t, bool> turned_;  // by id
};

std::vector<std::vector<KeptDof>> gather_kept(const PartData& part, ConstraintGraph& graph) {
  KeptDofs kept(part, graph);
  std::vector<std::vector<KeptDof>> all;
  for (const NodeSpec& spec : part.recipe.nodes) all.push_back(kept.of(spec));
  return all;
}

struct CouplingRelations {
  std::map<std::string, ReferenceDofs> references;
  std::vector<OntoPoint> onto_points;
  Dependences dependences;
};

/// A reference node with six new ids.
ReferenceDofs own_reference(const PartData& part, const CouplingSpec& spec, int32_t first_id) {
  ReferenceDofs reference;
  std::iota(reference.ids.begin(), reference.ids.end(), first_id);
  reference.position = reference_position(spec, coupling_members(part, spec));
  return reference;
}

/// The nodes and points of a rigid coupling follow its reference.
Dependences gather_followers(const PartData& part, const CouplingSpec& spec,
                             const ReferenceDofs& reference, ConstraintGraph& graph) {
  const int relation = graph.add_relation(spec.where);
  Dependences all;
  std::set<int32_t> done;  // a node in two selections follows once
  for (const TermSpec& followers : spec.terms)
    for (const NodeOrPoint owner : selected(followers.selection, part.mesh, part.numbers))
      for (Dependence& one : rigid_dependences(part.numbers, owner, spec.directions, reference))
        if (done.insert(one.dof).second) depend(std::move(one), relation, graph, all);
  return all;
}

OntoPoint gather_onto_point(const PartData& part, const CouplingSpec& spec,
                            ConstraintGraph& graph) {
  const int relation = graph.add_relation(spec.where);
  const ReferenceDofs reference = point_dofs(part.numbers, point_named(part, spec.on_point));
  OntoPoint onto{
      distribute(coupling_members(part, spec), reference.position, spec.directions, spec.where),
      {},
      spec.where};
  std::set<int32_t> on;
  for (const Functional& row : onto.coupling.nodal_rows())
    on.insert(row.dofs.begin(), row.dofs.end());
  for (const int d : spec.directions) {
    onto.ids.push_back(reference.ids[d]);
    graph.depend(onto.ids.back(), {on.begin(), on.end()}, relation, true);
  }
  return onto;
}

/// Rigid couplings and those onto points; others need no id of an existing DoF.
CouplingRelations gather_couplings(const PartData& part, int32_t first_id, ConstraintGraph& graph) {
  CouplingRelations all;
  for (const CouplingSpec& spec : part.recipe.couplings) {
    if (!spec.rigid) {
      if (!spec.on_point.empty()) all.onto_points.push_back(gather_onto_point(part, spec, graph));
      continue;
    }
    ReferenceDofs reference;
    if (spec.on_point.empty()) {
      reference =
          own_reference(part, spec, first_id + 6 * static_cast<int32_t>(all.references.size()));
      all.references[spec.name] = reference;
    } else {
      reference = point_dofs(part.numbers, point_named(part, spec.on_point));
    }
    std::ranges::move(gather_followers(part, spec, reference, graph),
                      std::back_inserter(all.dependences));
  }
  return all;
}

/// The weighted DoF of one term.
Functional term_of(const PartData& part, const EquationSpec::Term& term) {
  const NodeOrPoint owner = selected(term.selection, part.mesh, part.numbers)[0];
  return {{part.numbers.of(owner, term.direction)}, {term.coefficient}};
}

Dependences gather_equations(const PartData& part, ConstraintGraph& graph) {
  Dependences all;
  for (const EquationSpec& spec : part.recipe.equations) {
    const int relation = graph.add_relation(spec.where);
    Dependence first{term_of(part, spec.terms[0]).dofs[0], {}};
    for (const EquationSpec::Term& term : spec.terms) {
      if (&term == &spec.terms[0]) continue;
      const Functional one = term_of(part, term);
      first.on.dofs.push_back(one.dofs[0]);
      first.on.values.push_back(-one.values[0] / spec.terms[0].coefficient);
    }
    depend(std::move(first), relation, graph, all);
  }
  return all;
}

/// Springs are no relations: dependences of their ends are unchanged.
std::vector<Functional> elongations(const PartData& part) {
  std::vector<Functional> all;
  for (const SpringSpec& spec : part.recipe.springs) {
    Functional elongation;
    for (const EquationSpec::Term& term : spec.terms) {
      const Functional one = term_of(part, term);
      elongation.dofs.push_back(one.dofs[0]);
      elongation.values.push_back(one.values[0]);
    }
    all.push_back(std::move(elongation));
  }
  return all;
}

std::vector<Functional> matrix_dofs(const PartData& part) {
  std::vector<Functional> all;
  for (const MatrixSpec& spec : part.recipe.matrices) {
    Functional rows;
    for (const EquationSpec::Term& term : spec.terms) {
      rows.dofs.push_back(term_of(part, term).dofs[0]);
      rows.values.push_back(1.0);
    }
    all.push_back(std::move(rows));
  }
  return all;
}

Dependences gather_straight_edges(const PartData& part, ConstraintGraph& graph) {
  Dependences all;
  for (const StraightEdgesSpec& spec : part.recipe.straight_edges) {
    const int relation = graph.add_relation(spec.where);
    const std::vector<int32_t>& nodes = part.mesh.node_set(spec.node_set);
    const auto ends = mesh::ends_of_mid_side_nodes(part.mesh, nodes, spec.where);
    for (size_t n = 0; n < nodes.size(); ++n)
      for (int d = 0; d < 3; ++d)
        depend({3 * nodes[n] + d, {{3 * ends[n][0] + d, 3 * ends[n][1] + d}, {0.5, 0.5}}}, relation,
               graph, all);
  }
  return all;
}

/// The dependences in the given order of their DoFs, of which some have none.
Dependences ordered(const std::vector<int32_t>& dofs, std::vector<Dependences> kinds) {
  std::unordered_map<int32_t, Functional> by_dof;
  for (Dependences& kind : kinds)
    for (Dependence& one : kind) by_dof[one.dof] = std::move(one.on);
  Dependences all;
  for (const int32_t dof : dofs) {
    const auto found = by_dof.find(dof);
    if (found != by_dof.end()) all.push_back({dof, std::move(found->second)});
  }
  return all;
}

/// Values of a sum of terms for the unit rigid motions, relative to the largest term's, or nothing
/// when they are zero.
std::optional<Eigen::RowVectorXd> grounded_motion(const PartData& part,
                                                  const std::vector<EquationSpec::Term>& terms,
                                                  const Eigen::MatrixXd& nodal_rigid) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(6), alone = sum;
  for (const EquationSpec::Term& term : terms) {
    const Functional one = term_of(part, term);
    const Eigen::RowVectorXd motion = one.values[0] * nodal_rigid.row(one.dofs[0]);
    sum += motion;
    alone += motion.cwiseAbs();
  }
  if (!(sum.cwiseAbs().array() > kGrounded * alone.maxCoeff()).any()) return std::nullopt;
  return Eigen::RowVectorXd(sum / alone.maxCoeff());
}

}  // namespace

std::array<int32_t, 3> ids_around(const KeptDof& dof, const DofNumbers& numbers) {
  const int first = dof.direction < 3 ? 0 : 3;
  if (!dof.turned) {
    const int32_t id = numbers.of(dof.owner, dof.direction);
    return {id, id, id};
  }
  return {numbers.of(dof.owner, first), numbers.of(dof.owner, first + 1),
          numbers.of(dof.owner, first + 2)};
}

Relations gather_relations(const PartData& part) {
  ConstraintGraph graph([&](int32_t id) { return part.numbers.name(id, part.mesh.node_ids); });
  const auto first_id = static_cast<int32_t>(part.numbers.count());
  std::vector<HeldGroup> supports = gather_supports(part, graph);
  std::vector<std::vector<KeptDof>> kept = gather_kept(part, graph);
  CouplingRelations couplings = gather_couplings(part, first_id, graph);
  Dependences equations = gather_equations(part, graph);
  std::vector<Functional> springs = elongations(part);
  Dependences edges = gather_straight_edges(part, graph);
  TieRelations ties =
      gather_ties(part, first_id + 6 * static_cast<int32_t>(couplings.references.size()), graph);
  std::vector<Dependences> kinds;
  for (Dependences* kind : {&couplings.dependences, &equations, &edges, &ties.dependences})
    kinds.push_back(std::move(*kind));
  return {.supports = std::move(supports),
          .kept = std::move(kept),
          .references = std::move(couplings.references),
          .onto_points = std::move(couplings.onto_points),
          .springs = std::move(springs),
          .matrix_dofs = matrix_dofs(part),
          .bolts = std::move(ties.bolts),
          .dependences = ordered(graph.order(), std::move(kinds))};
}

std::vector<int32_t> rigid_body_of_nodes(const PartData& part,
                                         const std::map<std::string, ReferenceDofs>& references,
                                         int directions) {
  std::vector<int32_t> body(static_cast<size_t>(part.mesh.nodes.rows()), -1);
  for (const CouplingSpec& spec : part.recipe.couplings) {
    if (!spec.rigid) continue;
    const bool on_point = !spec.on_point.empty();
    const int32_t point = on_point ? point_named(part, spec.on_point) : -1;
    const int32_t id = on_point ? part.numbers.of_point(point, 3) : references.at(spec.name).ids[3];
    const bool wholly =
        std::ranges::count_if(spec.directions, [&](int d) { return d < directions; }) == directions;
    for (const TermSpec& followers : spec.terms)
      for (const NodeOrPoint owner : selected(followers.selection, part.mesh, part.numbers))
        if (wholly && !owner.is_point()) body[owner.index] = id;
    if (!on_point) continue;
    const int32_t node = part.numbers.points()[point].node;
    if (node >= 0) body[node] = id;
  }
  return body;
}

Eigen::MatrixXd grounded_motions(const PartData& part, const Eigen::MatrixXd& nodal_rigid) {
  std::vector<Eigen::RowVectorXd> rows;
  const auto note = [&](const std::vector<EquationSpec::Term>& terms) {
    if (auto motion = grounded_motion(part, terms, nodal_rigid)) rows.push_back(*motion);
  };
  for (const EquationSpec& spec : part.recipe.equations) note(spec.terms);
  for (const SpringSpec& spec : part.recipe.springs) note(spec.terms);
  for (const MatrixSpec& spec : part.recipe.matrices) {
    if (spec.is_mass) continue;
    Eigen::MatrixXd motion(spec.values.cols(), 6);
    for (size_t i = 0; i < spec.terms.size(); ++i)
      motion.row(static_cast<Eigen::Index>(i)) =
          nodal_rigid.row(term_of(part, spec.terms[i]).dofs[0]);
    const Eigen::MatrixXd force = spec.values * motion;
    const double alone = (spec.values.cwiseAbs() * motion.cwiseAbs()).maxCoeff();
    for (Eigen::Index i = 0; i < force.rows(); ++i)
      if ((force.row(i).cwiseAbs().array() > kGrounded * alone).any())
        rows.emplace_back(force.row(i) / alone);
  }
  Eigen::MatrixXd all(static_cast<Eigen::Index>(rows.size()), 6);
  for (size_t r = 0; r < rows.size(); ++r) all.row(static_cast<Eigen::Index>(r)) = rows[r];
  return all;
}

}  // namespace clatter::assembly
