// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/joint_spec.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/units.hpp"
#include "dynamics/component/law_table.hpp"

namespace clatter::dynamics {
namespace {

const Range kDiameterMm = Range::between(0.1, 1e4);

// Keys of the spring are read in all models: a scene has them from its base.
RadialLaw read_spring(const Config& table) {
  RadialLaw law;
  law.clearance =
      table.number_or("clearance_um", law.clearance / kMicro, Range::between(0.0, 1e5)) * kMicro;
  law.soft_stiffness =
      table.number_or("soft_stiffness_n_m", law.soft_stiffness, Range::between(0.0, 1e15));
  law.exponent = table.number_or("exponent", law.exponent, Range{1.0, 3.0, false});
  law.stiffness = table.number_or("stiffness", law.stiffness, Range::between(1.0, 1e27));
  law.damping = table.number_or("damping_n_s_m", law.damping, Range::between(0.0, 1e12));
  return law;
}

std::optional<PinFriction> read_friction(const Config& table,
                                         std::vector<std::filesystem::path>& files) {
  PinFriction law;
  law.reversal_speed =
      table.number_or("reversal_speed_rad_s", law.reversal_speed, Range::between(1e-6, 1e3));
  const bool by_table = table.has("friction_table");
  if (by_table && table.has("friction_coefficient"))
    table.fail("friction_table", "found beside friction_coefficient, expected one of the two");
  if (by_table) {
    files.push_back(table.path("friction_table"));
    law.moment =
        read_rising_table({files.back(), table.text_or("friction_column", "moment"), "N", "N m"});
  } else {
    const double coefficient =
        table.number_or("friction_coefficient", 0.0, Range::between(0.0, 10.0));
    const bool on = coefficient > 0.0 || table.has("diameter_mm");
    const double diameter = on ? table.number("diameter_mm", kDiameterMm) * kMilli : 0.0;
    if (coefficient == 0.0) return std::nullopt;
    law.moment = 0.5 * coefficient * diameter;
  }
  return law;
}

JournalSpec read_film(const Config& table, const std::string& model, double clearance) {
  JournalSpec film;
  if (model == "butenschoen") film.model = BearingModel::kButenschoen;
  film.size.diameter = table.number("diameter_mm", kDiameterMm) * kMilli;
  film.size.width = table.number("width_mm", kDiameterMm) * kMilli;
  film.size.viscosity = table.number("viscosity_mpa_s", Range::between(1e-4, 1e6)) * kMilli;
  film.size.clearance = 2.0 * clearance / film.size.diameter;
  const double x = film.size.width / film.size.diameter;
  if (!(x >= 0.12 && x <= 1.0))
    table.fail("width_mm", fmt::format("found {:g}, which is {:.3g} of the diameter, expected 0.12 "
                                       "to 1, where the film's formulas hold",
                                       film.size.width / kMilli, x));
  if (!(film.size.clearance >= 1e-6 && film.size.clearance <= 0.1))
    table.fail("clearance_um",
               fmt::format("found {:g}, which is {:.3g} of the radius, expected 1e-06 to 0.1",
                           clearance / kMicro, film.size.clearance));
  return film;
}

}  // namespace

JointSpec read_joint(const Config& tables, std::string_view key) {
  JointSpec joint;
  const auto table = tables.find_table(key);
  if (!table) return joint;
  const RadialLaw spring = read_spring(*table);
  const std::string model = table->choice("model", {"spring", "table", "moes", "butenschoen"});
  if (model == "moes" || model == "butenschoen") {
    joint.film = read_film(*table, model, spring.clearance);
    return joint;
  }
  joint.law = spring;
  if (model == "table") joint.law = read_radial_table(*table, spring.damping, joint.files);
  joint.friction = read_friction(*table, joint.files);
  return joint;
}

}  // namespace clatter::dynamics
