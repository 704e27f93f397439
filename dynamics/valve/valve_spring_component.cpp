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

CoilSpringSpec read_coil_spring(const Config& table) {
  const Range millimetres = Range::between(1e-2, 1e4), ratio = Range::between(0.0, 10.0);
  CoilSpringSpec spec;
  SpringWire wire;
  if (table.has("stiffness_n_m") || table.has("mass_kg")) {
    for (const char* key :
         {"wire_mm", "diameter_mm", "turns", "shear_modulus_gpa", "density_kg_m3"})
      if (table.has(key))
        table.fail(key, "found with stiffness_n_m and mass_kg, expected one of both");
    spec.stiffness = table.number("stiffness_n_m", Range::between(1e-3, 1e12));
    spec.mass = table.number("mass_kg", Range::between(1e-9, 1e6));
  } else {
    wire.wire = table.number_or("wire_mm", wire.wire / kMilli, millimetres) * kMilli;
    wire.diameter = table.number_or("diameter_mm", wire.diameter / kMilli, millimetres) * kMilli;
    wire.turns = table.number_or("turns", wire.turns, Range::between(0.1, 1e4));
    wire.shear_modulus =
        table.number_or("shear_modulus_gpa", wire.shear_modulus / 1e9, Range::between(1e-3, 1e3)) *
        1e9;
    wire.density = table.number_or("density_kg_m3", wire.density, Range::between(10.0, 3e4));
    if (wire.diameter <= wire.wire)
      table.fail("diameter_mm", fmt::format("found {:g}, expected more than the wire's {:g}",
                                            wire.diameter / kMilli, wire.wire / kMilli));
    spec.stiffness = wire.stiffness();
    spec.mass = wire.mass();
  }
  spec.force = table.number_or("force_n", spec.force, Range::between(0.0, 1e9));
  spec.to_solid = table.number_or("to_solid_mm", spec.to_solid / kMilli, millimetres) * kMilli;
  spec.masses = static_cast<int>(table.integer_or("masses", spec.masses, Range::between(1, 200)));
  spec.damping = table.number_or("damping_ratio", spec.damping, ratio);
  spec.clash_stiffness =
      table.number_or("clash_stiffness_n_m", spec.clash_stiffness, Range::between(1.0, 1e15));
  spec.clash_damping = table.number_or("clash_damping_ratio", spec.clash_damping, ratio);
  return spec;
}

void ValveSpringComponent::add_bodies(ModelBuilder& model) {
  from_ = model.position(spec_.a, std::nullopt);
  to_ = model.position(spec_.b, std::nullopt);
  if ((to_ - from_).norm() < 1e-9)
    throw InputError(spec_.b.where +
                     ": is the same point as a, expected another one: the spring acts along the "
                     "line between them");
  model.add_body(
      make_coil_body(spec_.name + "_coils", spec_.spring, (to_ - from_).normalized(), {}),
      spec_.where);
}

void ValveSpringComponent::add_elements(ModelBuilder& model) {
  const Eigen::Vector3d axis = (to_ - from_).normalized();
  const int body = model.body(spec_.name + "_coils");
  std::vector<int> masses;
  for (int k = 0; k < spec_.spring.masses; ++k) masses.push_back(model.system.coordinate(body, k));
  CoilEnd a(model.port(spec_.a), axis, from_), b(model.port(spec_.b), axis, to_);
  model.system.add_element(std::make_unique<CoilSpring>(element_name(), std::move(a), std::move(b),
                                                        masses, spec_.spring));
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
  add_spring_effect(element_name(), spec_.spring, effects).unknowns = size().modes;
}

ComponentList read_valve_springs(const Config& root) {
  ComponentList springs;
  for (const Config& table : root.tables("valve_spring")) {
    ValveSpringSpec spec;
    spec.name = read_name(table);
    spec.where = table.where();
    spec.a = read_point(table, "a");
    spec.b = read_point(table, "b");
    spec.spring = read_coil_spring(table);
    springs.push_back(std::make_shared<ValveSpringComponent>(std::move(spec)));
  }
  return springs;
}

}  // namespace clatter::dynamics
