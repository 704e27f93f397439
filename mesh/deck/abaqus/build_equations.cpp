// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/deck/abaqus/build_equations.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Three fields per term, over several lines; the number of terms comes first.
class EquationLines {
 public:
  EquationLines(Model& model, size_t use, const Card& card)
      : model_(model), use_(use), card_(card) {}

  std::vector<RawEquation> run() {
    std::vector<RawEquation> equations;
    while (line_ < card_.size()) {
      const Fields head = card_.line(line_++, model_.source);
      head.at_most(1, "number of terms");
      const int32_t count = head.integer(0, "number of terms", 1, 1 << 24);
      add_each(head, read_terms(count, head.origin()), equations);
    }
    return equations;
  }

 private:
  struct SetTerm {
    std::vector<int32_t> rows;
    int direction;
    double coefficient;
  };

  // Sets of nodes stand for one equation for each node of the first: the others have as many, or
  // one node for all of them.
  void add_each(const Fields& head, const std::vector<SetTerm>& terms,
                std::vector<RawEquation>& equations) {
    const size_t count = terms.front().rows.size();
    for (const SetTerm& term : terms) {
      if (term.rows.size() != count && term.rows.size() != 1) {
        head.fail(
            fmt::format("found sets of {} and {} nodes, expected as many as in the first, or "
                        "one node",
                        count, term.rows.size()));
      }
    }
    entries_ += count * terms.size();
    if (entries_ > kMostTerms) head.fail("found too many terms in all equations");
    for (size_t i = 0; i < count; ++i) {
      RawEquation& equation = equations.emplace_back();
      equation.origin = head.origin();
      for (const SetTerm& term : terms) {
        equation.terms.push_back(
            {term.rows[term.rows.size() == 1 ? 0 : i], term.direction, term.coefficient});
      }
    }
  }

  std::vector<SetTerm> read_terms(int32_t count, Origin origin) {
    std::vector<SetTerm> terms;
    int32_t missing = count;
    while (missing > 0) {
      if (line_ == card_.size()) {
        model_.source.fail(origin,
                           fmt::format("found {} terms, expected {}", count - missing, count));
      }
      const Fields fields = card_.line(line_++, model_.source);
      if (fields.size() % 3 != 0 || fields.size() / 3 > static_cast<size_t>(missing)) {
        fields.fail(
            fmt::format("found {} fields, expected node, DoF, coefficient "
                        "of at most {} terms",
                        fields.size(), missing));
      }
      for (size_t i = 0; i < fields.size(); i += 3, --missing) {
        terms.push_back({model_.sets.nodes_in_order(fields, i, use_),
                         fields.integer(i + 1, "DoF", 1, 6) - 1,
                         fields.number(i + 2, "coefficient")});
        if (terms.back().rows.empty())
          fields.fail(fmt::format("found no node in {}", fields.text(i)));
      }
    }
    return terms;
  }

  static constexpr size_t kMostTerms = size_t{1} << 26;

  Model& model_;
  size_t use_;
  const Card& card_;
  size_t line_ = 0, entries_ = 0;
};

// Sums of coefficients by node index and direction, in the basic axes.
class BasicTerms {
 public:
  void add(NodeIndex node_index, int direction, double coefficient) {
    terms_[{node_index, direction}] += coefficient;
  }
  void add(const BasicTerms& other, double factor) {
    for (const auto& [dof, coefficient] : other.terms_) terms_[dof] += factor * coefficient;
  }
  void scale(double factor) {
    for (auto& [dof, coefficient] : terms_) coefficient *= factor;
  }
  double coefficient(NodeIndex node_index, int direction) const {
    const auto at = terms_.find({node_index, direction});
    return at != terms_.end() ? at->second : 0.0;
  }
  double largest() const {
    double most = 0.0;
    for (const auto& [dof, coefficient] : terms_) most = std::max(most, std::abs(coefficient));
    return most;
  }
  // That term first, without zero terms.
  Equation equation(NodeIndex node_index, int direction, const std::string& where) const {
    Equation out;
    out.where = where;
    out.terms.push_back({node_index, direction, coefficient(node_index, direction)});
    const double least = 1e-14 * largest();
    for (const auto& [dof, coefficient] : terms_) {
      if (dof == std::pair(node_index, direction) || std::abs(coefficient) <= least) continue;
      out.terms.push_back({dof.first, dof.second, coefficient});
    }
    return out;
  }

 private:
  std::map<std::pair<NodeIndex, int>, double> terms_;
};

BasicTerms basic_terms(Model& model, const RawEquation& equation) {
  BasicTerms out;
  NodeMap& node_map = model.node_map;
  for (const Term& term : equation.terms) {
    const NodeIndex rotated = node_map.rotation_of(term.row);
    const NodeIndex node_index = rotated == NodeMap::kNone ? node_map.require(term.row) : rotated;
    const int direction = rotated == NodeMap::kNone ? term.direction : term.direction + 3;
    if (direction > 5 || (direction > 2 && !node_map.turns(node_index))) {
      model.source.fail(equation.origin,
                        fmt::format("found rotation {} of node {}, which has no rotations",
                                    term.direction + 1, model.numbering.node_ids()[term.row]));
    }
    const std::string& system = node_map.displacement_system(term.row);
    if (system.empty()) {
      out.add(node_index, direction, term.coefficient);
      continue;
    }
    const Eigen::Matrix3d axes =
        axes_at(model.deck.systems.at(system), model.numbering.at(term.row));
    for (int k = 0; k < 3; ++k) {
      out.add(node_index, 3 * (direction / 3) + k, term.coefficient * axes(k, direction % 3));
    }
  }
  return out;
}

// Equations whose dependent node has transformed axes couple its directions: they are solved for as
// many basic directions as there are equations, so that each has its own dependent.
void solve_for_node(Model& model, const std::vector<RawEquation>& equations, NodeIndex node_index,
                    std::vector<BasicTerms> rows) {
  std::array<bool, 3> taken{};
  std::vector<int> pivots;
  for (size_t i = 0; i < rows.size(); ++i) {
    int pivot = -1;
    for (int k = 0; k < 3; ++k) {
      const double c = std::abs(rows[i].coefficient(node_index, k));
      if (!taken[k] && c > 1e-9 * rows[i].largest() &&
          (pivot < 0 || c > std::abs(rows[i].coefficient(node_index, pivot)))) {
        pivot = k;
      }
    }
    if (pivot < 0) {
      model.source.fail(equations[i].origin, "the equation repeats others of its first node");
    }
    taken[pivot] = true;
    pivots.push_back(pivot);
    rows[i].scale(1.0 / rows[i].coefficient(node_index, pivot));
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j].add(rows[i], -rows[j].coefficient(node_index, pivot));
    }
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    model.deck.equations.push_back(
        rows[i].equation(node_index, pivots[i], model.source.where(equations[i].origin)));
  }
}

void add_equations(Model& model, const std::vector<RawEquation>& equations) {
  std::map<NodeIndex, std::pair<std::vector<RawEquation>, std::vector<BasicTerms>>> turned;
  const auto add = [&](const RawEquation& equation) {
    const BasicTerms terms = basic_terms(model, equation);
    const Term& first = equation.terms.front();
    const NodeIndex rotated = model.node_map.rotation_of(first.row);
    const NodeIndex node_index =
        rotated == NodeMap::kNone ? model.node_map.require(first.row) : rotated;
    const int direction = rotated == NodeMap::kNone ? first.direction : first.direction + 3;
    const bool turned_node = !model.node_map.displacement_system(first.row).empty();
    if (first.coefficient == 0.0 ||
        (!turned_node && terms.coefficient(node_index, direction) == 0.0)) {
      model.source.fail(equation.origin, "the first coefficient is 0, expected another value");
    }
    if (!turned_node) {
      model.deck.equations.push_back(
          terms.equation(node_index, direction, model.source.where(equation.origin)));
    } else if (rotated != NodeMap::kNone || first.direction > 2) {
      model.source.fail(equation.origin,
                        "rotations in transformed axes cannot be the first term, expected "
                        "another order");
    } else {
      turned[node_index].first.push_back(equation);
      turned[node_index].second.push_back(terms);
    }
  };
  for (const RawEquation& equation : equations) {
    model.refusals.attempt([&] { add(equation); });
  }
  for (const auto& entry : turned) {
    const auto solve = [&model, node = entry.first, &group = entry.second] {
      solve_for_node(model, group.first, node, group.second);
    };
    model.refusals.attempt(solve);
  }
}

}  // namespace

void build_equations(Model& model) {
  std::vector<RawEquation> equations;
  for_each_card(model, {"EQUATION", "MPC"}, [&](size_t use, const Card& card) {
    card.keyword().allow({}, model.source, model.ignore);
    if (card.keyword().key == "EQUATION") {
      const auto more = EquationLines(model, use, card).run();
      equations.insert(equations.end(), more.begin(), more.end());
      return;
    }
    for (size_t i = 0; i < card.size();) {
      MpcLines lines;
      do {
        lines.push_back(card.line(i++, model.source));
      } while (i < card.size() && card.line(i, model.source).text(0) == "0");
      model.refusals.attempt([&] { add_mpc(model, use, lines, equations); });
    }
  });
  add_equations(model, equations);
}

}  // namespace clatter::mesh::deck::abaqus
