// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <numbers>
#include <set>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/drive_component.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
const Range kPositionMm = Range::between(-1e6, 1e6), kDiameterMm = Range::between(1e-3, 1e5);
const Range kStiffness = Range::between(0.0, 1e20), kDamping = Range::between(0.0, 1e15);
const Range kMoment = Range::between(0.0, 1e12), kAngle = Range::between(-1e6, 1e6);

ShaftMaterial read_material(const Config& table) {
  ShaftMaterial material;
  material.youngs =
      table.number_or("youngs_modulus_gpa", material.youngs * 1e-9, Range::between(1e-6, 1e4)) *
      1e9;
  material.shear =
      table.number_or("shear_modulus_gpa", material.shear * 1e-9, Range::between(1e-6, 1e4)) * 1e9;
  material.density = table.number_or("density_kg_m3", material.density, Range::between(1e-3, 1e5));
  if (table.has("shear_factor"))
    material.shear_factor = table.number("shear_factor", Range::between(0.1, 10.0));
  const double nu = material.youngs / (2.0 * material.shear) - 1.0;
  if (!(nu >= 0.0 && nu <= 0.5))
    table.fail("shear_modulus_gpa",
               fmt::format("found {:g} with Young's modulus {:g}, which is Poisson's ratio {:.3g}, "
                           "expected one from 0 to 0.5",
                           material.shear * 1e-9, material.youngs * 1e-9, nu));
  return material;
}

ShaftSections read_sections(const Config& table) {
  std::vector<ShaftSection> sections;
  for (const Config& one : table.tables("section")) {
    ShaftSection section;
    section.from = one.number("from_mm", kPositionMm) * kMilli;
    section.to = one.number("to_mm", kPositionMm) * kMilli;
    section.outer = one.number("diameter_mm", kDiameterMm) * kMilli;
    section.inner =
        one.number_or("inner_diameter_mm", 0.0, Range::between(0.0, kDiameterMm.max)) * kMilli;
    if (!(section.to > section.from))
      one.fail("to_mm", fmt::format("found {:g}, expected above from_mm, {:g}", section.to / kMilli,
                                    section.from / kMilli));
    if (!(section.inner < section.outer))
      one.fail("inner_diameter_mm", fmt::format("found {:g}, expected below diameter_mm, {:g}",
                                                section.inner / kMilli, section.outer / kMilli));
    sections.push_back(section);
  }
  if (sections.empty()) table.fail("section", "found none, expected [[shaft.section]]");
  const ShaftMaterial material = read_material(table);
  return with_context(table.where("section"),
                      [&] { return ShaftSections(std::move(sections), material); });
}

double read_position(const Config& table, const ShaftSections& shaft) {
  const double at = table.number("at_mm", kPositionMm) * kMilli;
  if (!(at >= shaft.begin() && at <= shaft.end()))
    table.fail("at_mm", fmt::format("found {:g}, expected on the shaft, {:g} to {:g}", at / kMilli,
                                    shaft.begin() / kMilli, shaft.end() / kMilli));
  return at;
}

ShaftDiscSpec read_disc(const Config& table, const ShaftSections& shaft) {
  ShaftDiscSpec disc;
  disc.name = read_name(table);
  disc.at = read_position(table, shaft);
  disc.inertia.mass = table.number_or("mass_kg", 0.0, Range::between(0.0, 1e9));
  disc.inertia.polar = table.number_or("polar_kg_m2", 0.0, kMoment);
  disc.inertia.diametral = table.number_or("diametral_kg_m2", 0.5 * disc.inertia.polar, kMoment);
  if (const auto phaser = table.find_table("phaser")) {
    if (!(disc.inertia.polar > 0.0))
      table.fail("polar_kg_m2", "found 0, expected a moment of inertia of what the phaser turns");
    disc.phaser =
        TorsionLaw{phaser->number("stiffness_n_m_rad", kStiffness),
                   phaser->number_or("damping_n_m_s_rad", 0.0, kDamping),
                   phaser->number_or("backlash_deg", 0.0, Range::between(0.0, 360.0)) * kDegree};
  }
  return disc;
}

ShaftBearingSpec read_bearing(const Config& table, const ShaftSections& shaft) {
  ShaftBearingSpec bearing;
  bearing.name = read_name(table);
  bearing.at = read_position(table, shaft);
  if (table.has("on")) bearing.on = read_point(table, "on");
  bearing.on.where = table.where("on");
  const std::string model = table.choice("model", {"butenschoen", "moes", "linear"});
  if (model == "linear") {
    bearing.stiffness = table.number("stiffness_n_m", kStiffness);
    bearing.damping = table.number_or("damping_n_s_m", 0.0, kDamping);
  } else {
    bearing.film = model == "moes" ? BearingModel::kMoes : BearingModel::kButenschoen;
    bearing.size = read_bearing_size(table);
  }
  bearing.thrust.stiffness = table.number_or("thrust_stiffness_n_m", 0.0, kStiffness);
  bearing.thrust.damping = table.number_or("thrust_damping_n_s_m", 0.0, kDamping);
  return bearing;
}

ShaftModel read_model(const Config& table) {
  const std::string model = table.choice("model", {"full", "torsion", "rigid"});
  return model == "full"      ? ShaftModel::kFull
         : model == "torsion" ? ShaftModel::kTorsion
                              : ShaftModel::kRigid;
}

/// The speed at the start: of its own, or that of a drive times a ratio [rad/s].
double read_start_speed(const Config& root, const Config& table) {
  if (!table.has("speed_of")) {
    if (table.has("speed_ratio")) table.fail("speed_ratio", "found without speed_of");
    return table.number_or("speed_rpm", 0.0, Range::between(-1e6, 1e6)) * kRpm;
  }
  if (table.has("speed_rpm")) table.fail("speed_rpm", "found with speed_of, expected one of both");
  return speed_of_drive(root, table, "speed_of") *
         table.number_or("speed_ratio", 1.0, Range::between(-1e3, 1e3));
}

}  // namespace

BearingSize read_bearing_size(const Config& table) {
  BearingSize size;
  size.diameter = table.number("diameter_mm", kDiameterMm) * kMilli;
  size.width = table.number("width_mm", kDiameterMm) * kMilli;
  size.clearance = table.number("clearance", Range::between(1e-6, 0.1));
  size.viscosity = table.number("viscosity_mpa_s", Range::between(1e-4, 1e6)) * kMilli;
  const double x = size.width / size.diameter;
  if (!(x >= 0.12 && x <= 1.0))
    table.fail("width_mm", fmt::format("found {:g}, which is {:.3g} of the diameter, expected 0.12 "
                                       "to 1, where the film's formulas hold",
                                       size.width / kMilli, x));
  return size;
}

ShaftSpec read_shaft(const Config& root, const Config& table) {
  ShaftSpec shaft;
  shaft.name = read_name(table);
  shaft.where = table.where();
  shaft.axes.axis = table.choice("axis", {"z", "x", "y"})[0] - 'x';
  if (table.has("centre_mm")) shaft.centre = read_vector(table, "centre_mm", 1e6) * kMilli;
  shaft.model = read_model(table);
  shaft.sections = read_sections(table);
  std::set<std::string> names;
  const auto check_name = [&](const Config& one, const std::string& name) {
    if (!names.insert(name).second)
      one.fail("name", fmt::format("a second \"{}\" of the shaft, expected each name once", name));
  };
  for (const Config& one : table.tables("disc")) {
    shaft.discs.push_back(read_disc(one, *shaft.sections));
    check_name(one, shaft.discs.back().name);
  }
  for (const Config& one : table.tables("bearing")) {
    shaft.bearings.push_back(read_bearing(one, *shaft.sections));
    check_name(one, shaft.bearings.back().name);
  }
  shaft.slices = static_cast<int>(table.integer_or("slices", 0, Range::between(0, 1000)));
  if (shaft.slices == 0 && shaft.discs.empty() && shaft.bearings.empty())
    table.fail("slices", "found 0 and no disc or bearing, expected at least one of them");
  shaft.start.speed = read_start_speed(root, table);
  shaft.start.angle = table.number_or("start_deg", 0.0, kAngle) * kDegree;
  shaft.loss_time = table.number_or("loss_time_us", 0.0, Range::between(0.0, 1e6)) * 1e-6;
  read_error_scales(table, shaft);
  return shaft;
}

}  // namespace clatter::dynamics
