// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <map>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/drive_component.hpp"
#include "dynamics/given/csv_table.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {
namespace {

const Range kDiameterMm = Range::between(1e-3, 1e5), kMoment = Range::between(0.0, 1e12);

const Keys<ShaftSection>& section_keys() {
  static const Keys<ShaftSection> keys(
      "section", "a circular section along a part of the shaft",
      [](auto& key, ShaftSection& section) {
        key.number("from_mm", section.from, kPositionMm, "where it begins along the axis")
            .required();
        key.number("to_mm", section.to, kPositionMm, "where it ends").required();
        key.number("diameter_mm", section.outer, kDiameterMm, "outer diameter").required();
        key.number("inner_diameter_mm", section.inner, Range::between(0.0, kDiameterMm.max),
                   "inner diameter; 0: solid");
        key.check([](const Config& table, ShaftSection& found) {
          if (!(found.to > found.from))
            table.fail("to_mm", fmt::format("found {:g}, expected above from_mm, {:g}",
                                            found.to / kMilli, found.from / kMilli));
          if (!(found.inner < found.outer))
            table.fail("inner_diameter_mm",
                       fmt::format("found {:g}, expected below diameter_mm, {:g}",
                                   found.inner / kMilli, found.outer / kMilli));
        });
      });
  return keys;
}

const Keys<TorsionLaw>& phaser_keys() {
  static const Keys<TorsionLaw> keys(
      "phaser", "the disc turns on the shaft", [](auto& key, TorsionLaw& law) {
        key.number("stiffness_n_m_rad", law.stiffness, kAnyStiffness, "of its end stops")
            .required();
        key.number("damping_n_m_s_rad", law.damping, kAnyDamping, "of its oil");
        key.number("backlash_deg", law.backlash, Range::between(0.0, 360.0), "from stop to stop");
      });
  return keys;
}

const Keys<ShaftDiscSpec>& disc_keys() {
  static const Keys<ShaftDiscSpec> keys(
      "disc", "a rigid part on the shaft", [](auto& key, ShaftDiscSpec& disc) {
        name_row(key, disc.name).required();
        key.number("at_mm", disc.at, kPositionMm, "of its centre, along the axis").required();
        key.number("mass_kg", disc.inertia.mass, Range::between(0.0, 1e9), "mass");
        key.number("polar_kg_m2", disc.inertia.polar, kMoment, "moment of inertia about the axis");
        key.number("diametral_kg_m2", disc.diametral, kMoment,
                   "moment of inertia across the axis; half of polar_kg_m2 without it");
        key.number(
            "unbalance_g_mm", disc.unbalance, Range::between(0.0, 1e12),
            "mass times the distance of its centre from the axis; gravity has no moment on it");
        key.number("unbalance_deg", disc.phase, kAngleDeg,
                   "where it is, from the shaft's first axis where the angle is 0")
            .needs("unbalance_g_mm");
        key.table("phaser", disc.phaser, phaser_keys());
        key.check([](const Config& table, ShaftDiscSpec& found) {
          found.inertia.diametral = found.diametral.value_or(0.5 * found.inertia.polar);
          if (found.phaser && !(found.inertia.polar > 0.0))
            table.fail("polar_kg_m2",
                       "found 0, expected a moment of inertia of what the phaser turns");
        });
      });
  return keys;
}

BearingCoefficients constant_coefficients(const ShaftBearingSpec& bearing) {
  BearingCoefficients found;
  for (const double k : bearing.stiffnesses)
    found.stiffness.emplace_back(Spline::Kind::kLinear, std::vector{0.0}, std::vector{k});
  for (const double c : bearing.dampings)
    found.damping.emplace_back(Spline::Kind::kLinear, std::vector{0.0}, std::vector{c});
  return found;
}

Spline read_coefficient(const std::filesystem::path& path, const std::string& column,
                        const std::string& unit) {
  CsvColumns csv = read_csv(path, column);
  if (csv.abscissa_unit != "rad/s" || csv.unit != unit)
    throw InputError(fmt::format(
        "{}:{}: found {} in [{}] over [{}], expected units of [{}] over a speed, [rpm]",
        path.string(), csv.lines.front() - 1, csv.name, csv.unit, csv.abscissa_unit, unit));
  return {Spline::Kind::kMonotoneCubic, std::move(csv.x), std::move(csv.y)};
}

BearingCoefficients read_coefficients(const std::filesystem::path& path) {
  BearingCoefficients found;
  for (const char* place : {"11", "12", "21", "22"}) {
    found.stiffness.push_back(read_coefficient(path, fmt::format("k{}", place), "N/m"));
    found.damping.push_back(read_coefficient(path, fmt::format("c{}", place), "N s/m"));
  }
  return found;
}

void check_shaft_bearing(const Config& table, ShaftBearingSpec& bearing) {
  using Model = ShaftBearingSpec::Model;
  if (bearing.model == Model::kLinear) return;
  if (bearing.model == Model::kCoefficients) {
    if (bearing.table.empty() && !table.has("stiffness_matrix_n_m"))
      table.fail("model", "found \"coefficients\" alone, expected stiffness_matrix_n_m or table");
    bearing.coefficients =
        bearing.table.empty() ? constant_coefficients(bearing) : read_coefficients(bearing.table);
    return;
  }
  bearing.film = bearing.model == Model::kMoes ? BearingModel::kMoes : BearingModel::kButenschoen;
  check_bearing_width(table, bearing.size);
}

const Keys<ShaftBearingSpec>& shaft_bearing_keys() {
  using Model = ShaftBearingSpec::Model;
  static const Keys<ShaftBearingSpec> keys(
      "bearing", "a journal bearing of the shaft", [](auto& key, ShaftBearingSpec& bearing) {
        name_row(key, bearing.name).required();
        key.number("at_mm", bearing.at, kPositionMm, "of its middle, along the axis").required();
        key.table("on", bearing.on, point_keys(), "the housing; without it the ground");
        key.where(bearing.on.where, "on");
        key.choice("model", bearing.model,
                   {{"butenschoen", Model::kButenschoen},
                    {"moes", Model::kMoes},
                    {"linear", Model::kLinear},
                    {"coefficients", Model::kCoefficients}},
                   "an oil film by one of two formulas, a spring, or stiffnesses and damping that "
                   "couple both directions across the axis");
        bearing_size_rows(key, bearing.size, {"butenschoen", "moes"});
        key.number("stiffness_n_m", bearing.stiffness, kAnyStiffness, "of the spring")
            .of("model", "linear");
        key.number("damping_n_s_m", bearing.damping, kAnyDamping, "of the spring")
            .needs("model", "linear");
        key.vector("stiffness_matrix_n_m", bearing.stiffnesses, Range::between(-1e20, 1e20),
                   "k11, k12, k21, k22 along the shaft's first and second axis")
            .needs("model", "coefficients");
        key.vector("damping_matrix_n_s_m", bearing.dampings, Range::between(-1e15, 1e15),
                   "c11, c12, c21, c22")
            .needs("stiffness_matrix_n_m");
        key.path("table", bearing.table,
                 "CSV of k11 to k22 and c11 to c22 over the speed, as at its ends beyond")
            .needs("model", "coefficients")
            .excludes("stiffness_matrix_n_m");
        key.number("thrust_stiffness_n_m", bearing.thrust.stiffness, kAnyStiffness,
                   "along the axis");
        key.number("thrust_damping_n_s_m", bearing.thrust.damping, kAnyDamping, "along the axis");
        key.check(check_shaft_bearing);
      });
  return keys;
}

void make_sections(const Config& table, ShaftSpec& shaft) {
  const ShaftMaterial& material = shaft.material;
  const double nu = material.youngs / (2.0 * material.shear) - 1.0;
  if (!(nu >= 0.0 && nu <= 0.5))
    table.fail("shear_modulus_gpa",
               fmt::format("found {:g} with Young's modulus {:g}, which is Poisson's ratio {:.3g}, "
                           "expected one from 0 to 0.5",
                           material.shear * 1e-9, material.youngs * 1e-9, nu));
  shaft.sections.emplace(
      with_context(table.where("section"), [&] { return ShaftSections(shaft.pieces, material); }));
}

/// Discs and bearings are on the shaft and have names of their own; an axis that is fixed has no
/// unbalance.
void check_parts(const Config& table, const ShaftSpec& shaft) {
  std::map<std::string, std::string> names;
  const auto check = [&](const char* kind, const auto& parts) {
    const std::vector<Config> tables = table.tables(kind);
    for (size_t k = 0; k < parts.size(); ++k) {
      const double at = parts[k].at, begin = shaft.sections->begin(), end = shaft.sections->end();
      if (!(at >= begin && at <= end))
        tables[k].fail("at_mm", fmt::format("found {:g}, expected on the shaft, {:g} to {:g}",
                                            at / kMilli, begin / kMilli, end / kMilli));
      check_new_name(tables[k], "part of the shaft", parts[k].name, names);
    }
  };
  check("disc", shaft.discs);
  for (size_t d = 0; d < shaft.discs.size(); ++d)
    if (shaft.discs[d].unbalance > 0.0 && shaft.model != ShaftModel::kFull)
      table.tables("disc")[d].fail("unbalance_g_mm",
                                   "found with an axis that is fixed, expected model = \"full\"");
  check("bearing", shaft.bearings);
  if (shaft.slices == 0 && shaft.discs.empty() && shaft.bearings.empty())
    table.fail("slices", "found 0 and no disc or bearing, expected at least one of them");
}

}  // namespace

void check_bearing_width(const Config& table, const BearingSize& size) {
  const double x = size.width / size.diameter;
  if (!(x >= 0.12 && x <= 1.0))
    table.fail("width_mm", fmt::format("found {:g}, which is {:.3g} of the diameter, expected 0.12 "
                                       "to 1, where the film's formulas hold",
                                       size.width / kMilli, x));
}

const Keys<ShaftSpec>& shaft_keys() {
  static const Keys<ShaftSpec> keys(
      "shaft", "an elastic shaft with discs in journal bearings: camshafts",
      [](auto& key, ShaftSpec& shaft) {
        key.where(shaft.where);
        name_row(key, shaft.name).required();
        axis_row(key, shaft.axes.axis);
        key.vector("centre_mm", shaft.centre, kPositionMm, "point of the axis where at_mm is 0");
        key.choice("model", shaft.model,
                   {{"full", ShaftModel::kFull},
                    {"torsion", ShaftModel::kTorsion},
                    {"rigid", ShaftModel::kRigid}},
                   "bending and torsion in its bearings, torsion alone, or one angle");
        key.number("speed_rpm", shaft.start.speed, Range::between(-1e6, 1e6), "speed at the start");
        key.text("speed_of", shaft.speed_of, "the [[drive]] whose speed it has at the start")
            .excludes("speed_rpm");
        key.number("speed_ratio", shaft.speed_ratio, Range::between(-1e3, 1e3),
                   "factor of that speed")
            .needs("speed_of");
        key.number("start_deg", shaft.start.angle, kAngleDeg, "angle at the start");
        key.integer("slices", shaft.slices, Range::between(0.0, 1000.0),
                    "further rigid slices of equal length, between discs and bearings");
        key.number("youngs_modulus_gpa", shaft.material.youngs, Range::between(1e-6, 1e4),
                   "Young's modulus");
        key.number("shear_modulus_gpa", shaft.material.shear, Range::between(1e-6, 1e4),
                   "shear modulus");
        key.number("density_kg_m3", shaft.material.density, Range::between(1e-3, 1e5), "density");
        key.number("shear_factor", shaft.material.shear_factor, Range::between(0.1, 10.0),
                   "Timoshenko's; without it Cowper's of a hollow circle");
        key.number("loss_time_us", shaft.loss_time, Range::between(0.0, 1e6),
                   "damping over stiffness");
        error_scale_rows(key, shaft);
        key.tables("section", shaft.pieces, section_keys()).required();
        key.tables("disc", shaft.discs, disc_keys());
        key.tables("bearing", shaft.bearings, shaft_bearing_keys());
        key.check(make_sections);
        key.check(check_parts);
      });
  return keys;
}

ShaftSpec read_shaft(const Config& root, const Config& table) {
  ShaftSpec shaft = shaft_keys().read(table);
  if (!shaft.speed_of.empty())
    shaft.start.speed = speed_of_drive(root, table, "speed_of", shaft.speed_of) * shaft.speed_ratio;
  return shaft;
}

}  // namespace clatter::dynamics
