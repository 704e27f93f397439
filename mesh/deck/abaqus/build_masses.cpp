// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "mesh/deck/abaqus/model.hpp"

namespace clatter::mesh::deck::abaqus {

std::vector<PointElement> point_elements(Model& model, size_t use, const Card& card,
                                         std::string_view type) {
  const std::string& set = card.keyword().required("ELSET", model.source);
  std::vector<PointElement> out;
  for (const int32_t element : model.sets.elements(use, set, card.origin())) {
    const PointElement* point = model.numbering.point(element);
    if (point == nullptr || !point->type.starts_with(type)) {
      model.source.fail(card.origin(), fmt::format("{}: expected elements {} in {}",
                                                   card.keyword().name, type, set));
    }
    out.push_back(*point);
  }
  return out;
}

namespace {

Fields only_line(const Model& model, const Card& card) {
  if (card.size() != 1) {
    model.source.fail(card.origin(), fmt::format("{}: found {} data lines, expected one",
                                                 card.keyword().name, card.size()));
  }
  return card.line(0, model.source);
}

// Moments of inertia only: the sign of products differs between programs.
Eigen::Matrix3d inertia_of(const Fields& fields) {
  for (size_t k = 3; k < 6; ++k) {
    if (fields.number_or(k, "product of inertia", 0.0) != 0.0) {
      fields.fail("products of inertia are not supported, expected 0");
    }
  }
  return Eigen::Vector3d(fields.number(0, "I11"), fields.number(1, "I22"), fields.number(2, "I33"))
      .asDiagonal();
}

}  // namespace

void build_masses(Model& model) {
  const std::vector<PointElement>& all = model.numbering.points();
  std::vector<Origin> described;
  const size_t refused = model.refusals.size();
  const auto add = [&](const PointElement& element, const Card& card) -> Mass& {
    described.push_back(element.origin);
    Mass mass;
    mass.where = model.source.where(card.origin());
    mass.node_index = model.node_map.require(element.node);
    model.deck.masses.push_back(std::move(mass));
    return model.deck.masses.back();
  };
  for_each_card(model, {"MASS", "ROTARYINERTIA"}, [&](size_t use, const Card& card) {
    card.keyword().allow({"ELSET", "ALPHA", "COMPOSITE"}, model.source, model.ignore);
    const Fields fields = only_line(model, card);
    if (card.keyword().key == "MASS") {
      fields.at_most(1, "mass");
      for (const PointElement& element : point_elements(model, use, card, "MASS")) {
        add(element, card).mass = fields.number(0, "mass");
      }
      return;
    }
    fields.at_most(6, "moments of inertia");
    for (const PointElement& element : point_elements(model, use, card, "ROTARYI")) {
      Mass& mass = add(element, card);
      const Use& at = model.numbering.uses()[use];
      mass.inertia = at.rotation * inertia_of(fields) * at.rotation.transpose();
      if (!model.node_map.turns(mass.node_index)) {
        model.source.fail(element.origin, fmt::format("element {}: its node belongs to a solid "
                                                      "and has no rotations",
                                                      element.id));
      }
    }
  });
  if (model.refusals.size() > refused) return;
  std::sort(described.begin(), described.end());
  for (const PointElement& element : all) {
    if (element.type != "MASS" && element.type != "ROTARYI") continue;
    if (!std::binary_search(described.begin(), described.end(), element.origin)) {
      model.refusals.add(fmt::format("{}: element {} of type {} has no value (*{})",
                                     model.source.where(element.origin), element.id, element.type,
                                     element.type == "MASS" ? "MASS" : "ROTARY INERTIA"));
    }
  }
}

}  // namespace clatter::mesh::deck::abaqus
