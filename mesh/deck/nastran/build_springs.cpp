// SPDX-License-Identifier: GPL-3.0-or-later
// CELAS1, CELAS2 and PELAS.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void add_end(Model& model, const RawSpring& raw, const RawSpring::End& end, double sign,
             Spring& spring) {
  const NodeIndex node_index = model.require(end.grid, raw.origin);
  const int base = end.direction < 3 ? 0 : 3;
  if (base == 3 && !model.node_map.is_point(node_index)) {
    model.source.fail(raw.origin,
                      fmt::format("spring: found a rotation of node {} of solids, which "
                                  "has none",
                                  end.grid));
  }
  const int32_t system = model.node_map.displacement_system(node_index);
  Eigen::Vector3d t = Eigen::Vector3d::Unit(end.direction - base);
  if (system != 0) {
    t = model.systems.directions(system, model.node_map.position(node_index), raw.origin)
            .col(end.direction - base);
  }
  for (int k = 0; k < 3; ++k) {
    add_term(spring.terms, node_index, base + k, sign * t[k]);
  }
}

void add_spring(Model& model, const RawSpring& raw) {
  Spring spring;
  spring.where = model.source.where(raw.origin);
  spring.stiffness = raw.stiffness;
  if (raw.property > 0) {
    const auto found = model.raw.spring_stiffness.find(raw.property);
    if (found == model.raw.spring_stiffness.end()) {
      model.source.fail(raw.origin, fmt::format("CELAS1: found no PELAS {}", raw.property));
    }
    spring.stiffness = found->second;
  }
  for (size_t end = 0; end < raw.ends.size(); ++end)
    add_end(model, raw, raw.ends[end], end == 0 ? 1.0 : -1.0, spring);
  if (raw.ends.size() == 2 && (raw.ends[0].direction < 3) != (raw.ends[1].direction < 3)) {
    model.source.fail(raw.origin,
                      "spring: found a rotation against a displacement, expected one "
                      "kind");
  }
  model.deck.springs.push_back(std::move(spring));
}

}  // namespace

void build_springs(Model& model) {
  for (const RawSpring& raw : model.raw.springs) {
    model.refusals.attempt([&] { add_spring(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
