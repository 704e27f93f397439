// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/contact_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/cylinder/clearance.hpp"
#include "dynamics/cylinder/oil_table.hpp"
#include "dynamics/cylinder/recess_table.hpp"
#include "dynamics/film/roughness.hpp"

namespace clatter::dynamics {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

const Range kHeight = Range::between(-1e4, 1e4);  // [mm]

/// Values over ascending heights [m].
struct Curve {
  std::vector<double> height, value;
};

/// Empty when both keys are absent. Values from 0 to 0.1 m.
Curve read_curve(const Config& table, const char* height_mm, const char* value_um) {
  const auto height = table.numbers_or(height_mm, {}), value = table.numbers_or(value_um, {});
  if (height.size() != value.size())
    table.fail(value_um, fmt::format("found {} values, expected as many values as {}, {}",
                                     value.size(), height_mm, height.size()));
  for (size_t k = 0; k < height.size(); ++k) {
    if (!(std::abs(height[k]) <= kHeight.max))
      table.fail(height_mm,
                 fmt::format("found {:g}, expected at most {:g}", height[k], kHeight.max));
    if (k > 0 && !(height[k] > height[k - 1]))
      table.fail(height_mm, fmt::format("found {:g} after {:g}, expected ascending heights",
                                        height[k], height[k - 1]));
    if (!(value[k] >= 0.0 && value[k] <= 1e5))
      table.fail(value_um,
                 fmt::format("found {:g}, expected no value below 0 or above 1e+05", value[k]));
  }
  return {scaled(height, kMilli), scaled(value, kMicro)};
}

void read_shape(const Config& table, film::SkirtShape& shape) {
  const Range relief = Range::between(0.0, 1e5);
  shape.barrel_apex =
      table.number_or("barrel_apex_mm", shape.barrel_apex / kMilli, kHeight) * kMilli;
  shape.barrel_top = table.number_or("barrel_top_um", shape.barrel_top / kMicro, relief) * kMicro;
  shape.barrel_bottom =
      table.number_or("barrel_bottom_um", shape.barrel_bottom / kMicro, relief) * kMicro;
  shape.ovality = table.number_or("ovality_um", shape.ovality / kMicro, relief) * kMicro;
  const Curve profile = read_curve(table, "profile_height_mm", "profile_relief_um");
  shape.table_height = profile.height;
  shape.table_relief = profile.value;
}

// Empty when the keys are absent; both or none must be given.
void read_bore(const Config& table, std::optional<film::LinerShape>& bore) {
  const Curve widening = read_curve(table, "bore_height_mm", "bore_widening_um");
  if (widening.height.empty()) return;
  bore.emplace();
  bore->angle = Eigen::VectorXd::Zero(1);
  bore->height =
      Eigen::Map<const Eigen::VectorXd>(widening.height.data(), std::ssize(widening.height));
  bore->deviation =
      Eigen::Map<const Eigen::RowVectorXd>(widening.value.data(), std::ssize(widening.value));
}

void read_ends(const Config& table, film::LinerEnds& ends) {
  if (table.has("liner_bottom_mm")) ends.bottom = table.number("liner_bottom_mm") * kMilli;
  if (table.has("liner_top_mm")) ends.top = table.number("liner_top_mm") * kMilli;
  if (!(ends.top > ends.bottom))
    table.fail("liner_top_mm", fmt::format("found {:g}, expected more than liner_bottom_mm, {:g}",
                                           ends.top / kMilli, ends.bottom / kMilli));
}

void read_oil(const Config& table, film::PistonLinerOptions& options) {
  const Range share{0.0, 1.0, false};
  options.viscosity =
      table.number_or("viscosity_pa_s", options.viscosity, Range::between(1e-6, 1e4));
  const double bulk_mpa =
      table.number_or("bulk_modulus_mpa", options.bulk_modulus * 1e-6, Range::between(0.0, 1e9));
  if (bulk_mpa > 0.0 && bulk_mpa < 1.0)
    table.fail("bulk_modulus_mpa",
               fmt::format("found {:g}, expected 0 (incompressible) or at least 1", bulk_mpa));
  options.bulk_modulus = bulk_mpa * 1e6;
  options.initial_fill = table.number_or("initial_fill", options.initial_fill, share);
  options.supply_fill = table.number_or("supply_fill", options.supply_fill, share);
  options.cavity = table.choice("cavity", {"layer", "striated"}) == "layer"
                       ? film::Cavity::kLayer
                       : film::Cavity::kStriated;
  if (table.has("oil_thickness_um")) {
    options.oil_thickness = table.number("oil_thickness_um", Range::between(1e-3, 1e5)) * kMicro;
  }
  options.supply_pressure =
      table.number_or("supply_pressure_bar", 0.0, Range::between(0.0, 1e4)) * 1e5;
}

// K is given, or follows from data of the summits by eq. (11), which a scene may add to its base.
void read_asperities(const Config& table, film::AsperityOptions& asperity) {
  using Law = film::AsperityOptions::Law;
  const bool summits = table.has("summit_density_1_mm2") || table.has("summit_radius_um");
  const std::string law = summits ? table.choice("asperity_law", {"exact", "fit"})
                                  : table.choice("asperity_law", {"fit", "exact"});
  asperity.law = law == "fit" ? Law::kFit : Law::kExact;
  asperity.roughness = table.number_or("summit_roughness_um", asperity.roughness / kMicro,
                                       Range::between(1e-4, 1e3)) *
                       kMicro;
  asperity.factor = table.number_or("asperity_factor", asperity.factor, Range::between(1e-12, 1e3));
  if (summits) {
    const double density = table.number("summit_density_1_mm2", Range::between(1e-3, 1e9)) * 1e6;
    const double radius = table.number("summit_radius_um", Range::between(1e-3, 1e6)) * kMicro;
    asperity.factor = film::contact_factor(density, radius, asperity.roughness);
    asperity.from_summits = true;
  }
  asperity.modulus =
      table.number_or("asperity_modulus_gpa", asperity.modulus * 1e-9, Range::between(1e-6, 1e5)) *
      1e9;
}

void read_surfaces(const Config& table, film::PistonLinerOptions& options) {
  auto& rough = options.roughness;
  const auto roughness = [&](const char* key, double value) {
    return table.number_or(key, value / kMicro, Range::between(0.0, 1e3)) * kMicro;
  };
  rough.piston = roughness("piston_roughness_um", rough.piston);
  rough.liner = roughness("liner_roughness_um", rough.liner);
  rough.peklenik = table.number_or("peklenik", rough.peklenik, Range::between(1e-3, 1e3));
  rough.flow_factors = table.flag_or("flow_factors", rough.flow_factors);
  rough.stress_factors = table.flag_or("friction_factors", rough.stress_factors);
  if (rough.stress_factors && !rough.flow_factors)
    table.fail("friction_factors", "found true without flow_factors, expected both");
  if (options.effects.film && rough.flow_factors) {
    if (rough.piston == 0.0 && rough.liner == 0.0)
      table.fail("flow_factors", "both walls are smooth, expected a roughness above 0");
    with_context(table.where("peklenik"), [&] { film::RoughFilm{rough}; });
  }
  read_asperities(table, options.asperity);
  options.damping.loss_factor = table.number_or("asperity_loss_factor", options.damping.loss_factor,
                                                Range::between(0.0, 0.6));
  options.friction.coefficient = table.number_or(
      "friction_coefficient", options.friction.coefficient, Range::between(0.0, 10.0));
  options.friction.reversal_speed = table.number_or(
      "reversal_speed_m_s", options.friction.reversal_speed, Range::between(1e-9, 1e3));
}

}  // namespace

film::PistonLinerOptions read_contact(const Config& table) {
  film::PistonLinerOptions options;
  options.bore_radius = 0.5 * table.number("bore_mm", Range::between(0.1, 1e4)) * kMilli;
  read_clearance(table, options);
  options.skirt_bottom =
      table.number_or("skirt_bottom_mm", options.skirt_bottom / kMilli, kHeight) * kMilli;
  options.skirt_top = table.number_or("skirt_top_mm", options.skirt_top / kMilli, kHeight) * kMilli;
  if (!(options.skirt_top > options.skirt_bottom))
    table.fail("skirt_top_mm",
               fmt::format("found {:g}, expected above skirt_bottom_mm, {:g}",
                           options.skirt_top / kMilli, options.skirt_bottom / kMilli));
  const bool whole = table.choice("span", {"pads", "whole"}) == "whole";
  options.span = whole ? film::SkirtSpan::kWhole : film::SkirtSpan::kPads;
  options.pad_span =
      table.number_or("pad_span_deg", options.pad_span / kDegree, Range{1.0, 180.0, false}) *
      kDegree;
  const Range cells{2.0, 400.0, false}, around{whole ? 8.0 : 2.0, 400.0, false};
  options.cells_around = static_cast<int>(table.integer_or(
      "cells_around", whole ? 4 * options.cells_around : options.cells_around, around));
  if (whole && options.cells_around % 2 != 0)
    table.fail("cells_around", fmt::format("found {}, expected an even number around the entire "
                                           "skirt: another is not symmetric",
                                           options.cells_around));
  options.cells_along =
      static_cast<int>(table.integer_or("cells_along", options.cells_along, cells));

  auto& effects = options.effects;
  effects.film = table.choice("lubrication", {"film", "none"}) == "film";
  effects.cavitation = table.flag_or("cavitation", true);
  effects.asperities = table.flag_or("asperities", true);
  effects.friction = table.flag_or("friction", true);
  if (!effects.film && !effects.asperities) {
    table.fail("asperities", "found false without a film, expected at least one of the two");
  }
  read_shape(table, options.skirt);
  read_bore(table, options.bore);
  read_ends(table, options.ends);
  read_oil(table, options);
  read_viscosity(table, options);
  read_liner_oil(table, options);
  options.recesses = read_recesses(table);
  read_surfaces(table, options);
  return options;
}

}  // namespace clatter::dynamics
