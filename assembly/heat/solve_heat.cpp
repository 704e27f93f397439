// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/heat/solve_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include "assembly/constraint/constraint_graph.hpp"
#include "assembly/constraint/edge_tie.hpp"
#include "assembly/constraint/elimination.hpp"
#include "assembly/constraint/tie_relations.hpp"
#include "assembly/heat/heat_bodies.hpp"
#include "assembly/heat/heat_terms.hpp"
#include "core/base/error.hpp"
#include "core/base/log.hpp"
#include "core/fe/heat.hpp"
#include "core/mesh/mid_side_nodes.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::assembly {
namespace {

constexpr double kHeatBalance = 1e-8;  // of the heat that flows; the solution leaves 1e-12 or so
constexpr double kHeatRounding = 64.0 * std::numeric_limits<double>::epsilon();
constexpr int kRefinements = 2;  // each removes most of the rounding of the solve

/// K T = q before elimination.
struct HeatProblem {
  SparseMatrix K;                // n_nodes x n_nodes, lower triangle [W/K]
  Eigen::VectorXd q;             // n_nodes [W]
  std::vector<HeatTerms> terms;  // of the boundaries
  FixedNodes fixed;
  Elimination elimination;
};

const HeatSpec::Contact* contact_of(const HeatSpec& spec, const TieSpec& tie) {
  const auto found = std::find_if(spec.contacts.begin(), spec.contacts.end(),
                                  [&](const auto& contact) { return contact.tie == tie.name; });
  return found == spec.contacts.end() ? nullptr : &*found;
}

/// Temperatures that follow others.
class FollowingNodes {
 public:
  FollowingNodes(const PartData& part, const FixedNodes& fixed)
      : fixed_(fixed), graph_([&part](int32_t node) {
          return "the temperature of " + part.numbers.name(3 * node, part.mesh.node_ids);
        }) {}

  int add_relation(const std::string& where) { return graph_.add_relation(where); }
  /// T_node = sum values T; false, without effect, where the node's temperature is fixed.
  bool follow(int32_t node, Functional on, int relation) {
    if (fixed_.kelvin.contains(node)) return false;
    graph_.depend(node, on.dofs, relation);
    on_[node] = std::move(on);
    return true;
  }
  Elimination eliminate(int64_t nodes) const {
    std::vector<int32_t> held;
    for (const auto& [node, kelvin] : fixed_.kelvin) held.push_back(node);
    Eliminator eliminator(nodes, held, {});
    for (const int32_t node : graph_.order()) eliminator.depend(node, on_.at(node));
    return eliminator.finish();
  }

 private:
  const FixedNodes& fixed_;
  ConstraintGraph graph_;
  std::unordered_map<int32_t, Functional> on_;
};

/// Both sides of a tie get the same temperature.
void follow_tie(const TieSpec& tie, const Projection& found, FollowingNodes& following) {
  const int relation = following.add_relation(tie.where);
  int held = 0;
  for (const ProjectedNode& row : found.tied) {
    Functional on;
    for (const auto& [node, value] : row.on) {
      on.dofs.push_back(node);
      on.values.push_back(value);
    }
    if (!following.follow(row.node, std::move(on), relation)) ++held;
  }
  if (held > 0)
    warn(fmt::format("{}: {} slave temperatures are fixed and not tied", tie.name, held));
}

/// Adds ties to `bodies`, and as conduction to K or as equal temperatures to the relations.
Elimination eliminate_temperatures(const PartData& part, const HeatSpec& spec,
                                   const FixedNodes& fixed, HeatBodies& bodies, SparseMatrix& K) {
  FollowingNodes following(part, fixed);
  for (const TieSpec& tie : part.recipe.ties) {
    const HeatSpec::Contact* contact = contact_of(spec, tie);
    if (!tie.edge.empty() && contact != nullptr)
      throw InputError(
          fmt::format("{}: found a contact of the tie {}, which is one of an edge, expected ties "
                      "of faces alone",
                      spec.where, tie.name));
    TieSpec resolved = tie;
    const Projection found =
        tie.edge.empty() ? project_tie(part, resolved) : project_edge(part, tie);
    for (const ProjectedNode& row : found.tied)
      for (const auto& [node, value] : row.on) bodies.join(row.node, node);
    if (contact != nullptr)
      K += contact_conduction(part, tie, found, contact->conductance);
    else
      follow_tie(tie, found, following);
  }
  for (const StraightEdgesSpec& straight : part.recipe.straight_edges) {
    const int relation = following.add_relation(straight.where);
    const std::vector<int32_t>& nodes = part.mesh.node_set(straight.node_set);
    const auto ends = mesh::ends_of_mid_side_nodes(part.mesh, nodes, straight.where);
    for (size_t n = 0; n < nodes.size(); ++n)
      following.follow(nodes[n], {{ends[n][0], ends[n][1]}, {0.5, 0.5}}, relation);
  }
  return following.eliminate(part.mesh.nodes.rows());
}

void require_fixed(const PartData& part, const HeatSpec& spec, const HeatBodies& bodies) {
  const auto loose = bodies.first_loose();
  if (!loose) return;
  const Eigen::RowVector3d at = part.mesh.nodes.row(*loose);
  throw InputError(fmt::format(
      "{}: found nothing that fixes the temperature of the body at ({:.6g}, {:.6g}, {:.6g}) m, "
      "expected a film or a fixed temperature on it",
      spec.where, at(0), at(1), at(2)));
}

HeatProblem problem_of(const PartData& part, const HeatSpec& spec, const SparseMatrix& cells) {
  HeatProblem problem{.K = cells,
                      .q = Eigen::VectorXd::Zero(part.mesh.nodes.rows()),
                      .terms = heat_terms(part, spec),
                      .fixed = fixed_nodes(part, spec),
                      .elimination = {}};
  HeatBodies bodies(part.mesh);
  for (const HeatTerms& one : problem.terms) {
    problem.q += one.q;
    if (one.H.nonZeros() > 0) problem.K += one.H;
  }
  for (const HeatSpec::Film& film : spec.films)
    for (const int32_t node : mesh::nodes_of(part.mesh.surface(film.surface))) bodies.fix(node);
  for (const auto& [node, kelvin] : problem.fixed.kelvin) bodies.fix(node);
  problem.elimination = eliminate_temperatures(part, spec, problem.fixed, bodies, problem.K);
  require_fixed(part, spec, bodies);
  return problem;
}

/// x of K x = f, with the residual corrected.
Eigen::VectorXd solve_refined_heat(const SparseMatrix& K, const Eigen::VectorXd& f) {
  if (K.rows() == 0) return {};
  const sparse::SupernodalFactor factor(K);
  Eigen::VectorXd x = factor.solve(f);
  for (int step = 0; step < kRefinements; ++step)
    x += factor.solve(f - Eigen::VectorXd(multiply_symmetric(K, x)));
  return x;
}

/// The heat through each boundary, and the balance.
void add_heat(const HeatProblem& problem, const Eigen::VectorXd& reactions, double size,
              fe::HeatField& field) {
  std::vector<double> heat;
  for (const HeatTerms& one : problem.terms) {
    field.boundaries.push_back(one.name);
    heat.push_back(one.into_part(field.temperature));
  }
  const size_t first = heat.size();
  for (const std::string& name : problem.fixed.boundaries) {
    field.boundaries.push_back(name);
    heat.push_back(0.0);
  }
  for (const auto& [node, which] : problem.fixed.which)
    heat[first + which] += reactions(problem.elimination.support_of[node]);
  field.heat =
      Eigen::Map<const Eigen::VectorXd>(heat.data(), static_cast<Eigen::Index>(heat.size()));
  // A part of one temperature: what is left is the rounding of the terms.
  const double flow = std::max(field.heat.lpNorm<1>(), kHeatRounding / kHeatBalance * size);
  field.balance = flow > 0.0 ? std::abs(field.heat.sum()) / flow : 0.0;
}

fe::HeatField solve_one_heat(const PartData& part, const HeatSpec& spec,
                             const SparseMatrix& cells) {
  HeatProblem problem = problem_of(part, spec, cells);
  const Elimination& e = problem.elimination;
  Eigen::VectorXd s(e.supports());
  for (const auto& [node, kelvin] : problem.fixed.kelvin) s(e.support_of[node]) = kelvin;
  const CoordinateBlocks K = transform_with_supports(std::move(problem.K), e);
  Eigen::VectorXd f = e.T.transpose() * problem.q;
  if (s.size() > 0) f -= K.sq.transpose() * s;
  const Eigen::VectorXd x = solve_refined_heat(K.qq, f);

  fe::HeatField field;
  field.temperature = e.T * x;
  Eigen::VectorXd reactions(s.size());
  if (s.size() > 0) {
    field.temperature += e.T_s * s;
    reactions =
        K.sq * x + Eigen::VectorXd(multiply_symmetric(K.ss, s)) - e.T_s.transpose() * problem.q;
  }
  double size = problem.q.lpNorm<1>();
  if (x.size() > 0) size += magnitude_product(K.qq, x).sum();
  if (s.size() > 0) size += magnitude_product(K.ss, s).sum();
  add_heat(problem, reactions, size, field);
  // Written so that NaN is also refused.
  if (!(field.balance <= kHeatBalance))
    throw NumericsError(fmt::format("{}: heat balance error {:.3g}, allowed {:.0e}", spec.where,
                                    field.balance, kHeatBalance));
  return field;
}

void say_field(const HeatSpec& spec, const fe::HeatField& field) {
  say(fmt::format("heat {}: {:.1f} to {:.1f} degrees Celsius, balance {:.1e}", spec.name,
                  field.temperature.minCoeff() - kZeroCelsius,
                  field.temperature.maxCoeff() - kZeroCelsius, field.balance));
  for (size_t k = 0; k < field.boundaries.size(); ++k)
    say(fmt::format("  {}: {:.6g} W into the part", field.boundaries[k],
                    field.heat(static_cast<Eigen::Index>(k))));
}

}  // namespace

std::map<std::string, fe::HeatField> solve_heat(const PartData& part,
                                                const fe::NodePattern& pattern) {
  std::map<std::string, fe::HeatField> fields;
  if (part.recipe.heats.empty()) return fields;
  if (!part.recipe.gaskets.empty())
    warn(
        fmt::format("{}: [[heat]]: no heat flows through a [[gasket]]: a [[tie]] of the same faces "
                    "with a [[heat.contact]] of its conductance carries it",
                    part.mesh.name));
  SparseMatrix cells = fe::conduction(part.mesh, part.recipe.materials, pattern);
  if (!part.mesh.shells.empty())
    cells += fe::sheet_conduction(part.mesh, part.recipe.materials, part.recipe.sections);
  for (const HeatSpec& spec : part.recipe.heats) {
    const fe::HeatField& field = fields[spec.name] = solve_one_heat(part, spec, cells);
    say_field(spec, field);
  }
  return fields;
}

}  // namespace clatter::assembly
