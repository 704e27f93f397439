// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/rod_table.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

void check_rod(const Config& table, DescribedRod& rod) {
  RodSpec& spec = rod.spec;
  RodProperties& found = rod.properties;
  spec.body.name = "rod";
  spec.body.motion = BodyMotion::kRod;
  const bool rigid = spec.model == RodModel::kRigid, two = spec.model == RodModel::kTwoMass;
  if (found.inertia > 0.0 && found.mass > 0.0) {
    // Beyond these the radius of gyration is over the length, or under a thousandth of it.
    const double largest = found.mass * found.length * found.length;
    if (!(found.inertia >= 1e-6 * largest && found.inertia <= largest))
      table.fail(
          "inertia_kg_m2",
          fmt::format("found {:g}, expected at least {:.3g} and at most {:.3g}, mass x length^2",
                      found.inertia, 1e-6 * largest, largest));
  }
  if (found.centre > found.length)
    table.fail("centre_mm", fmt::format("found {:g}, expected at most length_mm, {:g}",
                                        found.centre / kMilli, found.length / kMilli));
  if (two) {
    if (!(found.centre > 0.0 && found.centre < found.length))
      table.fail("centre_mm", fmt::format("found {:g} with model = \"two-mass\", expected between "
                                          "the ends: a mass at one end has no inertia",
                                          found.centre / kMilli));
    spec.given_inertia = found.inertia;
    found = two_mass_rod(found);
  } else if (!rigid) {
    found = {.length = found.length};
  }
}

}  // namespace

// Keys that the model does not use are those of a base scene: they are checked all the same.
const Keys<DescribedRod>& rod_keys() {
  static const Keys<DescribedRod> keys(
      "rod", "the connecting rod", [](auto& key, DescribedRod& rod) {
        RodSpec& spec = rod.spec;
        const keys::Values with_mass{"rigid", "two-mass"};
        key.where(spec.length_where, "length_mm");
        key.where(spec.body.where);
        key.choice("model", spec.model,
                   {{"rigid", RodModel::kRigid},
                    {"two-mass", RodModel::kTwoMass},
                    {"massless", RodModel::kMassless},
                    {"elastic", RodModel::kElastic}},
                   "a rigid body, masses at its ends, a bar without mass, or a reduced model");
        key.number("length_mm", rod.properties.length, Range::between(1.0, 1e5),
                   "from the big end to the small end")
            .required();
        key.number("mass_kg", rod.properties.mass, Range::between(1e-6, 1e6), "mass")
            .required_with("model", with_mass);
        key.number("inertia_kg_m2", rod.properties.inertia, Range::positive(),
                   "moment of inertia about the centre of mass, across the plane of the crank")
            .required_with("model", "rigid");
        key.number("centre_mm", rod.properties.centre, Range::between(0.0, 1e5),
                   "from the big end to the centre of mass")
            .required_with("model", with_mass);
        key.path("rom", spec.body.rom, "reduced model of an elastic rod, stem.rom.h5")
            .required_with("model", "elastic");
        key.number("mode_limit_hz", spec.body.mode_limit_hz, Range::between(0.0, 1e9),
                   "modes above have no inertia; 0: all have it");
        error_scale_rows(key, spec.body);
        key.text("big_end", spec.big_end, "set of the node of the big end");
        key.text("small_end", spec.small_end, "set of the node of the small end");
        key.check(check_rod);
      });
  return keys;
}

}  // namespace clatter::dynamics
