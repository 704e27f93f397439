#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/deck/abaqus_reading.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

// A term as the deck has it: in the directions of the node.
struct Term {
  int32_t row = 0;
  int direction = 0;  // 0 to 5
  double coefficient = 0.0;
};

struct RawEquation {
  Spot spot = 0;
  std::vector<Term> terms;
};

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

// A line of *MPC and those that continue it: they begin with 0.
using MpcLines = std::vector<Fields>;

// Rows of the nodes that a *MPC names behind its type; zeros count for nothing.
std::vector<int32_t> mpc_rows(Reading* reading, size_t use, const MpcLines& lines) {
  std::vector<int32_t> rows;
  std::vector<bool> known(static_cast<size_t>(reading->model->nodes()), false);
  for (const Fields& fields : lines) {
    for (size_t i = 1; i < fields.size(); ++i) {
      if (fields.empty(i) || fields.text(i) == "0") continue;
      for (const int32_t row : reading->sets->nodes_at(fields, i, use)) {
        if (!known[static_cast<size_t>(row)]) rows.push_back(row);
        known[static_cast<size_t>(row)] = true;
      }
    }
  }
  const Fields& fields = lines.front();
  for (const int32_t row : rows) {
    if (!reading->places->system(row).empty()) {
      fields.fail(fmt::format("*MPC {}: node {} has *TRANSFORM, which is not supported here",
                              fields.text(0),
                              reading->model->node_ids()[static_cast<size_t>(row)]));
    }
  }
  return rows;
}

// weights . (u_row - sum share u_of) = 0, its largest weight first.
RawEquation follow(Spot spot, int32_t row, const Eigen::Vector3d& weights,
                   const std::vector<std::pair<int32_t, double>>& shares) {
  RawEquation out{spot, {}};
  Eigen::Index first = 0;
  weights.cwiseAbs().maxCoeff(&first);
  for (int i = 0; i < 3; ++i) {
    const int k = static_cast<int>((first + i) % 3);
    if (weights[k] == 0.0) continue;
    out.terms.push_back({row, k, weights[k]});
    for (const auto& [of, share] : shares) out.terms.push_back({of, k, -share * weights[k]});
  }
  return out;
}

constexpr double kInLine =
    1e-6;  // sine of an angle, or distance over length: coordinates are short

// PLANE: the nodes stay in the plane that the first three span. To first order in u, with
// x_p = (1 - s - t) x_a + s x_b + t x_c and the normal n: n . (u_p - (1 - s - t) u_a - s u_b - t
// u_c) = 0.
void add_plane(Reading* reading, size_t use, const MpcLines& lines,
               std::vector<RawEquation>* equations) {
  const Fields& fields = lines.front();
  const std::vector<int32_t> rows = mpc_rows(reading, use, lines);
  if (rows.size() < 4) {
    fields.fail(fmt::format("*MPC PLANE: found {} nodes, expected 4 or more", rows.size()));
  }
  const auto at = [&](size_t i) { return reading->model->at(rows[i]); };
  // Of a set, three that span the plane well: the first, the farthest, the farthest from both.
  size_t b = 1, c = 0;
  for (size_t i = 2; i < rows.size(); ++i) {
    if ((at(i) - at(0)).norm() > (at(b) - at(0)).norm()) b = i;
  }
  const Eigen::Vector3d e = at(b) - at(0);
  for (size_t i = 1; i < rows.size(); ++i) {
    if (e.cross(at(i) - at(0)).norm() > e.cross(at(c) - at(0)).norm()) c = i;
  }
  const Eigen::Vector3d g = at(c) - at(0), normal = e.cross(g);
  if (!(normal.norm() > kInLine * e.squaredNorm())) {
    fields.fail("*MPC PLANE: its nodes lie on a line, expected a plane");
  }
  const Eigen::Vector3d n = normal.normalized();
  for (size_t i = 1; i < rows.size(); ++i) {
    if (i == b || i == c) continue;
    const Eigen::Vector3d r = at(i) - at(0);
    if (std::abs(n.dot(r)) > kInLine * e.norm()) {
      fields.fail(fmt::format("*MPC PLANE: node {} is not in the plane of the others",
                              reading->model->node_ids()[static_cast<size_t>(rows[i])]));
    }
    const double s = r.cross(g).dot(n) / normal.norm(), t = e.cross(r).dot(n) / normal.norm();
    equations->push_back(
        follow(fields.spot(), rows[i], n, {{rows[0], 1.0 - s - t}, {rows[b], s}, {rows[c], t}}));
  }
}

// STRAIGHT: the nodes stay on the line through the ends. With x_p = (1 - s) x_a + s x_b, what is
// square to the line is u_p = (1 - s) u_a + s u_b: two equations.
void add_straight(Reading* reading, size_t use, const MpcLines& lines,
                  std::vector<RawEquation>* equations) {
  const Fields& fields = lines.front();
  const std::vector<int32_t> rows = mpc_rows(reading, use, lines);
  if (rows.size() < 3) {
    fields.fail(fmt::format("*MPC STRAIGHT: found {} nodes, expected 3 or more", rows.size()));
  }
  const auto at = [&](size_t i) { return reading->model->at(rows[i]); };
  size_t b = 1;
  for (size_t i = 2; i < rows.size(); ++i) {
    if ((at(i) - at(0)).norm() > (at(b) - at(0)).norm()) b = i;
  }
  const Eigen::Vector3d e = at(b) - at(0);
  if (!(e.norm() > 0.0)) fields.fail("*MPC STRAIGHT: its nodes are in one place");
  Eigen::Index along = 0;
  e.cwiseAbs().maxCoeff(&along);
  for (size_t i = 1; i < rows.size(); ++i) {
    if (i == b) continue;
    const Eigen::Vector3d r = at(i) - at(0);
    const double s = r.dot(e) / e.squaredNorm();
    if ((r - s * e).norm() > kInLine * e.norm()) {
      fields.fail(fmt::format("*MPC STRAIGHT: node {} is not on the line of the others",
                              reading->model->node_ids()[static_cast<size_t>(rows[i])]));
    }
    for (int k = 0; k < 3; ++k) {
      if (k == along) continue;
      Eigen::Vector3d square = Eigen::Vector3d::Unit(k);
      square[along] = -e[k] / e[along];
      RawEquation equation =
          follow(fields.spot(), rows[i], square, {{rows[0], 1.0 - s}, {rows[b], s}});
      // Direction k is the dependent: the other equation has the other one.
      const auto own =
          std::find_if(equation.terms.begin(), equation.terms.end(),
                       [&](const Term& t) { return t.row == rows[i] && t.direction == k; });
      std::iter_swap(equation.terms.begin(), own);
      equations->push_back(std::move(equation));
    }
  }
}

// PIN and TIE: equal translations. BEAM: a rigid rod from the first to the second node.
void add_mpc(Reading* reading, size_t use, const MpcLines& lines,
             std::vector<RawEquation>* equations) {
  const Fields& fields = lines.front();
  const std::string type = folded(fields.text(0));
  if (type == "PLANE") return add_plane(reading, use, lines, equations);
  if (type == "STRAIGHT") return add_straight(reading, use, lines, equations);
  if (type != "PIN" && type != "TIE" && type != "BEAM") {
    fields.fail(
        fmt::format("*MPC of type {} is not supported, expected PIN, TIE, BEAM, PLANE or "
                    "STRAIGHT",
                    type));
  }
  fields.at_most(3, "type and two nodes");
  if (lines.size() > 1) lines[1].fail(fmt::format("expected one line of *MPC {}", type));
  const int32_t a = reading->sets->node_at(fields, 1, use);
  const int32_t b = reading->sets->node_at(fields, 2, use);
  Places& places = *reading->places;
  if (type == "BEAM") {
    Rigid rigid;
    rigid.name = fmt::format("beam_{}", reading->deck->rigid.size() + 1);
    rigid.where = reading->source.where(fields.spot());
    const bool in_mesh = places.mesh_node(b) != Places::kNone;
    rigid.reference = in_mesh ? places.point_upon(b) : places.of(b);
    places.of(a);
    std::vector<int32_t> rows = {a};
    if (in_mesh) rows.push_back(b);
    reading->dependents.emplace_back(reading->deck->rigid.size(), std::move(rows));
    reading->deck->rigid.push_back(std::move(rigid));
    return;
  }
  const bool rotations = places.is_point(places.of(a)) && places.is_point(places.of(b));
  for (int k = 0; k < (type == "TIE" && rotations ? 6 : 3); ++k) {
    equations->push_back({fields.spot(), {{a, k, 1.0}, {b, k, -1.0}}});
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
