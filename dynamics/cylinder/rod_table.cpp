// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/rod_table.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

RodModel read_model(const Config& table) {
  const std::string model = table.choice("model", {"rigid", "two-mass", "massless", "elastic"});
  if (model == "two-mass") return RodModel::kTwoMass;
  if (model == "massless") return RodModel::kMassless;
  return model == "elastic" ? RodModel::kElastic : RodModel::kRigid;
}

void read_inertia(const Config& table, RodProperties& rod) {
  // Beyond these the radius of gyration is over the length, or under a thousandth of it.
  const double largest = rod.mass * rod.length * rod.length;
  rod.inertia = table.number("inertia_kg_m2", Range::positive());
  if (!(rod.inertia >= 1e-6 * largest && rod.inertia <= largest))
    table.fail(
        "inertia_kg_m2",
        fmt::format("found {:g}, expected at least {:.3g} and at most {:.3g}, mass x length^2",
                    rod.inertia, 1e-6 * largest, largest));
}

/// mass_kg, centre_mm and inertia_kg_m2, all of which a rigid rod has.
void read_mass(const Config& table, bool needs_mass, bool needs_inertia, RodProperties& rod) {
  if (needs_mass || table.has("mass_kg"))
    rod.mass = table.number("mass_kg", Range::between(1e-6, 1e6));
  if (needs_inertia || (table.has("inertia_kg_m2") && rod.mass > 0.0)) {
    read_inertia(table, rod);
  } else if (table.has("inertia_kg_m2")) {
    table.number("inertia_kg_m2", Range::positive());
  }
  if (needs_mass || table.has("centre_mm"))
    rod.centre = table.number("centre_mm", Range::between(0.0, rod.length / kMilli)) * kMilli;
}

void read_elastic(const Config& table, bool is_elastic, RodSpec& spec) {
  BodySpec& body = spec.body;
  body.name = "rod";
  body.motion = BodyMotion::kRod;
  if (is_elastic || table.has("rom")) body.rom = table.path("rom");
  body.mode_limit_hz = table.number_or("mode_limit_hz", 0.0, Range::between(0.0, 1e9));
  read_error_scales(table, body);
  body.where = table.where();
  spec.big_end = table.text_or("big_end", spec.big_end);
  spec.small_end = table.text_or("small_end", spec.small_end);
}

}  // namespace

DescribedRod read_rod(const Config& table) {
  DescribedRod rod;
  RodSpec& spec = rod.spec;
  spec.model = read_model(table);
  spec.length_where = table.where("length_mm");
  RodProperties& properties = rod.properties;
  properties.length = table.number("length_mm", Range::between(1.0, 1e5)) * kMilli;
  read_elastic(table, spec.model == RodModel::kElastic, spec);
  const bool rigid = spec.model == RodModel::kRigid, two = spec.model == RodModel::kTwoMass;
  read_mass(table, rigid || two, rigid, properties);
  if (two) {
    if (!(properties.centre > 0.0 && properties.centre < properties.length))
      table.fail("centre_mm", fmt::format("found {:g} with model = \"two-mass\", expected between "
                                          "the ends: a mass at one end has no inertia",
                                          properties.centre / kMilli));
    spec.given_inertia = properties.inertia;
    properties = two_mass_rod(properties);
  } else if (!rigid) {
    properties = {.length = properties.length};
  }
  return rod;
}

}  // namespace clatter::dynamics
