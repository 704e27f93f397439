// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/deck/recipe/recipe.hpp"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "core/base/error.hpp"
#include "mesh/deck/recipe/loads.hpp"
#include "mesh/deck/recipe/materials.hpp"
#include "mesh/deck/recipe/names.hpp"

namespace clatter::mesh::deck {
namespace {

using keys::Source;

class RecipeMaker {
 public:
  explicit RecipeMaker(Deck& deck) : deck_(deck), names_(deck) {}

  Recipe make() {
    notes();
    if (deck_.mass == MassForm::kLumped) {
      file_.mass.form = fe::MassForm::kHrz;
      file_.mass.source.remark("lumping", "lumped: without this table consistent");
    }
    systems();
    add_materials(deck_, out_);
    couplings();
    if (deck_.mesh.node_sets.contains(kHangingMidSideNodes))
      file_.straight_edges.push_back(
          {Source("cells of the deck without these mid-side nodes"), kHangingMidSideNodes});
    for (const Tie& tie : deck_.ties) {
      file_.ties.push_back({Source(tie.where), tie.name, tie.slave, tie.master,
                            tie.distance >= 0.0 ? std::optional(tie.distance) : std::nullopt});
      file_.ties.back().edge = tie.edge;
    }
    for (const Bolt& bolt : deck_.bolts)
      file_.bolts.push_back({Source(bolt.where), names_.point(bolt.reference), bolt.slave,
                             bolt.master, std::nullopt, bolt.direction});
    for (const Equation& equation : deck_.equations)
      file_.equations.push_back({Source(equation.where), terms(equation.terms)});
    for (const Spring& spring : deck_.springs)
      file_.springs.push_back(
          {Source(spring.where), "", spring.stiffness, terms(spring.terms), spring.loss_factor});
    for (const Beam& beam : deck_.beams) {
      file_.beams.push_back(beam);
      file_.beams.back().points = {names_.reference(beam.ends[0]), names_.reference(beam.ends[1])};
    }
    for (const NodalMatrix& matrix : deck_.matrices) add_matrix(matrix);
    masses();
    retained();
    for (const Support& support : deck_.supports) add_support(support, names_, file_);
    add_steps(deck_, names_, out_);
    // Last, since the other tables need points on nodes.
    points();
    return std::move(out_);
  }

 private:
  void notes() {
    std::vector<std::string>& remarks = out_.remarks;
    remarks.push_back(fmt::format("Read from {}; SI units.",
                                  deck_.files.empty() ? "a deck" : deck_.files.front()));
    for (const auto& [card, count] : deck_.ignored)
      remarks.push_back(fmt::format("ignored in the deck: {} ({} times)", card, count));
    if (!deck_.passed.empty()) remarks.push_back(deck_.passed);
    for (const Repair& one : deck_.renumbered) remarks.push_back(one.text);
    remarks.insert(remarks.end(), deck_.notes.begin(), deck_.notes.end());
    // One model has one damping, a deck may have several: the user decides.
    std::vector<Damping> all = deck_.damping;
    for (const auto& [name, material] : deck_.materials)
      all.push_back({material.where, name, material.mass_damping, material.stiffness_damping});
    for (const Damping& one : all)
      if (one.mass != 0.0 || one.stiffness != 0.0)
        remarks.push_back(
            fmt::format("the deck's damping of {} ({}), not used unless these lines "
                        "are:\n# [damping]\n# alpha = {}\n# beta = {}",
                        one.of, one.where, one.stiffness, one.mass));
  }

  void systems() {
    for (const auto& [name, system] : deck_.systems) {
      fe::AxesTable& table = file_.systems[name];
      table.source = Source(system.where);
      table.axes.kind = static_cast<fe::Axes::Kind>(system.kind);
      table.axes.origin = system.origin;
      table.x = system.axes.col(0);
      table.z = system.axes.col(2);
    }
  }

  void points() {
    for (const Point& point : deck_.points)
      if (!point.of_bolt && !point.left_out)
        file_.points.push_back({.source = {},
                                .name = fmt::format("point_{}", point.id),
                                .node_set = {},
                                .at = point.at,
                                .number = point.id});
    for (const auto& [name, set] : names_.points_on_nodes())
      file_.points.push_back({.source = {}, .name = name, .node_set = set});
  }

  recipe::Members members(const std::vector<NodeIndex>& node_indices, const std::string& wish,
                          DofMask dofs = 0) {
    const NamedNodes named = names_.node_indices(node_indices, wish);
    return {.source = {},
            .selection = {.node_set = named.node_set},
            .points = named.points,
            .directions = directions_of(dofs)};
  }

  void couplings() {
    const auto add = [this](const auto& one, bool rigid) -> recipe::Coupling& {
      recipe::Coupling& coupling = file_.couplings.emplace_back();
      coupling.source = Source(one.where);
      coupling.name = one.name;
      coupling.rigid = rigid;
      coupling.on_point = names_.reference(one.reference);
      coupling.directions = directions_of(one.dofs);
      return coupling;
    };
    for (const Rigid& rigid : deck_.rigid)
      add(rigid, true).members = members(rigid.dependents, rigid.name);
    for (const Distributing& one : deck_.distributing) {
      recipe::Coupling& coupling = add(one, false);
      coupling.members.selection.surface = one.surface;
      for (const Distributing::Term& term : one.terms) {
        coupling.terms.push_back(members(term.node_indices, one.name, term.dofs));
        coupling.terms.back().weight = term.weight;
      }
    }
  }

  std::vector<recipe::Term> terms(const std::vector<Equation::Term>& all,
                                  bool with_coefficients = true) {
    std::vector<recipe::Term> terms;
    for (const Equation::Term& one : all) {
      recipe::Term& term = terms.emplace_back();
      term.direction = one.direction;
      if (with_coefficients) term.coefficient = one.coefficient;
      const bool has_direction = one.direction < 3 || names_.turns(one.node_index);
      if (names_.is_point(one.node_index) || !has_direction)
        term.selection.point = names_.reference(one.node_index);
      else
        term.selection.node_set = names_.node(one.node_index);
    }
    return terms;
  }

  /// True for a node that no [[nodes]] can keep along x y z: a rigid coupling or an equation moves
  /// it, or it is retained along other axes.
  bool is_dependent(NodeIndex index) {
    if (dependent_.empty()) {
      dependent_.resize(static_cast<size_t>(deck_.mesh.nodes.rows()) + deck_.points.size(), false);
      for (const Rigid& rigid : deck_.rigid)
        for (const NodeIndex one : rigid.dependents) dependent_[one] = true;
      for (const Support& retained : deck_.retained)
        for (const NodeIndex one : retained.node_indices)
          if (!retained.system.empty()) dependent_[one] = true;
      for (const Equation& equation : deck_.equations)
        if (!equation.terms.empty()) dependent_[equation.terms[0].node_index] = true;
    }
    return dependent_[index];
  }

  void add_matrix(const NodalMatrix& matrix) {
    recipe::Matrix& out = file_.matrices.emplace_back();
    out.source = Source(matrix.where);
    out.name = matrix.name;
    out.terms = terms(matrix.terms, false);
    out.loss_factor = matrix.loss_factor;
    for (Eigen::Index i = 0; i < matrix.values.rows(); ++i)
      for (Eigen::Index j = 0; j <= i; ++j)
        (matrix.is_mass ? out.M : out.K).push_back(matrix.values(i, j));
  }

  void masses() {
    for (const Mass& mass : deck_.masses) {
      const Eigen::Matrix3d& J = mass.inertia;
      if (mass.mass == 0.0 && J.isZero(0.0)) continue;
      const bool plain = J.isZero(0.0) && mass.offset.isZero(0.0);
      recipe::PointMass out{Source(mass.where), "", mass.mass, mass.offset, {}};
      if (names_.is_point(mass.node_index) || !plain || is_dependent(mass.node_index)) {
        out.on = names_.reference(mass.node_index);
      } else {
        const std::string set = names_.node(mass.node_index);
        out.on = "mass_" + set;
        recipe::Nodes& nodes = file_.nodes.emplace_back();
        nodes.name = out.on;
        nodes.members.selection.node_set = set;
      }
      if (!J.isZero(0.0)) out.inertia = {J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(1, 2), J(2, 0)};
      file_.point_masses.push_back(std::move(out));
    }
  }

  /// The set of all DoFs that a condensation retains.
  void retained() {
    if (deck_.retained.empty()) return;
    recipe::Nodes& kept = file_.nodes.emplace_back();
    kept.source.remark("", "boundary = [\"retained\"] of clatter-condense");
    kept.name = "retained";
    for (const Support& set : deck_.retained)
      for (const auto& [mask, some] : names_.by_directions(set.node_indices, set.dofs)) {
        kept.terms.push_back(members(some, "retained", mask));
        kept.terms.back().system = set.system;
      }
  }

  Deck& deck_;
  RecipeNames names_;
  Recipe out_;
  recipe::File& file_ = out_.file;
  std::vector<bool> dependent_;  // by node and point; empty until it is needed
};

}  // namespace

std::string Recipe::text() const {
  std::string text;
  for (const std::string& remark : remarks) text += fmt::format("# {}\n", remark);
  return text + recipe::file_keys().text_of(file);
}

Recipe recipe_of(Deck& deck) { return RecipeMaker(deck).make(); }

}  // namespace clatter::mesh::deck
