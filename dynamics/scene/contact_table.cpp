// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/contact_table.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace clatter::dynamics {
namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

void read_shape(const Config& table, film::SkirtShape& shape) {
  shape.barrel_apex = table.number_or("barrel_apex_mm", shape.barrel_apex / kMilli) * kMilli;
  shape.barrel_top =
      table.number_or("barrel_top_um", shape.barrel_top / kMicro, Range::not_negative()) * kMicro;
  shape.barrel_bottom =
      table.number_or("barrel_bottom_um", shape.barrel_bottom / kMicro, Range::not_negative()) *
      kMicro;
  shape.ovality =
      table.number_or("ovality_um", shape.ovality / kMicro, Range::not_negative()) * kMicro;
  shape.table_height = scaled(table.numbers_or("profile_height_mm", {}), kMilli);
  shape.table_relief = scaled(table.numbers_or("profile_relief_um", {}), kMicro);
  if (shape.table_height.size() != shape.table_relief.size()) {
    table.fail("profile_relief_um", "expected as many values as profile_height_mm");
  }
}

// Empty when the keys are absent; both or none must be given.
void read_bore(const Config& table, std::optional<film::LinerShape>& bore) {
  const auto height = scaled(table.numbers_or("bore_height_mm", {}), kMilli);
  const auto widening = scaled(table.numbers_or("bore_widening_um", {}), kMicro);
  if (height.size() != widening.size()) {
    table.fail("bore_widening_um", "expected as many values as bore_height_mm");
  }
  if (height.empty()) return;
  for (size_t k = 0; k < height.size(); ++k) {
    if (k > 0 && !(height[k] > height[k - 1])) {
      table.fail("bore_height_mm", "expected ascending heights");
    }
    if (!(widening[k] >= 0.0))
      table.fail("bore_widening_um",
                 fmt::format("found {:g}, expected no value below 0", widening[k] / kMicro));
  }
  bore.emplace();
  bore->angle = Eigen::VectorXd::Zero(1);
  bore->height = Eigen::Map<const Eigen::VectorXd>(height.data(), std::ssize(height));
  bore->deviation = Eigen::Map<const Eigen::RowVectorXd>(widening.data(), std::ssize(widening));
}

void read_oil(const Config& table, film::PistonLinerOptions& options) {
  const Range share{0.0, 1.0, false};
  options.viscosity = table.number_or("viscosity_pa_s", options.viscosity, Range::positive());
  options.bulk_modulus =
      table.number_or("bulk_modulus_mpa", options.bulk_modulus * 1e-6, Range::not_negative()) * 1e6;
  options.initial_fill = table.number_or("initial_fill", options.initial_fill, share);
  options.supply_fill = table.number_or("supply_fill", options.supply_fill, share);
  if (table.has("oil_thickness_um")) {
    options.oil_thickness = table.number("oil_thickness_um", Range::positive()) * kMicro;
  }
  options.supply_pressure =
      table.number_or("supply_pressure_bar", 0.0, Range::not_negative()) * 1e5;
}

void read_surfaces(const Config& table, film::PistonLinerOptions& options) {
  auto& rough = options.roughness;
  const auto roughness = [&](const char* key, double value) {
    return table.number_or(key, value / kMicro, Range::not_negative()) * kMicro;
  };
  rough.piston = roughness("piston_roughness_um", rough.piston);
  rough.liner = roughness("liner_roughness_um", rough.liner);
  rough.peklenik = table.number_or("peklenik", rough.peklenik, Range::positive());
  rough.flow_factors = table.flag_or("flow_factors", rough.flow_factors);
  auto& asperity = options.asperity;
  asperity.law = table.choice("asperity_law", {"fit", "exact"}) == "fit"
                     ? film::AsperityOptions::Law::kFit
                     : film::AsperityOptions::Law::kExact;
  asperity.factor = table.number_or("asperity_factor", asperity.factor, Range::positive());
  asperity.modulus =
      table.number_or("asperity_modulus_gpa", asperity.modulus * 1e-9, Range::positive()) * 1e9;
  asperity.roughness =
      table.number_or("summit_roughness_um", asperity.roughness / kMicro, Range::positive()) *
      kMicro;
  auto& damping = options.damping;
  damping.loss_factor =
      table.number_or("asperity_loss_factor", damping.loss_factor, Range{0.0, 0.6, false});
  options.friction.coefficient =
      table.number_or("friction_coefficient", options.friction.coefficient, Range::not_negative());
  options.friction.reversal_speed =
      table.number_or("reversal_speed_m_s", options.friction.reversal_speed, Range::positive());
}

}  // namespace

film::PistonLinerOptions read_contact(const Config& table) {
  film::PistonLinerOptions options;
  options.bore_radius = 0.5 * table.number("bore_mm", Range::positive()) * kMilli;
  options.clearance = table.number("clearance_um", Range::not_negative()) * kMicro;
  options.skirt_bottom = table.number_or("skirt_bottom_mm", options.skirt_bottom / kMilli) * kMilli;
  options.skirt_top = table.number_or("skirt_top_mm", options.skirt_top / kMilli) * kMilli;
  options.pad_span =
      table.number_or("pad_span_deg", options.pad_span / kDegree, Range{1.0, 179.0, false}) *
      kDegree;
  const Range cells{2.0, 400.0, false};
  options.cells_around =
      static_cast<int>(table.integer_or("cells_around", options.cells_around, cells));
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
  read_oil(table, options);
  read_surfaces(table, options);
  return options;
}

}  // namespace clatter::dynamics
