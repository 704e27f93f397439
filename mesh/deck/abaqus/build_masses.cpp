// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "mesh/deck/abaqus/reading.hpp"

namespace clatter::mesh::deck::abaqus {

std::vector<PointElement> point_elements(Reading* reading, size_t use, const Card& card,
                                         std::string_view type) {
  const std::string& set = card.keyword().required("ELSET", reading->source);
  std::vector<PointElement> out;
  for (const int32_t element : reading->sets->elements(use, set, card.spot())) {
    const int32_t point = element - reading->model->cells();
    if (point < 0 || !reading->model->points()[static_cast<size_t>(point)].type.starts_with(type)) {
      reading->source.fail(card.spot(), fmt::format("{}: expected elements {} in {}",
                                                    card.keyword().name, type, set));
    }
    out.push_back(reading->model->points()[static_cast<size_t>(point)]);
  }
  return out;
}

namespace {

Fields only_line(const Reading& reading, const Card& card) {
  if (card.size() != 1) {
    reading.source.fail(card.spot(), fmt::format("{}: found {} data lines, expected one",
                                                 card.keyword().name, card.size()));
  }
  return card.line(0, reading.source);
}

// Moments of inertia only: the sign of products differs between programs.
Eigen::Matrix3d inertia_of(const Fields& fields) {
  for (size_t k = 3; k < 6; ++k) {
    if (fields.number_or(k, 0.0, "product of inertia") != 0.0) {
      fields.fail("products of inertia are not supported, expected 0");
    }
  }
  return Eigen::Vector3d(fields.number(0, "I11"), fields.number(1, "I22"), fields.number(2, "I33"))
      .asDiagonal();
}

}  // namespace

void read_masses(Reading* reading) {
  const std::vector<PointElement>& all = reading->model->points();
  std::vector<Spot> described;
  const size_t refused = reading->refusals->size();
  const auto add = [&](const PointElement& element, const Card& card) -> Mass& {
    described.push_back(element.spot);
    Mass mass;
    mass.where = reading->source.where(card.spot());
    mass.node_index = reading->node_map->of(element.node);
    reading->deck->masses.push_back(std::move(mass));
    return reading->deck->masses.back();
  };
  for_each_card(*reading, {"MASS", "ROTARYINERTIA"}, [&](size_t use, const Card& card) {
    card.keyword().allow({"ELSET"}, reading->source, reading->ignore);
    const Fields fields = only_line(*reading, card);
    if (card.keyword().key == "MASS") {
      fields.at_most(1, "mass");
      for (const PointElement& element : point_elements(reading, use, card, "MASS")) {
        add(element, card).mass = fields.number(0, "mass");
      }
      return;
    }
    fields.at_most(6, "moments of inertia");
    for (const PointElement& element : point_elements(reading, use, card, "ROTARYI")) {
      Mass& mass = add(element, card);
      const Use& at = reading->model->uses()[use];
      mass.inertia = at.rotation * inertia_of(fields) * at.rotation.transpose();
      if (!reading->node_map->is_point(mass.node_index)) {
        reading->source.fail(element.spot, fmt::format("element {}: its node belongs to a solid "
                                                       "and has no rotations",
                                                       element.id));
      }
    }
  });
  if (reading->refusals->size() > refused) return;
  std::sort(described.begin(), described.end());
  for (const PointElement& element : all) {
    if (element.type != "MASS" && element.type != "ROTARYI") continue;
    if (!std::binary_search(described.begin(), described.end(), element.spot)) {
      reading->refusals->add(fmt::format(
          "{}: element {} of type {} has no value (*{})", reading->source.where(element.spot),
          element.id, element.type, element.type == "MASS" ? "MASS" : "ROTARY INERTIA"));
    }
  }
}

}  // namespace clatter::mesh::deck::abaqus
