// SPDX-License-Identifier: GPL-3.0-or-later
// CELAS1 to CELAS4, CMASS1 to CMASS4.
#include <fmt/format.h>

#include "mesh/deck/nastran/model.hpp"

namespace clatter::mesh::deck::nastran {
namespace {

template <class Property>
Property property_of(const Model& model, const RawSpring& raw,
                     const std::map<int32_t, Property>& all, const char* card) {
  if (const auto found = all.find(raw.property); found != all.end()) return found->second;
  model.source.fail(raw.origin, fmt::format("found no {} {}", card, raw.property));
}

RawSpringProperty stiffness_of(const Model& model, const RawSpring& raw) {
  if (raw.property == 0) return {raw.value, raw.loss_factor};
  return property_of(model, raw, model.raw.spring_properties, "PELAS");
}

double mass_of(const Model& model, const RawSpring& raw) {
  return raw.property == 0 ? raw.value : property_of(model, raw, model.raw.scalar_masses, "PMASS");
}

// u_1 - u_2, along the directions of the ends.
std::vector<Equation::Term> elongation_of(Model& model, const RawSpring& raw) {
  std::vector<Equation::Term> terms;
  int kinds = 0;  // bit 0: displacements, bit 1: rotations
  for (size_t end = 0; end < raw.ends.size(); ++end) {
    const int32_t grid = raw.ends[end].grid;
    const NodeIndex node_index = model.require(grid, raw.origin);
    const int direction = model.direction_at(grid, raw.ends[end].direction, raw.origin);
    if (direction >= 3 && !model.node_map.turns(node_index)) {
      model.source.fail(raw.origin,
                        fmt::format("spring: found a rotation of node {} of solids, which "
                                    "has none",
                                    grid));
    }
    kinds |= direction < 3 ? 1 : 2;
    for (const Equation::Term& term :
         terms_along(model, node_index, direction, end == 0 ? 1.0 : -1.0, raw.origin))
      terms.push_back(term);
  }
  if (kinds == 3) {
    model.source.fail(raw.origin,
                      "spring: found a rotation against a displacement, expected one "
                      "kind");
  }
  return terms;
}

void add(Model& model, const RawSpring& raw) {
  const std::vector<Equation::Term> terms = elongation_of(model, raw);
  const std::string where = model.source.where(raw.origin);
  if (!raw.is_mass) {
    const RawSpringProperty spring = stiffness_of(model, raw);
    model.deck.springs.push_back({where, spring.stiffness, terms, spring.loss_factor});
    return;
  }
  const double mass = mass_of(model, raw);
  Eigen::VectorXd c(static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index i = 0; i < c.size(); ++i) c(i) = terms[i].coefficient;
  model.spend(16 * c.size() * c.size(), raw.origin);
  model.deck.matrices.push_back({fmt::format("cmass_{}", model.deck.matrices.size() + 1), where,
                                 true, terms,
                                 model.raw.control.mass_factor * mass * c * c.transpose()});
}

}  // namespace

void build_springs(Model& model) {
  for (const RawSpring& raw : model.raw.springs) {
    model.refusals.attempt([&] { add(model, raw); });
  }
}

}  // namespace clatter::mesh::deck::nastran
