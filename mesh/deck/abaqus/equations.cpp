#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/deck/abaqus/equations.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// Three fields a term, over as many lines as the count at the head says.
class EquationLines {
 public:
  EquationLines(Reading* reading, size_t use, const Card& card)
      : reading_(*reading), use_(use), card_(card) {}

  std::vector<RawEquation> run() {
    std::vector<RawEquation> equations;
    while (line_ < card_.size()) {
      const Fields head = card_.line(line_++, reading_.source);
      head.at_most(1, "number of terms");
      const int32_t count = head.integer(0, "number of terms", 1, 1 << 24);
      equations.emplace_back();
      equations.back().spot = head.spot();
      read_terms(count, &equations.back());
    }
    return equations;
  }

 private:
  void read_terms(int32_t count, RawEquation* equation) {
    int32_t missing = count;
    while (missing > 0) {
      if (line_ == card_.size()) {
        reading_.source.fail(equation->spot,
                             fmt::format("found {} terms, expected {}", count - missing, count));
      }
      const Fields fields = card_.line(line_++, reading_.source);
      if (fields.size() % 3 != 0 || fields.size() / 3 > static_cast<size_t>(missing)) {
        fields.fail(
            fmt::format("found {} fields, expected node, degree of freedom, coefficient "
                        "of at most {} terms",
                        fields.size(), missing));
      }
      for (size_t i = 0; i < fields.size(); i += 3, --missing) {
        equation->terms.push_back({reading_.sets->node_at(fields, i, use_),
                                   fields.integer(i + 1, "degree of freedom", 1, 6) - 1,
                                   fields.number(i + 2, "coefficient")});
      }
    }
  }

  Reading& reading_;
  size_t use_;
  const Card& card_;
  size_t line_ = 0;
};

// Sums of coefficients by place and direction, in the basic axes.
class BasicTerms {
 public:
  void add(Place place, int direction, double coefficient) {
    terms_[{place, direction}] += coefficient;
  }
  void add(const BasicTerms& other, double factor) {
    for (const auto& [dof, coefficient] : other.terms_) terms_[dof] += factor * coefficient;
  }
  void scale(double factor) {
    for (auto& [dof, coefficient] : terms_) coefficient *= factor;
  }
  double coefficient(Place place, int direction) const {
    const auto at = terms_.find({place, direction});
    return at != terms_.end() ? at->second : 0.0;
  }
  double largest() const {
    double most = 0.0;
    for (const auto& [dof, coefficient] : terms_) most = std::max(most, std::abs(coefficient));
    return most;
  }
  // That term first, terms without weight gone.
  Equation equation(Place place, int direction, const std::string& where) const {
    Equation out;
    out.where = where;
    out.terms.push_back({place, direction, coefficient(place, direction)});
    const double least = 1e-14 * largest();
    for (const auto& [dof, coefficient] : terms_) {
      if (dof == std::pair(place, direction) || std::abs(coefficient) <= least) continue;
      out.terms.push_back({dof.first, dof.second, coefficient});
    }
    return out;
  }

 private:
  std::map<std::pair<Place, int>, double> terms_;
};

BasicTerms basic_terms(Reading* reading, const RawEquation& equation) {
  BasicTerms out;
  Places& places = *reading->places;
  for (const Term& term : equation.terms) {
    const Place rotated = places.rotation_of(term.row);
    const Place place = rotated == Places::kNone ? places.of(term.row) : rotated;
    const int direction = rotated == Places::kNone ? term.direction : term.direction + 3;
    if (direction > 5 || (direction > 2 && !places.is_point(place))) {
      reading->source.fail(
          equation.spot,
          fmt::format("found rotation {} of node {}, which has no rotations", term.direction + 1,
                      reading->model->node_ids()[static_cast<size_t>(term.row)]));
    }
    const std::string& system = places.system(term.row);
    if (system.empty()) {
      out.add(place, direction, term.coefficient);
      continue;
    }
    const Eigen::Matrix3d axes =
        axes_at(reading->deck->systems.at(system), reading->model->at(term.row));
    for (int k = 0; k < 3; ++k) {
      out.add(place, 3 * (direction / 3) + k, term.coefficient * axes(k, direction % 3));
    }
  }
  return out;
}

// Equations whose dependent node has axes of its own mix its directions: they are solved for as
// many basic directions as there are equations, so that each has a dependent of its own.
void solve_for_node(Reading* reading, const std::vector<RawEquation>& equations, Place place,
                    std::vector<BasicTerms> rows) {
  std::array<bool, 3> taken{};
  std::vector<int> pivots;
  for (size_t i = 0; i < rows.size(); ++i) {
    int pivot = -1;
    for (int k = 0; k < 3; ++k) {
      const double c = std::abs(rows[i].coefficient(place, k));
      if (!taken[static_cast<size_t>(k)] && c > 1e-9 * rows[i].largest() &&
          (pivot < 0 || c > std::abs(rows[i].coefficient(place, pivot)))) {
        pivot = k;
      }
    }
    if (pivot < 0) {
      reading->source.fail(equations[i].spot, "the equation repeats others of its first node");
    }
    taken[static_cast<size_t>(pivot)] = true;
    pivots.push_back(pivot);
    rows[i].scale(1.0 / rows[i].coefficient(place, pivot));
    for (size_t j = 0; j < rows.size(); ++j) {
      if (j != i) rows[j].add(rows[i], -rows[j].coefficient(place, pivot));
    }
  }
  for (size_t i = 0; i < rows.size(); ++i) {
    reading->deck->equations.push_back(
        rows[i].equation(place, pivots[i], reading->source.where(equations[i].spot)));
  }
}

void add_equations(Reading* reading, const std::vector<RawEquation>& equations) {
  std::map<Place, std::pair<std::vector<RawEquation>, std::vector<BasicTerms>>> turned;
  const auto add = [&](const RawEquation& equation) {
    const BasicTerms terms = basic_terms(reading, equation);
    const Term& first = equation.terms.front();
    const Place rotated = reading->places->rotation_of(first.row);
    const Place place = rotated == Places::kNone ? reading->places->of(first.row) : rotated;
    const int direction = rotated == Places::kNone ? first.direction : first.direction + 3;
    const bool turned_node = !reading->places->system(first.row).empty();
    if (first.coefficient == 0.0 || (!turned_node && terms.coefficient(place, direction) == 0.0)) {
      reading->source.fail(equation.spot, "the first coefficient is 0, expected another value");
    }
    if (!turned_node) {
      reading->deck->equations.push_back(
          terms.equation(place, direction, reading->source.where(equation.spot)));
    } else if (rotated != Places::kNone || first.direction > 2) {
      reading->source.fail(equation.spot,
                           "rotations in transformed axes cannot be the first term, expected "
                           "another order");
    } else {
      turned[place].first.push_back(equation);
      turned[place].second.push_back(terms);
    }
  };
  for (const RawEquation& equation : equations) {
    reading->refusals->attempt([&] { add(equation); });
  }
  for (const auto& [place, group] : turned) {
    reading->refusals->attempt([&] { solve_for_node(reading, group.first, place, group.second); });
  }
}

}  // namespace

void read_equations(Reading* reading) {
  std::vector<RawEquation> equations;
  for_each_card(*reading, {"EQUATION", "MPC"}, [&](size_t use, const Card& card) {
    card.keyword().allow({}, reading->source, reading->ignore);
    if (card.keyword().key == "EQUATION") {
      const auto more = EquationLines(reading, use, card).run();
      equations.insert(equations.end(), more.begin(), more.end());
      return;
    }
    for (size_t i = 0; i < card.size();) {
      MpcLines lines;
      do {
        lines.push_back(card.line(i++, reading->source));
      } while (i < card.size() && card.line(i, reading->source).text(0) == "0");
      reading->refusals->attempt([&] { add_mpc(reading, use, lines, &equations); });
    }
  });
  add_equations(reading, equations);
}

}  // namespace clatter::mesh::deck::abaqus
