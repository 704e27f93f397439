// SPDX-License-Identifier: GPL-3.0-or-later
// CELAS1, CELAS2 and PELAS.
#include <fmt/format.h>

#include <bit>

#include "mesh/deck/nastran/cards.hpp"
#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

void refuse_damping(const Card& card, size_t i) {
  if (card.real_or(i, "GE", 0.0) != 0.0) {
    card.fail(i, "damping of springs (GE) is not supported, expected 0");
  }
}

// Both ends from field i on: G1, C1, G2, C2; an end without a grid is the ground.
RawSpring ends_of(const Card& card, size_t i) {
  RawSpring spring;
  spring.origin = card.origin();
  card.id(0, "EID");
  for (size_t end = 0; end < 2; ++end, i += 2) {
    if (card.blank(i) && card.blank(i + 1)) continue;
    const DofMask dof = card.components(i + 1, "C");
    if (std::popcount(dof) != 1) card.fail_expected(i + 1, "C", "one digit");
    spring.ends.push_back({card.id(i, "G"), std::countr_zero(dof)});
  }
  if (spring.ends.empty()) card.fail_expected(i - 4, "G1", "a grid");
  return spring;
}

void check_stiffness(const Card& card, size_t i, double stiffness) {
  if (!(stiffness > 0.0)) card.fail_expected(i, "K", "a stiffness above 0");
}

void add_term(Model& model, const RawSpring& raw, const RawSpring::End& end, double sign,
              Spring* spring) {
  const NodeIndex node_index = model.require(end.grid, raw.origin);
  const int base = end.direction < 3 ? 0 : 3;
  if (base == 3 && model.is_node(node_index)) {
    model.source.fail(raw.origin,
                      fmt::format("spring: found a rotation of node {} of solids, which "
                                  "has none",
                                  end.grid));
  }
  const int32_t system = model.displacement_system(node_index);
  Eigen::Vector3d t = Eigen::Vector3d::Unit(end.direction - base);
  if (system != 0) {
    t = model.systems.directions(system, model.position(node_index), raw.origin)
            .col(end.direction - base);
  }
  for (int k = 0; k < 3; ++k) {
    if (t[k] != 0.0) spring->terms.push_back({node_index, base + k, sign * t[k]});
  }
}

void add_spring(Model& model, const RawSpring& raw) {
  Spring spring;
  spring.where = model.where(raw.origin);
  spring.stiffness = raw.stiffness;
  if (raw.property > 0) {
    const auto found = model.bulk.spring_stiffness.find(raw.property);
    if (found == model.bulk.spring_stiffness.end()) {
      model.source.fail(raw.origin, fmt::format("CELAS1: found no PELAS {}", raw.property));
    }
    spring.stiffness = found->second;
  }
  for (size_t end = 0; end < raw.ends.size(); ++end)
    add_term(model, raw, raw.ends[end], end == 0 ? 1.0 : -1.0, &spring);
  if (raw.ends.size() == 2 && (raw.ends[0].direction < 3) != (raw.ends[1].direction < 3)) {
    model.source.fail(raw.origin,
                      "spring: found a rotation against a displacement, expected one "
                      "kind");
  }
  model.deck.springs.push_back(std::move(spring));
}

}  // namespace

void read_celas1(const Card& card, Bulk& bulk) {
  RawSpring spring = ends_of(card, 2);
  spring.property = card.id_or(1, "PID", card.id(0, "EID"));
  card.expect_end(6);
  bulk.springs.push_back(std::move(spring));
}

void read_celas2(const Card& card, Bulk& bulk) {
  RawSpring spring = ends_of(card, 2);
  spring.stiffness = card.real(1, "K");
  check_stiffness(card, 1, spring.stiffness);
  refuse_damping(card, 6);
  bulk.springs.push_back(std::move(spring));
}

void read_pelas(const Card& card, Bulk& bulk) {
  for (const size_t i : {size_t{0}, size_t{4}}) {
    if (i > 0 && card.blank_from(i)) break;
    const int32_t property = card.id(i, "PID");
    const double stiffness = card.real(i + 1, "K");
    check_stiffness(card, i + 1, stiffness);
    refuse_damping(card, i + 2);
    if (!bulk.spring_stiffness.emplace(property, stiffness).second) {
      card.fail(i, fmt::format("found a second PELAS {}", property));
    }
  }
}

void build_springs(Model& model) {
  for (const RawSpring& raw : model.bulk.springs) {
    model.refusals.attempt([&] { add_spring(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
