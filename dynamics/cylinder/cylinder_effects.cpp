// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_effects.hpp"

#include <algorithm>

#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/cylinder/cylinder_catalogue.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"

namespace clatter::dynamics {
namespace {

/// Adds rows under the cylinder's name.
class CylinderRows {
 public:
  CylinderRows(const CylinderSpec& cylinder, EffectTable& table)
      : cylinder_(cylinder), table_(table) {}
  Effect& add(const EffectEntry* entry, bool on, const std::string& why,
              const std::string& element = "") {
    return add(entry, std::string(entry->name), on, why, element);
  }
  Effect& add(const EffectEntry* entry, const std::string& name, bool on, const std::string& why,
              const std::string& element = "") {
    return table_.add(entry, cylinder_.name.empty() ? name : cylinder_.name + ": " + name, on, why,
                      element.empty() ? "" : cylinder_.name_of(element));
  }

 private:
  const CylinderSpec& cylinder_;
  EffectTable& table_;
};

/// Cells of the gap itself, without those of the layer on the liner.
int64_t gap_cells(const film::PistonLinerOptions& contact) {
  const int64_t pads = contact.span == film::SkirtSpan::kWhole ? 1 : 2;
  return pads * contact.cells_around * contact.cells_along;
}

void add_contact(const CylinderSpec& cylinder, const ComponentTraits& traits,
                 const std::string& ends, CylinderRows& table) {
  const bool contact = cylinder.contact.has_value();
  const auto effects = contact ? cylinder.contact->effects : film::ContactEffects{};
  const std::string absent = "no [contact]";
  const std::string name = contact ? cylinder.contact->name : "";
  table
      .add(find_effect(kCylinderEffects, "oil film"), contact && effects.film,
           !contact       ? absent
           : effects.film ? "contact.lubrication = \"film\" (all of the contact)"
                          : "contact.lubrication = \"none\"",
           contact && effects.film ? name : "")
      .unknowns = contact && effects.film ? gap_cells(*cylinder.contact) : 0;
  table.add(find_effect(kCylinderEffects, "cavitation"),
            contact && effects.film && effects.cavitation,
            !contact             ? absent
            : !effects.film      ? "no film"
            : effects.cavitation ? cylinder.contact->cavity == film::Cavity::kLayer
                                       ? "contact.cavitation, oil in layers on the walls"
                                       : "contact.cavitation, oil in streamers across the gap"
                                 : "contact.cavitation = false: every cell is full; "
                                   "oil_thickness_um, initial_fill, supply_fill are not used");
  const bool film = contact && effects.film;
  const auto add_oil = [&](const EffectEntry* effect, bool on, const char* key) {
    return &table.add(effect, film && on, !contact ? absent : film ? key : "no film");
  };
  const film::ViscosityOptions oil = film ? cylinder.contact->oil : film::ViscosityOptions{};
  add_oil(find_effect(kCylinderEffects, "oil layer on the liner"),
          film && cylinder.contact->liner_layer.has_value(), "contact.liner_oil")
      ->unknowns =
      film && cylinder.contact->liner_layer ? traits.film_cells - gap_cells(*cylinder.contact) : 0;
  add_oil(find_effect(kCylinderEffects, "viscosity over temperature"), oil.by_temperature(),
          oil.by_temperature() ? "contact.oil.law, instead of contact.viscosity_pa_s"
                               : "contact.oil.law");
  add_oil(find_effect(kCylinderEffects, "viscosity over pressure"), oil.pressure_coefficient > 0.0,
          "contact.oil.pressure_coefficient_1_gpa");
  add_oil(find_effect(kCylinderEffects, "viscosity over shear rate"), oil.cross.has_value(),
          "contact.oil.shear_rate_1_s");
  add_oil(find_effect(kCylinderEffects, "friction factors"),
          film && cylinder.contact->roughness.stress_factors, "contact.friction_factors");
  const bool whole = contact && cylinder.contact->span == film::SkirtSpan::kWhole;
  table.add(find_effect(kCylinderEffects, "gap around the entire skirt"), whole,
            !contact ? absent
            : whole  ? "contact.span = \"whole\", contact.pad_span_deg is not used"
                     : "contact.span = \"pads\"");
  const size_t recesses = contact ? cylinder.contact->recesses.size() : 0;
  table.add(find_effect(kCylinderEffects, "grooves and windows"), recesses > 0,
            recesses > 0 ? fmt::format("{} contact.recess", recesses) : "no contact.recess");
  table.add(find_effect(kCylinderEffects, "asperity contact"), contact && effects.asperities,
            contact && cylinder.contact->asperity.from_summits
                ? "contact.asperities, eq. (11) by summit data instead of contact.asperity_factor"
                : "contact.asperities",
            contact && !effects.film ? name : "");
  const bool damped = contact && effects.asperities && cylinder.contact->damping.loss_factor > 0.0;
  table.add(find_effect(kCylinderEffects, "damping of the contact"), damped,
            contact && !effects.asperities ? "no asperities" : "contact.asperity_loss_factor");
  table.add(find_effect(kCylinderEffects, "friction"), contact && effects.friction,
            "contact.friction");
  const size_t shapes =
      contact ? cylinder.contact->bore_shapes.size() + cylinder.contact->skirt_shapes.size() : 0;
  table.add(find_effect(kCylinderEffects, "shapes of bore and skirt"), shapes > 0,
            shapes > 0 ? fmt::format("{} added", shapes) : "no contact.bore_shape, skirt_shape");
  const size_t scaled = cylinder.scaled_bore.size() + cylinder.scaled_skirt.size();
  table.add(find_effect(kCylinderEffects, "shapes scaled over the cycle"), scaled > 0,
            scaled > 0 ? fmt::format("{} added", scaled) : "no scale, scale_table of a shape");
  table.add(find_effect(kCylinderEffects, "ends of the liner"), !ends.empty(),
            !contact       ? absent
            : ends.empty() ? "no contact.liner_bottom_mm, liner_top_mm, no elastic liner"
                           : ends);
}

void add_joint(const JointSpec& joint, const std::string& key, const std::string& with,
               const std::string& element, CylinderRows& table) {
  const bool is_table = std::holds_alternative<RadialTable>(joint.law);
  const std::string at = "the " + with;
  table.add(find_effect(kCylinderEffects, "rod joint"), "rod joint at " + at, true,
            joint.film ? "[" + key + "], an oil film instead of a spring"
            : is_table ? "[" + key + "], a table instead of a spring"
                       : "[" + key + "]",
            element);
  table.add(find_effect(kCylinderEffects, "friction of the rod joint"),
            "friction of the rod at " + at, joint.film || joint.friction,
            joint.film ? "of the oil film" : key + ".friction_coefficient, friction_table");
}

void add_rings(const CylinderSpec& cylinder, CylinderRows& table) {
  const auto any = [&](double RingSpec::*coefficient) {
    return std::any_of(cylinder.rings.begin(), cylinder.rings.end(),
                       [&](const RingSpec& ring) { return ring.*coefficient > 0.0; });
  };
  const bool face = any(&RingSpec::boundary), groove = any(&RingSpec::groove);
  table.add(find_effect(kCylinderEffects, "friction of the rings"), face,
            "contact.ring.friction_coefficient", face || groove ? "rings" : "");
  table.add(find_effect(kCylinderEffects, "friction in the ring grooves"), groove,
            "contact.ring.groove_coefficient");
}

}  // namespace

void add_cylinder_effects(const CylinderSpec& cylinder, const ComponentTraits& traits,
                          bool on_block, const std::string& ends, EffectTable& effects) {
  CylinderRows table(cylinder, effects);
  table
      .add(find_effect(kCylinderEffects, "inertia of the piston"), true,
           "eq. (10): frame moves with z_B(t), does not turn")
      .unknowns = cylinder.piston.elastic ? 0 : 6;
  const std::vector<RodEffect> rod = rod_effects(cylinder);
  table.add(rod[0].entry, rod[0].on, rod[0].why, rod[0].element).unknowns = traits.modes;
  table.add(find_effect(kCylinderEffects, "inertia of the block"), false,
            "p* = 0: its frame is at rest");
  const bool balanced = cylinder.engine.balanced && on_block;
  table.add(find_effect(kCylinderEffects, "balance by other cylinders"), balanced,
            !balanced && cylinder.engine.balanced ? "no elastic block"
                                                  : "engine.balanced, on the block's rigid modes");
  table.add(find_effect(kCylinderEffects, "gas pressure"), cylinder.gas.has_value(),
            cylinder.gas ? "[gas]" : "no [gas]");
  if (cylinder.rod.model == RodModel::kElastic)
    table.add(rod[1].entry, rod[1].on, rod[1].why, rod[1].element);
  const bool joined = cylinder.rod.model == RodModel::kMassless;
  add_joint(cylinder.small_end, "small_end", "pin", joined ? "rod" : "pin", table);
  add_joint(cylinder.big_end, "big_end", "crank", joined ? "" : "crank_pin", table);
  if (!cylinder.crankshaft)
    table.add(find_effect(kComponentEffects, "main bearings"), false,
              "no [crank]: its centre follows block.bearings");
  table.add(find_effect(kCylinderEffects, "pin guide"), true,
            "[pin_guide]: along the pin and about y, z", "pin_guide");
  add_contact(cylinder, traits, ends, table);
  add_rings(cylinder, table);
}

}  // namespace clatter::dynamics
