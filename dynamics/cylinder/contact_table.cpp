// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/contact_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/film/roughness.hpp"

namespace clatter::dynamics {
namespace {

using film::PistonLinerOptions;
using ContactKeys = Keys<ContactTable>;

const Range kHeightMm = Range::between(-1e4, 1e4), kShare = Range::between(0.0, 1.0);
const Range kDeviationUm = Range::between(0.0, 1e5);

void check_contact_skirt(const Config& table, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  if (!(options.skirt_top > options.skirt_bottom))
    table.fail("skirt_top_mm",
               fmt::format("found {:g}, expected above skirt_bottom_mm, {:g}",
                           options.skirt_top / kMilli, options.skirt_bottom / kMilli));
  if (!(options.ends.top > options.ends.bottom))
    table.fail("liner_top_mm",
               fmt::format("found {:g}, expected more than liner_bottom_mm, {:g}",
                           options.ends.top / kMilli, options.ends.bottom / kMilli));
  const bool whole = options.span == film::SkirtSpan::kWhole;
  if (whole) options.cells_around *= 4;
  options.cells_around = static_cast<int>(table.integer_or(
      "cells_around", options.cells_around, Range::between(whole ? 8.0 : 2.0, 400.0)));
  if (whole && options.cells_around % 2 != 0)
    table.fail("cells_around", fmt::format("found {}, expected an even number around the entire "
                                           "skirt: another is not symmetric",
                                           options.cells_around));
  if (contact.clearance) options.clearance = *contact.clearance;
  if (contact.minimum_warm_clearance)
    options.warm_clearance = film::WarmClearance{*contact.minimum_warm_clearance};
  if (contact.bore_height.empty()) return;
  film::LinerShape& bore = options.bore.emplace();
  const auto size = std::ssize(contact.bore_height);
  bore.angle = Eigen::VectorXd::Zero(1);
  bore.height = Eigen::Map<const Eigen::VectorXd>(contact.bore_height.data(), size);
  bore.deviation = Eigen::Map<const Eigen::RowVectorXd>(contact.bore_widening.data(), size);
}

void check_contact_oil(const Config& table, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  if (options.bulk_modulus > 0.0 && options.bulk_modulus < 1e6)
    table.fail("bulk_modulus_mpa", fmt::format("found {:g}, expected 0 (incompressible) or at "
                                               "least 1",
                                               1e-6 * options.bulk_modulus));
  options.oil = contact.oil.laws;
  with_context(contact.oil.where, [&] { film::Viscosity{options.oil, options.viscosity}; });
  if (!options.liner_layer) return;
  for (const auto& [key, supplies] :
       {std::pair{"supply_pressure_bar", options.supply_pressure > 0.0},
        {"supply_fill", options.supply_fill < 1.0}})
    if (supplies)
      table.fail(key, fmt::format("{} and liner_oil exclude each other: the layer on the liner "
                                  "supplies the skirt",
                                  key));
  const double length = options.skirt_top - options.skirt_bottom, cell = options.liner_layer->cell;
  if (2.0 * cell > length)
    table.table("liner_oil")
        .fail("cell_mm",
              fmt::format("found {:g}, expected at most half of the skirt's length, {:g}",
                          cell / kMilli, 0.5 * length / kMilli));
}

// K is given, or follows from data of the summits by eq. (11), which a scene may add to its base.
void check_contact_surfaces(const Config& table, ContactTable& contact) {
  using Law = film::AsperityOptions::Law;
  PistonLinerOptions& options = contact.options;
  film::AsperityOptions& asperity = options.asperity;
  asperity.law = contact.law.value_or(contact.summit_density ? Law::kExact : Law::kFit);
  table.text_or("asperity_law", asperity.law == Law::kExact ? "exact" : "fit");
  if (contact.summit_density) {
    asperity.factor =
        film::contact_factor(*contact.summit_density, *contact.summit_radius, asperity.roughness);
    asperity.from_summits = true;
  }
  if (!options.effects.film && !options.effects.asperities)
    table.fail("asperities",
               "asperities = false and lubrication = \"none\" exclude each other: nothing would "
               "carry the skirt");
  const film::RoughnessOptions& rough = options.roughness;
  if (rough.stress_factors && !rough.flow_factors)
    table.fail("friction_factors", "needs flow_factors = true");
  if (!options.effects.film || !rough.flow_factors) return;
  if (rough.piston == 0.0 && rough.liner == 0.0)
    table.fail("flow_factors", "needs a roughness above 0: both walls are smooth");
  with_context(table.where("peklenik"), [&] { film::RoughFilm{rough}; });
}

void check_contact_lists(const Config& table, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  for (const RecessTable& one : contact.recesses) options.recesses.push_back(one.recess);
  contact.rings = checked_rings(table, contact.described_rings, options);
  if (!options.liner_layer) return;
  for (const RingSpec& ring : contact.rings)
    options.liner_layer->rings.push_back({ring.height, ring.face_radius, ring.load, ring.least});
}

void add_skirt(ContactKeys& key, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  key.number("bore_mm", options.bore_radius, Range::between(0.1, 1e4), "diameter of the bore")
      .times(0.5)
      .required();
  key.number("clearance_um", contact.clearance, kDeviationUm,
             "radial clearance of the cold surfaces where the skirt is widest");
  key.number("minimum_warm_clearance_um", contact.minimum_warm_clearance, kDeviationUm,
             "smallest gap of the warm surfaces over the stroke, from which the clearance follows");
  key.one_of({"clearance_um", "minimum_warm_clearance_um"});
  key.number("skirt_bottom_mm", options.skirt_bottom, kHeightMm, "lower end of the skirt");
  key.number("skirt_top_mm", options.skirt_top, kHeightMm, "upper end of the skirt");
  key.choice("span", options.span,
             {{"pads", film::SkirtSpan::kPads}, {"whole", film::SkirtSpan::kWhole}},
             "a pad on each side, or a film all around the skirt");
  key.number("pad_span_deg", options.pad_span, Range::between(1.0, 180.0),
             "angle that each pad covers");
  key.integer("cells_around", contact.cells_around, Range::between(2.0, 400.0),
              "cells along the circumference, of an entire skirt an even number: 10 of a pad, 40 "
              "of the entire skirt without it");
  key.integer("cells_along", options.cells_along, Range::between(2.0, 400.0),
              "cells along the skirt: more than around, as the stroke carries oil along them");
  film::SkirtShape& shape = options.skirt;
  key.number("barrel_apex_mm", shape.barrel_apex, kHeightMm,
             "height of the largest diameter, from which a parabola leads to each end");
  key.number("barrel_top_um", shape.barrel_top, kDeviationUm, "relief at the upper end");
  key.number("barrel_bottom_um", shape.barrel_bottom, kDeviationUm, "relief at the lower end");
  key.number("ovality_um", shape.ovality, kDeviationUm, "relief in the direction of the pin");
  key.numbers("profile_height_mm", shape.table_height, kHeightMm, "heights of the skirt's profile")
      .ascending()
      .needs("profile_relief_um");
  key.numbers("profile_relief_um", shape.table_relief, kDeviationUm,
              "radial relief there, linear in between, constant beyond")
      .as_many_as("profile_height_mm");
  key.numbers("bore_height_mm", contact.bore_height, kHeightMm,
              "heights of the bore's profile above the crank axis")
      .ascending()
      .needs("bore_widening_um");
  key.numbers("bore_widening_um", contact.bore_widening, kDeviationUm,
              "radial widening there, linear in between, constant beyond")
      .as_many_as("bore_height_mm");
  key.tables("bore_shape", contact.bore_shapes, shape_keys(), "deviation of the bore");
  key.tables("skirt_shape", contact.skirt_shapes, shape_keys(), "deviation of the skirt");
  key.tables("recess", contact.recesses, recess_keys());
  const char* patches = "; without it that of an elastic liner's patches, a rigid one has none";
  key.number("liner_bottom_mm", options.ends.bottom, Range::between(-1e9, 1e9),
             fmt::format("lower end of the liner above the crank axis{}", patches));
  key.number("liner_top_mm", options.ends.top, Range::between(-1e9, 1e9),
             fmt::format("upper end of the liner above the crank axis{}", patches));
}

void add_film(ContactKeys& key, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  film::ContactEffects& effects = options.effects;
  key.choice("lubrication", effects.film, {{"film", true}, {"none", false}},
             "an oil film, or dry walls");
  key.flag("cavitation", effects.cavitation,
           "the film ruptures, with conservation of mass; else it is full everywhere");
  key.flag("asperities", effects.asperities, "contact of the rough walls");
  key.flag("friction", effects.friction, "shear of the film, and friction of the contact");
  key.number("viscosity_pa_s", options.viscosity, Range::between(1e-6, 1e4),
             "dynamic viscosity of the oil where no law of [contact.oil] gives it");
  key.number("bulk_modulus_mpa", options.bulk_modulus, Range::between(0.0, 1e9),
             "bulk modulus of the oil; 0: incompressible");
  key.number("initial_fill", options.initial_fill, kShare,
             "part of the gap full of oil at the start");
  key.number("supply_fill", options.supply_fill, kShare,
             "fill of the film that enters at the ends");
  key.choice("cavity", options.cavity,
             {{"layer", film::Cavity::kLayer}, {"striated", film::Cavity::kStriated}},
             "where the oil is that does not fill the gap: a layer on the liner, or strips");
  key.number("oil_thickness_um", options.oil_thickness, Range::between(1e-3, 1e5),
             "layer on the liner into which the skirt slides, which bounds inflow and content at "
             "the start; without it the fills alone hold");
  key.number("supply_pressure_bar", options.supply_pressure, Range::between(0.0, 1e4),
             "pressure of oil at all edges of the skirt over that of the crankcase");
  key.table("oil", contact.oil, oil_keys());
  key.table("liner_oil", options.liner_layer, liner_oil_keys())
      .needs("lubrication", "film")
      .needs("cavitation", "true")
      .needs("oil_thickness_um", {}, "it is the layer at the start");
  key.tables("ring", contact.described_rings, ring_keys());
}

void add_surfaces(ContactKeys& key, ContactTable& contact) {
  PistonLinerOptions& options = contact.options;
  film::RoughnessOptions& rough = options.roughness;
  const Range roughness = Range::between(0.0, 1e3);
  key.number("piston_roughness_um", rough.piston, roughness, "rms height of the skirt");
  key.number("liner_roughness_um", rough.liner, roughness, "rms height of the liner");
  key.number("peklenik", rough.peklenik, Range::between(1e-3, 1e3),
             "correlation length of the roughness along the stroke over that around");
  key.flag("flow_factors", rough.flow_factors, "flow factors of rough walls, Patir and Cheng");
  key.flag("friction_factors", rough.stress_factors, "their factors of the shear stress");
  film::AsperityOptions& asperity = options.asperity;
  using Law = film::AsperityOptions::Law;
  key.choice("asperity_law", contact.law, {{"fit", Law::kFit}, {"exact", Law::kExact}},
             "of the contact pressure over the gap: a fit, or the integral, which is taken with "
             "summit_density_1_mm2");
  key.number("summit_roughness_um", asperity.roughness, Range::between(1e-4, 1e3),
             "standard deviation of the heights of summits");
  key.number("asperity_factor", asperity.factor, Range::between(1e-12, 1e3),
             "factor K of the contact pressure, unless the summits give it");
  key.number("summit_density_1_mm2", contact.summit_density, Range::between(1e-3, 1e9),
             "summits on an area")
      .required_with("summit_radius_um");
  key.number("summit_radius_um", contact.summit_radius, Range::between(1e-3, 1e6),
             "radius of the summits")
      .required_with("summit_density_1_mm2");
  key.number("asperity_modulus_gpa", asperity.modulus, Range::between(1e-6, 1e5),
             "elastic modulus of both walls together");
  key.number("asperity_loss_factor", options.damping.loss_factor, Range::between(0.0, 0.6),
             "damping of the contact normal to the walls; 0: elastic");
  key.number("friction_coefficient", options.friction.coefficient, Range::between(0.0, 10.0),
             "of the contact of asperities");
  key.number("reversal_speed_m_s", options.friction.reversal_speed, Range::between(1e-9, 1e3),
             "speed below which the friction is less, so that it reverses smoothly");
}

}  // namespace

const Keys<ContactTable>& contact_keys() {
  static const Keys<ContactTable> keys("contact", "the skirt in its liner: film, asperities, rings",
                                       [](ContactKeys& key, ContactTable& contact) {
                                         add_skirt(key, contact);
                                         add_film(key, contact);
                                         add_surfaces(key, contact);
                                         key.check(check_contact_skirt);
                                         key.check(check_contact_oil);
                                         key.check(check_contact_surfaces);
                                         key.check(check_contact_lists);
                                       });
  return keys;
}

}  // namespace clatter::dynamics
