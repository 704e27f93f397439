// SPDX-License-Identifier: GPL-3.0-or-later
// CONN3D2 with *CONNECTOR SECTION: rigid components become a rigid coupling or equations, elastic
// ones springs, to first order about the positions in the deck.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <set>

#include "mesh/deck/abaqus/connector_behavior.hpp"
#include "mesh/deck/abaqus/connector_kinds.hpp"
#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Row12 = Eigen::Matrix<double, 1, 12>;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, 12, Eigen::RowMajor, 6, 12>;

bool has(DofMask mask, int k) { return (mask >> k & 1) != 0; }

/// *CONNECTOR SECTION.
struct Section {
  std::string types;
  ConnectorKind kind;
  std::array<std::string, 2> systems;  // of the first and of the second node; empty: basic
  ConnectorBehavior behavior;
};

class Connector {
 public:
  Connector(Model& model, const Section& section, const PointElement& element,
            const std::set<int32_t>& bound)
      : model_(model), section_(section), element_(element), rows_{element.node, element.second} {
    for (const int32_t row : rows_) {
      if (row < 0) continue;  // the ground
      ends_.push_back(model.node_map.require(row));
      turns_.push_back(model.node_map.turns(ends_.back()));
      bound_.push_back(bound.contains(row));
    }
    first_ = model.numbering.at(rows_[0]);
    arm_ = grounded() ? Vector3d::Zero() : Vector3d(model.numbering.at(rows_[1]) - first_);
  }

  void build() {
    const ConnectorKind& kind = section_.kind;
    const auto rigid = static_cast<DofMask>(kind.constrained | section_.behavior.rigid);
    const auto beyond = static_cast<DofMask>((section_.behavior.elastic | section_.behavior.rigid) &
                                             ~kind.components());
    if (beyond != 0)
      fail(fmt::format("its behavior has the component {}, which {} does not",
                       1 + std::countr_zero(beyond), section_.types));
    if (rows_[0] == rows_[1]) fail("found one node twice, expected two nodes");
    read_axes();
    if (rigid != 0 && grounded())
      fail("a rigid connection to the ground; *BOUNDARY of its node replaces it");
    if (rigid == kAllDofs) {
      join();
    } else {
      constrain(static_cast<DofMask>(rigid & kTranslations), 0);
      constrain(static_cast<DofMask>(rigid & ~kTranslations), 3);
    }
    add_springs(static_cast<DofMask>(kind.components() & ~rigid));
  }

 private:
  bool grounded() const { return rows_[1] < 0; }

  void read_axes() {
    const auto axes = [&](size_t end) {
      const std::string& name = section_.systems[end];
      return name.empty() ? Matrix3d(Matrix3d::Identity())
                          : axes_at(model_.deck.systems.at(name), first_);
    };
    axes_ = axes(0);
    if (section_.kind.along_line) {
      if (!(arm_.norm() > 0.0)) fail("its nodes lie at one position, expected a length");
      axes_.col(0) = arm_.normalized();
    }
    constexpr double kSame = 1e-6;  // of unit vectors: coordinates have few digits
    if (!section_.systems[1].empty() && !section_.kind.rotations_are_alike() &&
        !axes_.isApprox(axes(1), kSame))
      fail("its orientations differ at the two nodes, expected the same one");
  }

  /// A rigid link.
  void join() {
    if (arm_.isZero(0.0) && !(turns_[0] && turns_[1])) return constrain(kTranslations, 0);
    Rigid rigid;
    rigid.name = fmt::format("connector_{}", element_.id);
    rigid.where = where();
    size_t reference = dependent_end() == 0 ? 1 : 0;
    if (!turns_[reference] && turns_[1 - reference]) reference = 1 - reference;
    const int32_t row = rows_[reference];
    std::vector<int32_t> dependents = {rows_[1 - reference]};
    rigid.reference = ends_[reference];
    if (!turns_[reference]) {
      rigid.reference = model_.node_map.point_upon(row);
      dependents.push_back(row);
    }
    model_.dependents.emplace_back(model_.deck.rigid.size(), std::move(dependents));
    model_.deck.rigid.push_back(std::move(rigid));
  }

  /// The end whose motion follows the other's: not one that something else moves or holds.
  size_t dependent_end() const { return bound_[1] && !bound_[0] ? 0 : 1; }

  /// Component k of the relative motion, in the displacements and rotations of both nodes:
  ///   t . (u_b - u_a - theta x (x_b - x_a)) or t . (theta_b - theta_a),
  /// theta that of the first node, or the mean of both. Nodes of solids do not turn.
  Row12 motion(int k, const Vector3d& t) const {
    Row12 row = Row12::Zero();
    const int base = k < 3 ? 0 : 3;
    row.segment<3>(base) = -t.transpose();
    if (!grounded()) row.segment<3>(6 + base) = t.transpose();
    if (k >= 3 || section_.kind.along_line) return row;
    const Vector3d lever = t.cross(arm_);  // t . (theta x arm) = theta . (arm x t)
    const double share = section_.kind.mean_axes ? 0.5 : 1.0;
    row.segment<3>(3) = share * lever.transpose();
    row.segment<3>(9) = (1.0 - share) * lever.transpose();
    return row;
  }

  bool moves(int column) const { return column % 6 < 3 || turns_[column / 6]; }

  /// Whether the axes turn with a node of a solid would decide on the force.
  void require_rotations(const Row12& row) const {
    for (size_t end = 0; end < ends_.size(); ++end)
      if (!turns_[end] && !row.segment<3>(static_cast<Eigen::Index>(6 * end) + 3).isZero(0.0))
        fail(
            fmt::format("node {} belongs to a solid and has no rotations: expected the reference "
                        "node of a coupling, or both nodes at one position",
                        model_.numbering.node_ids()[rows_[end]]));
  }

  /// Those components of three are 0. Where all are, the basic axes serve.
  void constrain(DofMask mask, int base) {
    if (mask == 0) return;
    const size_t end = dependent_end();
    if (base == 3 && !(turns_[0] && turns_[1])) return;  // a node that turns freely
    const bool all = (mask >> base & 7) == 7;
    Rows rows(0, 12);
    for (int k = base; k < base + 3; ++k) {
      if (!has(mask, k)) continue;
      rows.conservativeResize(rows.rows() + 1, 12);
      rows.row(rows.rows() - 1) =
          motion(k, all ? Vector3d(Vector3d::Unit(k - base)) : Vector3d(axes_.col(k - base)));
    }
    for (const auto& row : rows.rowwise()) require_rotations(row);
    solve_for(static_cast<int>(6 * end) + base, rows);
  }

  /// Equations, each with a displacement (three columns from `first`) of its own.
  void solve_for(int first, Rows rows) {
    std::vector<int> pivots;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      Eigen::Index pivot = 0;
      rows.row(i).segment<3>(first).cwiseAbs().maxCoeff(&pivot);
      pivots.push_back(static_cast<int>(pivot));
      const Row12 solved = rows.row(i) / rows(i, first + pivot);
      rows.row(i) = solved;
      for (Eigen::Index j = 0; j < rows.rows(); ++j)
        if (j != i) rows.row(j) -= rows(j, first + pivot) * solved;
    }
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      std::vector<Equation::Term> terms = terms_of(rows.row(i));
      const auto own = std::find_if(terms.begin(), terms.end(), [&](const Equation::Term& term) {
        return term.node_index == ends_[first / 6] && term.direction == first % 6 + pivots[i];
      });
      if (own == terms.end()) fail("its nodes are too far from each other");
      std::iter_swap(terms.begin(), own);
      model_.deck.equations.push_back({where(), std::move(terms)});
    }
  }

  /// Displacements before rotations.
  std::vector<Equation::Term> terms_of(const Row12& row) const {
    if (!row.allFinite()) fail("its numbers are too large");
    std::vector<Equation::Term> terms;
    const double least = 1e-14 * row.cwiseAbs().maxCoeff();
    for (const int base : {0, 3})
      for (size_t end = 0; end < ends_.size(); ++end)
        for (int k = base; k < base + 3; ++k) {
          const int column = static_cast<int>(6 * end) + k;
          if (moves(column) && std::abs(row(column)) > least)
            terms.push_back({ends_[end], k, row(column)});
        }
    return terms;
  }

  void add_springs(DofMask free) {
    const ConnectorBehavior& behavior = section_.behavior;
    if (behavior.coupled) return add_coupled(free);
    bool left_out = false;
    for (int k = 0; k < 6; ++k) {
      const double stiffness = behavior.stiffness(k, k);
      if (!has(free, k) || !(stiffness > 0.0)) continue;
      if (k >= 3 && std::ranges::count(turns_, false) > 0) {
        left_out = true;
        continue;
      }
      const Row12 row = motion(k, axes_.col(k % 3));
      require_rotations(row);
      model_.deck.springs.push_back({where(), stiffness, terms_of(row)});
    }
    if (left_out)
      model_.deck.notes.push_back(fmt::format(
          "{}: element {}: its rotational stiffness is left out: nodes of solids turn freely",
          where(), element_.id));
  }

  /// A coupled stiffness is the sum of springs along its eigenvectors.
  void add_coupled(DofMask free) {
    if (std::ranges::count(turns_, false) > 0)
      fail(
          "a coupled stiffness on a node of a solid, which has no rotations: expected the "
          "reference node of a coupling");
    Matrix6 D = section_.behavior.stiffness;
    for (int k = 0; k < 6; ++k)
      if (!has(free, k)) D.row(k).setZero(), D.col(k).setZero();
    const Eigen::SelfAdjointEigenSolver<Matrix6> solved(D);
    if (!solved.eigenvalues().allFinite()) fail("its numbers are too large");
    const double most = solved.eigenvalues().cwiseAbs().maxCoeff();
    for (int i = 0; i < 6; ++i) {
      const double stiffness = solved.eigenvalues()(i);
      if (stiffness < -1e-9 * most)
        fail("its coupled stiffness has a negative eigenvalue, expected none");
      if (stiffness <= 1e-12 * most) continue;
      Row12 row = Row12::Zero();
      for (int k = 0; k < 6; ++k) row += solved.eigenvectors()(k, i) * motion(k, axes_.col(k % 3));
      model_.deck.springs.push_back({where(), stiffness, terms_of(row)});
    }
  }

  std::string where() const { return model_.source.where(element_.origin); }

  [[noreturn]] void fail(const std::string& message) const {
    model_.source.fail(element_.origin,
                       fmt::format("element {} ({}): {}", element_.id, section_.types, message));
  }

  Model& model_;
  const Section& section_;
  const PointElement& element_;
  std::array<int32_t, 2> rows_;
  std::vector<NodeIndex> ends_;
  std::vector<bool> turns_, bound_;  // by end: has rotations; something else moves or holds it
  Vector3d first_, arm_;
  Matrix3d axes_;
};

Section section_of(const Model& model, size_t use, const Card& card,
                   const std::map<std::string, ConnectorBehavior>& behaviors) {
  const Keyword& keyword = card.keyword();
  keyword.allow({"ELSET", "BEHAVIOR"}, model.source, model.ignore);
  if (card.size() < 1 || card.size() > 2)
    model.source.fail(card.origin(),
                      "*CONNECTOR SECTION: expected one or two data lines: types, orientations");
  Section section;
  const Fields types = card.line(0, model.source);
  types.at_most(2, "one or two types of connection");
  section.kind = connector_kind(types);
  section.types = fmt::format("{}{}{}", types.text(0), types.size() > 1 ? ", " : "", types.text(1));
  if (card.size() == 2) {
    const Fields names = card.line(1, model.source);
    names.at_most(2, "an orientation at each node");
    for (size_t end = 0; end < 2; ++end)
      if (!names.blank(end))
        section.systems[end] =
            system_named(model, use, std::string(names.text(end)), names.origin());
  }
  const std::string* name = keyword.find("BEHAVIOR");
  if (name == nullptr) return section;
  const auto behavior = behaviors.find(folded(*name));
  if (behavior == behaviors.end()) {
    if (model.refusals.has_lost(folded(*name))) throw FollowUp();
    model.source.fail(card.origin(), fmt::format("found no *CONNECTOR BEHAVIOR {}", shown(*name)));
  }
  section.behavior = behavior->second;
  return section;
}

/// Rows of nodes that a rigid body, a distributing coupling or a support moves or holds.
std::set<int32_t> bound_rows(Model& model) {
  std::set<int32_t> bound;
  std::set<NodeIndex> references;
  for (const Distributing& one : model.deck.distributing) references.insert(one.reference);
  for (int32_t row = 0; !references.empty() && row < model.numbering.nodes(); ++row)
    if (references.contains(model.node_map.find(row))) bound.insert(row);
  for (const auto& [body, rows] : model.dependents) bound.insert(rows.begin(), rows.end());
  for (size_t use = 0; use < model.numbering.uses().size(); ++use)
    for (const Card& card : model.numbering.uses()[use].scope->cards) {
      if (card.keyword().key != "BOUNDARY") continue;
      for (size_t i = 0; i < card.size(); ++i) {
        std::vector<int32_t> rows;
        try {
          rows = model.sets.nodes_at(card.line(i, model.source), 0, use);
        } catch (const InputError&) {
          continue;  // build_steps() says it
        }
        bound.insert(rows.begin(), rows.end());
      }
    }
  return bound;
}

}  // namespace

void build_connectors(Model& model) {
  const auto& all = model.numbering.points();
  const auto is_connector = [](const PointElement& one) { return one.type == kConnector; };
  if (std::none_of(all.begin(), all.end(), is_connector)) return;
  const size_t refused = model.refusals.size();
  const std::map<std::string, ConnectorBehavior> behaviors = connector_behaviors(model);
  const std::set<int32_t> bound = bound_rows(model);
  std::set<Origin> described;
  for_each_card(model, {"CONNECTORSECTION"}, [&](size_t use, const Card& card) {
    const Section section = section_of(model, use, card, behaviors);
    for (const PointElement& element : point_elements(model, use, card, kConnector)) {
      if (!described.insert(element.origin).second)
        model.source.fail(card.origin(), fmt::format("{}: element {} has a section already",
                                                     card.keyword().name, element.id));
      model.refusals.attempt([&] { Connector(model, section, element, bound).build(); });
    }
  });
  if (model.refusals.size() > refused) return;
  for (const PointElement& element : all)
    if (is_connector(element) && !described.contains(element.origin))
      model.refusals.add(fmt::format("{}: element {} of type {} has no *CONNECTOR SECTION",
                                     model.source.where(element.origin), element.id, kConnector));
}

}  // namespace clatter::mesh::deck::abaqus
