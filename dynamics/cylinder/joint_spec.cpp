// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/joint_spec.hpp"

#include <fmt/format.h>

#include <string>

#include "core/base/units.hpp"
#include "dynamics/component/law_table.hpp"

namespace clatter::dynamics {
namespace {

struct JointTable {
  enum class Model : char { kSpring, kTable, kMoes, kButenschoen };
  Model model = Model::kSpring;
  RadialLaw spring;
  RadialTableSpec table;
  BearingSize size;
  double coefficient = 0.0;
  std::filesystem::path friction_table;
  std::string friction_column = "moment";
  double reversal_speed = PinFriction().reversal_speed;  // [rad/s]
  JointSpec joint;                                       // that follows
};
using Model = JointTable::Model;

void set_film(const Config& table, JointTable& found) {
  BearingSize& size = found.size;
  size.clearance = 2.0 * found.spring.clearance / size.diameter;
  const double x = size.width / size.diameter;
  if (!(x >= 0.12 && x <= 1.0))
    table.fail("width_mm", fmt::format("found {:g}, which is {:.3g} of the diameter, expected 0.12 "
                                       "to 1, where the film's formulas hold",
                                       size.width / kMilli, x));
  if (!(size.clearance >= 1e-6 && size.clearance <= 0.1))
    table.fail("clearance_um",
               fmt::format("found {:g}, which is {:.3g} of the radius, expected 1e-06 to 0.1",
                           found.spring.clearance / kMicro, size.clearance));
  found.joint.film = JournalSpec{
      found.model == Model::kMoes ? BearingModel::kMoes : BearingModel::kButenschoen, size};
}

void set_friction(const Config& table, JointTable& found) {
  PinFriction law{0.0, found.reversal_speed};
  if (!found.friction_table.empty()) {
    law.moment = read_rising_table({found.friction_table, found.friction_column, "N", "N m"});
    found.joint.files.push_back(found.friction_table);
  } else {
    if (found.coefficient == 0.0) return;
    if (found.size.diameter == 0.0)
      table.fail("diameter_mm", "is missing, friction_coefficient above 0 needs it");
    law.moment = 0.5 * found.coefficient * found.size.diameter;
  }
  found.joint.friction = law;
}

void make_joint(const Config& table, JointTable& found) {
  if (found.model == Model::kMoes || found.model == Model::kButenschoen)
    return set_film(table, found);
  found.joint.law = found.spring;
  if (found.model == Model::kTable) {
    found.joint.law = read_radial_table(found.table, found.spring.damping);
    found.joint.files.push_back(found.table.file);
  }
  set_friction(table, found);
}

// Keys of the spring are those of all models: a scene has them from its base.
const Keys<JointTable>& joint_keys() {
  static const Keys<JointTable> keys(
      "joint", "a joint of the rod", [](auto& key, JointTable& joint) {
        RadialLaw& law = joint.spring;
        const Range millimetres = Range::between(0.1, 1e4);
        const keys::Values dry{"spring", "table"}, film{"moes", "butenschoen"};
        key.choice("model", joint.model,
                   {{"spring", Model::kSpring},
                    {"table", Model::kTable},
                    {"moes", Model::kMoes},
                    {"butenschoen", Model::kButenschoen}},
                   "a spring beyond a clearance, a table, or an oil film by one of two formulas");
        key.number("clearance_um", law.clearance, Range::between(0.0, 1e5), "radial clearance");
        key.number("soft_stiffness_n_m", law.soft_stiffness, Range::between(0.0, 1e15),
                   "of the spring within the clearance");
        key.number("stiffness", law.stiffness, Range::between(1.0, 1e27),
                   "of the spring beyond the clearance")
            .shown_in("N/m^exponent");
        key.number("exponent", law.exponent, Range::between(1.0, 3.0),
                   "of the displacement beyond the clearance");
        key.number("damping_n_s_m", law.damping, Range::between(0.0, 1e12), "of spring and table");
        radial_table_rows(key, joint.table).of("model", "table");
        key.number("diameter_mm", joint.size.diameter, millimetres,
                   "of the pin, for friction or film")
            .excludes("friction_table", "it has the moment itself")
            .required_with("model", film);
        key.number("width_mm", joint.size.width, millimetres, "of the film's bearing")
            .of("model", film);
        key.number("viscosity_mpa_s", joint.size.viscosity, Range::between(1e-4, 1e6),
                   "dynamic viscosity of the film's oil")
            .of("model", film);
        key.number("friction_coefficient", joint.coefficient, Range::between(0.0, 10.0),
                   "dry friction of the pin")
            .needs("model", dry);
        key.path("friction_table", joint.friction_table,
                 "CSV of the moment of friction over the load, which rises from 0 at 0")
            .needs("model", dry)
            .excludes("friction_coefficient");
        key.text("friction_column", joint.friction_column, "column of the moment")
            .needs("friction_table");
        key.number("reversal_speed_rad_s", joint.reversal_speed, Range::between(1e-6, 1e3),
                   "speed below which the friction is less, so that it reverses smoothly")
            .needs("model", dry);
        key.check(make_joint);
      });
  return keys;
}

}  // namespace

const keys::Table& joint_table() { return joint_keys().table(); }

JointSpec read_joint(const Config& tables, std::string_view key) {
  const auto table = tables.find_table(key);
  return joint_keys().read(table.value_or(Config::parse("", ""))).joint;
}

}  // namespace clatter::dynamics
