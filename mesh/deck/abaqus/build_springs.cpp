// SPDX-License-Identifier: GPL-3.0-or-later
// *SPRING and *DASHPOT.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "mesh/deck/abaqus/model.hpp"
#include "mesh/deck/system_axes.hpp"

namespace clatter::mesh::deck::abaqus {
namespace {

constexpr double kStraight = 1e-9;  // of the largest force: precision of a table

// Lines "force, elongation"; a straight line through the origin is a linear spring.
double slope_of(const Card& card, size_t first, const Source& source) {
  double force = 0.0, elongation = 0.0;
  std::vector<std::pair<double, double>> points;
  for (size_t i = first; i < card.size(); ++i) {
    const Fields fields = card.line(i, source);
    fields.at_most(2, "force, elongation (at one temperature)");
    points.emplace_back(fields.number(0, "force"), fields.number(1, "elongation"));
    if (std::abs(points.back().second) > std::abs(elongation)) {
      force = points.back().first;
      elongation = points.back().second;
    }
  }
  const double slope = elongation != 0.0 ? force / elongation : 0.0;
  const bool straight = std::all_of(points.begin(), points.end(), [&](const auto& point) {
    return std::abs(point.first - slope * point.second) <= kStraight * std::abs(force);
  });
  if (!straight || elongation == 0.0) {
    source.fail(card.origin(),
                fmt::format("{}, NONLINEAR: its forces are not on one line through 0, expected a "
                            "linear spring: clatter's parts are linear",
                            card.keyword().name));
  }
  return slope;
}

struct Property {
  std::vector<int> directions;  // of SPRING1 and SPRING2
  double stiffness = 0.0;
};

// SPRING1 and SPRING2 begin with their directions, SPRINGA with an empty line.
Property property_of(const Card& card, const std::string& type, const Source& source) {
  Property property;
  size_t first = 0;
  if (type != "SPRINGA") {
    if (card.size() == 0) source.fail(card.origin(), "*SPRING: found no data lines");
    const Fields fields = card.line(0, source);
    const size_t ends = type == "SPRING1" ? 1 : 2;
    fields.at_most(ends, "DoF of each end");
    for (size_t i = 0; i < ends; ++i) {
      property.directions.push_back(fields.integer(i, "DoF", 1, 6) - 1);
    }
    first = 1;
  } else if (card.size() > 0 && card.line(0, source).blank(0)) {
    first = 1;
  }
  property.stiffness = stiffness_of(card, first, source);
  return property;
}

}  // namespace

double stiffness_of(const Card& card, size_t first, const Source& source) {
  double stiffness = 0.0;
  if (card.keyword().has("NONLINEAR")) {
    stiffness = slope_of(card, first, source);
  } else {
    if (card.size() != first + 1) {
      source.fail(card.origin(),
                  fmt::format("{}: found {} lines of stiffness, expected one", card.keyword().name,
                              card.size() - std::min(card.size(), first)));
    }
    stiffness = card.line(first, source).number(0, "stiffness");
  }
  if (!(stiffness > 0.0)) {
    source.fail(card.origin(), fmt::format("{}: found a stiffness of {}, expected more than 0",
                                           card.keyword().name, stiffness));
  }
  return stiffness;
}

namespace {

// DoF `direction` of a node, which CalculiX may store as a translation of a rotation node.
Equation::Term end_of(Model& model, const PointElement& element, int32_t row, int direction,
                      double coefficient) {
  NodeMap& node_map = model.node_map;
  const NodeIndex rotated = node_map.rotation_of(row);
  const NodeIndex node_index = rotated == NodeMap::kNone ? node_map.require(row) : rotated;
  if (rotated != NodeMap::kNone) direction += 3;
  const int32_t id = model.numbering.node_ids()[row];
  if (direction > 5 || (direction > 2 && !node_map.turns(node_index))) {
    model.source.fail(element.origin,
                      fmt::format("element {}: node {} has no rotations", element.id, id));
  }
  return {node_index, direction, coefficient};
}

// The axes of the DoFs of SPRING1 and SPRING2 at a node: of the section's ORIENTATION, or none.
std::optional<Eigen::Matrix3d> axes_of(const Model& model, size_t use, const Card& card,
                                       int32_t row) {
  const std::string* orientation = card.keyword().find("ORIENTATION");
  if (orientation == nullptr) return std::nullopt;
  const std::string name = system_named(model, use, *orientation, card.origin());
  return axes_at(model.deck.systems.at(name), model.numbering.at(row));
}

// Both ends of a SPRING1 or SPRING2, the second one with the other sign.
void add_ends(Model& model, const PointElement& element, size_t use, const Card& card,
              const std::vector<int>& directions, Spring& spring) {
  const int32_t ends[] = {element.node, element.second};
  for (size_t i = 0; i < directions.size(); ++i) {
    const auto add = [&](int direction, double coefficient) {
      spring.terms.push_back(
          end_of(model, element, ends[i], direction, i == 0 ? coefficient : -coefficient));
    };
    const auto axes = axes_of(model, use, card, ends[i]);
    if (!axes && !model.node_map.displacement_system(ends[i]).empty())
      model.source.fail(element.origin,
                        fmt::format("element {}: a {} without ORIENTATION on a node with "
                                    "*TRANSFORM is not supported, expected an ORIENTATION",
                                    element.id, element.type));
    if (!axes) {
      add(directions[i], 1.0);
      continue;
    }
    for (int k = 0; k < 3; ++k)
      if (const double along = (*axes)(k, directions[i] % 3); along != 0.0)
        add(directions[i] / 3 * 3 + k, along);
  }
  const bool turns = spring.terms.front().direction >= 3;
  if (turns != (spring.terms.back().direction >= 3))
    model.source.fail(card.origin(),
                      "*SPRING: found a rotation against a displacement, expected one kind");
}

void add_spring(Model& model, const PointElement& element, size_t use, const Card& card) {
  const Property property = property_of(card, element.type, model.source);
  Spring spring;
  spring.where = model.source.where(element.origin);
  spring.stiffness = property.stiffness;
  if (element.type == "SPRINGA") {
    const Eigen::Vector3d line =
        model.numbering.at(element.second) - model.numbering.at(element.node);
    if (!(line.norm() > 0.0)) {
      model.source.fail(element.origin, fmt::format("element {}: both ends have the same position, "
                                                    "expected a SPRINGA with a length",
                                                    element.id));
    }
    for (int k = 0; k < 3; ++k) {
      const double along = line[k] / line.norm();
      if (along == 0.0) continue;
      spring.terms.push_back(end_of(model, element, element.second, k, along));
      spring.terms.push_back(end_of(model, element, element.node, k, -along));
    }
  } else {
    add_ends(model, element, use, card, property.directions, spring);
  }
  model.deck.springs.push_back(std::move(spring));
}

}  // namespace

void build_springs(Model& model) {
  std::set<Origin> described;
  const size_t refused = model.refusals.size();
  bool noted = false;
  for_each_card(model, {"SPRING", "DASHPOT"}, [&](size_t use, const Card& card) {
    const bool spring = card.keyword().key == "SPRING";
    card.keyword().allow({"ELSET", "NONLINEAR", "ORIENTATION"}, model.source, model.ignore);
    for (const PointElement& element : point_elements(model, use, card, card.keyword().key)) {
      if (!described.insert(element.origin).second) {
        model.source.fail(card.origin(), fmt::format("{}: element {} has a value already",
                                                     card.keyword().name, element.id));
      }
      if (spring) model.refusals.attempt([&] { add_spring(model, element, use, card); });
    }
    if (spring || noted) return;
    noted = true;
    model.deck.notes.push_back(fmt::format(
        "{}: *DASHPOT is left out: dampers have no effect in statics and on undamped frequencies",
        model.source.where(card.origin())));
  });
  if (model.refusals.size() > refused) return;
  for (const PointElement& element : model.numbering.points()) {
    const bool spring = element.type.starts_with("SPRING");
    if (!spring && !element.type.starts_with("DASHPOT")) continue;
    if (!described.contains(element.origin)) {
      model.refusals.add(fmt::format("{}: element {} of type {} has no value (*{})",
                                     model.source.where(element.origin), element.id, element.type,
                                     spring ? "SPRING" : "DASHPOT"));
    }
  }
}

}  // namespace clatter::mesh::deck::abaqus
