// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of cylinders.
#include <fmt/format.h>

#include <map>

#include "core/base/error.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/crank_keys.hpp"
#include "dynamics/cylinder/contact_table.hpp"
#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/cylinder/cylinder_keys.hpp"
#include "dynamics/cylinder/parked_cylinder.hpp"
#include "dynamics/cylinder/rod_table.hpp"

namespace clatter::dynamics {
namespace {

EngineSpec read_engine(const Config& tables, const EngineTable& given, double firing,
                       const RodProperties& rod) {
  const Config table = tables.table("engine");
  EngineSpec engine;
  stroke_keys().read(table, engine);
  engine.clock = given.clock;
  engine.speed_table = given.speed_table;
  engine.firing = firing;
  engine.rod = rod;
  const bool by_offset = engine.rod.length > 0.5 * engine.stroke;
  with_context(by_offset ? table.where("pin_offset_mm") : tables.table("rod").where("length_mm"),
               [&] { engine.crank(); });
  return engine;
}

void add_contact(const Config& table, CylinderSpec& cylinder) {
  ContactTable contact = contact_keys().read(table);
  film::PistonLinerOptions& options = cylinder.contact.emplace(std::move(contact.options));
  cylinder.rings = std::move(contact.rings);
  const auto add = [&](std::vector<ShapeTable>& found, auto& shapes, auto& scaled) {
    for (ShapeTable& one : found) {
      for (const auto& file : {one.file, one.table, one.scale.table})
        if (!file.empty()) cylinder.shape_files.push_back(file);
      if (one.scale.is_given())
        scaled.push_back({std::move(one.shape), std::move(one.scale)});
      else
        shapes.push_back(std::move(one.shape));
    }
  };
  add(contact.bore_shapes, options.bore_shapes, cylinder.scaled_bore);
  add(contact.skirt_shapes, options.skirt_shapes, cylinder.scaled_skirt);
}

/// @param tables of the cylinder: the scene's own, or those of a [[cylinder]] over them.
CylinderSpec read_cylinder(const Config& tables, const EngineTable& engine, double firing,
                           const std::optional<CrankBody>& crankshaft) {
  CylinderSpec cylinder;
  cylinder.crankshaft = crankshaft;
  const DescribedRod rod = rod_keys().read(tables.table("rod"));
  cylinder.rod = rod.spec;
  cylinder.engine = read_engine(tables, engine, firing, rod.properties);
  cylinder.piston = piston_keys().read(tables.table("piston"));
  if (const auto table = tables.find_table("block")) cylinder.bore = bore_keys().read(*table);
  if (const auto table = tables.find_table("gas")) cylinder.gas = gas_keys().read(*table);
  if (const auto table = tables.find_table("contact")) add_contact(*table, cylinder);
  cylinder.contact_where = tables.where("contact");
  cylinder.small_end = read_joint(tables, "small_end");
  cylinder.big_end = read_joint(tables, "big_end");
  if (cylinder.rod.model == RodModel::kMassless && cylinder.has_free_crank())
    tables.table("rod").fail("model",
                             "model = \"massless\" and crank.speed = \"free\" exclude each "
                             "other: give a rod with mass");
  for (const auto& [key, joint] :
       {std::pair{"small_end", &cylinder.small_end}, {"big_end", &cylinder.big_end}}) {
    if (cylinder.rod.model == RodModel::kMassless && (joint->friction || joint->film))
      tables.fail(key,
                  "friction or an oil film and rod.model = \"massless\" exclude each other: such "
                  "a rod bears no moment");
  }
  if (const auto table = tables.find_table("pin_guide")) cylinder.guide = guide_keys().read(*table);
  return cylinder;
}

}  // namespace

const Keys<GuideLaw>& guide_keys() {
  static const Keys<GuideLaw> keys(
      "pin_guide", "what holds the piston along its pin and upright on it",
      [](auto& key, GuideLaw& guide) {
        const Range any = Range::between(0.0, 1e15);
        key.number("axial_stiffness_n_m", guide.axial_stiffness, any, "along the pin");
        key.number("axial_damping_n_s_m", guide.axial_damping, any, "along the pin");
        key.number("tilt_stiffness_n_m", guide.tilt_stiffness, any, "about y and z")
            .shown_in("N m/rad");
        key.number("tilt_damping_n_m_s", guide.tilt_damping, any, "about y and z")
            .shown_in("N m s/rad");
      });
  return keys;
}

const Keys<GasSpec>& gas_keys() {
  static const Keys<GasSpec> keys(
      "gas", "pressure of the gas over the crank angle", [](auto& key, GasSpec& gas) {
        key.path("table", gas.table,
                 "CSV of the absolute pressure over the crank angle from firing TDC")
            .required();
        key.text("column", gas.column, "its column");
        interpolation_row(key, gas.interpolation);
        key.number("ambient_bar", gas.ambient, Range::between(0.0, 1e4),
                   "pressure behind the piston, absolute");
      });
  return keys;
}

const Keys<PistonSpec>& piston_keys() {
  static const Keys<PistonSpec> keys(
      "piston", "the piston, a reduced part", [](auto& key, PistonSpec& piston) {
        key.part(static_cast<BodySpec&>(piston), body_keys());
        key.text("pin", piston.pin, "set of the node of the pin, with 6 DoFs");
        key.text("skirt", piston.skirt, "contact grid of the skirt");
        key.text("gas_load", piston.gas_load, "unit load of the gas, per Pa; \"\": none");
      });
  return keys;
}

const Keys<CylinderTable>& cylinder_keys() {
  static const Keys<CylinderTable> keys(
      "cylinder", "one of several cylinders: with tables of its own over those of the scene",
      [](auto& key, CylinderTable& cylinder) {
        key.shared();
        name_row(key, cylinder.name).required();
        key.number("firing_deg", cylinder.firing, Range::between(-720.0, 720.0),
                   "crank angle of its firing TDC");
        key.flag("parked", cylinder.is_parked, "without piston, rod, gas and contact");
      });
  return keys;
}

const keys::Table& cylinder_table() {
  static const keys::Table table = [] {
    keys::Table all = cylinder_keys().table();
    all.complete_elsewhere();
    for (const auto& [name, of] : {std::pair{"engine", &stroke_keys().table()},
                                   {"rod", &rod_keys().table()},
                                   {"piston", &piston_keys().table()},
                                   {"block", &bore_keys().table()},
                                   {"gas", &gas_keys().table()},
                                   {"contact", &contact_keys().table()},
                                   {"small_end", &joint_table()},
                                   {"big_end", &joint_table()},
                                   {"pin_guide", &guide_keys().table()}})
      all.add(name, keys::Type::kTable, *of);
    return all;
  }();
  return table;
}

ComponentList read_cylinders(const Config& root) {
  const auto table = root.find_table("engine");
  if (!table) return {};
  const EngineTable engine = engine_keys().read(*table);
  const std::optional<CrankBody> crankshaft = read_crank_body(root);
  has_elastic_block(root);  // its keys are known, those of a [cylinder.block] are not
  if (!root.has("cylinder"))
    return {std::make_shared<CylinderComponent>(read_cylinder(root, engine, 0.0, crankshaft))};
  ComponentList cylinders;
  std::map<std::string, std::string> names;
  bool all_parked = true;
  for (const Config& one : root.tables("cylinder")) {
    const CylinderTable cylinder = cylinder_keys().read(one);
    check_new_name(one, "cylinder", cylinder.name, names);
    CylinderSpec spec = read_cylinder(one.with_fallback(root), engine, cylinder.firing, crankshaft);
    spec.name = cylinder.name;
    if (cylinder.is_parked) {
      cylinders.push_back(std::make_shared<ParkedCylinder>(cylinder.name));
      continue;
    }
    all_parked = false;
    cylinders.push_back(std::make_shared<CylinderComponent>(std::move(spec)));
  }
  if (all_parked) root.fail("cylinder", "found all of them parked, expected one that is not");
  return cylinders;
}

}  // namespace clatter::dynamics
