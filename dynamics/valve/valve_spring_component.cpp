// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/valve_spring_component.hpp"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/valve/valve_catalogue.hpp"

namespace clatter::dynamics {

namespace {

/// Stiffness and mass of a coil spring: given, or by its wire.
void set_wire(const Config& table, CoilSpringTable& found) {
  const SpringWire& wire = found.wire;
  if (found.stiffness) {
    found.spring.stiffness = *found.stiffness;
    found.spring.mass = *found.mass;
    return;
  }
  if (wire.diameter <= wire.wire)
    table.fail("diameter_mm", fmt::format("found {:g}, expected more than the wire's {:g}",
                                          wire.diameter / kMilli, wire.wire / kMilli));
  found.spring.stiffness = wire.stiffness();
  found.spring.mass = wire.mass();
}

}  // namespace

const Keys<CoilSpringTable>& coil_spring_keys() {
  static const Keys<CoilSpringTable> keys(
      "spring", "a coil spring", [](auto& key, CoilSpringTable& table) {
        const Range millimetres = Range::between(1e-2, 1e4), ratio = Range::between(0.0, 10.0);
        CoilSpringSpec& spring = table.spring;
        SpringWire& wire = table.wire;
        const char* given = "they follow from the wire, or are given";
        key.number("stiffness_n_m", table.stiffness, Range::between(1e-3, 1e12),
                   "of the entire spring; without it that of the wire")
            .required_with("mass_kg");
        key.number("mass_kg", table.mass, Range::between(1e-9, 1e6),
                   "of the entire spring; without it that of the wire")
            .required_with("stiffness_n_m");
        key.number("wire_mm", wire.wire, millimetres, "diameter of the wire")
            .excludes("stiffness_n_m", given);
        key.number("diameter_mm", wire.diameter, millimetres, "mean diameter of the coils")
            .excludes("stiffness_n_m", given);
        key.number("turns", wire.turns, Range::between(0.1, 1e4), "active coils")
            .excludes("stiffness_n_m", given);
        key.number("shear_modulus_gpa", wire.shear_modulus, Range::between(1e-3, 1e3),
                   "shear modulus of the wire")
            .excludes("stiffness_n_m", given);
        key.number("density_kg_m3", wire.density, Range::between(10.0, 3e4), "density of the wire")
            .excludes("stiffness_n_m", given);
        key.number("force_n", spring.force, Range::between(0.0, 1e9), "at the installed length");
        key.number("to_solid_mm", spring.to_solid, millimetres,
                   "travel from there until all coils touch; in [valve] 1.2 mm more than the lift "
                   "without it");
        key.integer("masses", spring.masses, Range::between(1.0, 200.0), "masses of the model");
        key.number("damping_ratio", spring.damping, ratio, "of its first surge");
        key.number("clash_stiffness_n_m", spring.clash_stiffness, Range::between(1.0, 1e15),
                   "between coils that touch");
        key.number("clash_damping_ratio", spring.clash_damping, ratio,
                   "of masses on coils that touch");
        key.check(set_wire);
      });
  return keys;
}

const Keys<ValveSpringSpec>& valve_spring_keys() {
  static const Keys<ValveSpringSpec> keys(
      "valve_spring", "a coil spring as masses between springs, whose coils may touch",
      [](auto& key, ValveSpringSpec& spec) {
        key.where(spec.where);
        name_row(key, spec.name).required();
        key.table("a", spec.a, point_keys(), "point of its seat at the installed length")
            .required();
        key.table("b", spec.b, point_keys(), "point of the retainer at the installed length")
            .required();
        key.part(spec.coil, coil_spring_keys());
      });
  return keys;
}

void ValveSpringComponent::add_bodies(ModelBuilder& model) {
  from_ = model.position(spec_.a, std::nullopt);
  to_ = model.position(spec_.b, std::nullopt);
  if ((to_ - from_).norm() < 1e-9)
    throw InputError(spec_.b.where +
                     ": is the same point as a, expected another one: the spring acts along the "
                     "line between them");
  model.add_body(
      make_coil_body(spec_.name + "_coils", spec_.coil.spring, (to_ - from_).normalized(), {}),
      spec_.where);
}

void ValveSpringComponent::add_elements(ModelBuilder& model) {
  const Eigen::Vector3d axis = (to_ - from_).normalized();
  const int body = model.body(spec_.name + "_coils");
  std::vector<int> masses;
  for (int k = 0; k < spec_.coil.spring.masses; ++k)
    masses.push_back(model.system.coordinate(body, k));
  CoilEnd a(model.port(spec_.a), axis, from_), b(model.port(spec_.b), axis, to_);
  model.system.add_element(std::make_unique<CoilSpring>(element_name(), std::move(a), std::move(b),
                                                        masses, spec_.coil.spring));
}

Effect& add_spring_effect(const std::string& element, const CoilSpringSpec& spring,
                          EffectTable& effects) {
  return effects.add(
      find_effect(kValveEffects, "valve spring"), element, true,
      fmt::format("{} masses, coils that touch; {:.4g} N/m, {:.4g} g, surge {:.4g} Hz",
                  spring.masses, spring.stiffness, 1e3 * spring.mass, spring.surge()),
      element);
}

void ValveSpringComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  add_spring_effect(element_name(), spec_.coil.spring, effects).unknowns = traits().modes;
}

ComponentList read_valve_springs(const Config& root) {
  ComponentList springs;
  for (ValveSpringSpec& spec : read_named(root, "valve_spring", valve_spring_keys()))
    springs.push_back(std::make_shared<ValveSpringComponent>(std::move(spec)));
  return springs;
}

}  // namespace clatter::dynamics
