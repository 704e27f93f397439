// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of cylinders.
#include <fmt/format.h>

#include <numbers>
#include <set>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/crank_keys.hpp"
#include "dynamics/cylinder/contact_table.hpp"
#include "dynamics/cylinder/cylinder_component.hpp"
#include "dynamics/cylinder/parked_cylinder.hpp"
#include "dynamics/cylinder/ring_table.hpp"
#include "dynamics/cylinder/rod_table.hpp"
#include "dynamics/cylinder/shape_table.hpp"

namespace clatter::dynamics {
namespace {

/// @param tables of the cylinder.
EngineSpec read_engine(const Config& tables, const CrankClock& clock, double firing,
                       const RodProperties& rod) {
  const Config table = tables.table("engine");
  EngineSpec engine;
  engine.clock = clock;
  engine.firing = firing;
  if (table.has("speed_table")) engine.speed_table = table.path("speed_table");
  engine.stroke = table.number("stroke_mm", Range::between(0.1, 1e4)) * kMilli;
  engine.pin_offset = table.number_or("pin_offset_mm", 0.0, Range::between(-1e4, 1e4)) * kMilli;
  engine.balanced = table.flag_or("balanced", false);
  if (table.choice("rotation", {"forward", "backward"}) == "backward")
    engine.rotation = Rotation::kBackward;
  engine.rod = rod;
  const bool by_offset = engine.rod.length > 0.5 * engine.stroke;
  with_context(by_offset ? table.where("pin_offset_mm") : tables.table("rod").where("length_mm"),
               [&] { engine.crank(); });
  return engine;
}

GuideLaw read_guide(const Config& tables) {
  GuideLaw guide;
  const auto table = tables.find_table("pin_guide");
  if (!table) return guide;
  const Range any = Range::between(0.0, 1e15);
  guide.axial_stiffness = table->number_or("axial_stiffness_n_m", guide.axial_stiffness, any);
  guide.axial_damping = table->number_or("axial_damping_n_s_m", guide.axial_damping, any);
  guide.tilt_stiffness = table->number_or("tilt_stiffness_n_m", guide.tilt_stiffness, any);
  guide.tilt_damping = table->number_or("tilt_damping_n_m_s", guide.tilt_damping, any);
  return guide;
}

GasSpec read_gas(const Config& table) {
  GasSpec gas;
  gas.table = table.path("table");
  gas.column = table.text_or("column", "pressure");
  gas.interpolation = read_interpolation(table, "cubic");
  gas.ambient = table.number_or("ambient_bar", 1.0, Range::between(0.0, 1e4)) * 1e5;
  return gas;
}

PistonSpec read_piston(const Config& table) {
  PistonSpec piston;
  read_body(table, "piston", piston);
  piston.pin = table.text_or("pin", piston.pin);
  piston.skirt = table.text_or("skirt", piston.skirt);
  piston.gas_load = table.text_or("gas_load", piston.gas_load);
  return piston;
}

BoreSpec read_bore(const Config& table) {
  BoreSpec bore;
  bore.liner = table.text_or("liner", bore.liner);
  bore.liner_axial = table.text_or("liner_axial", "");
  bore.bearings = table.texts_or("bearings", {});
  bore.gas_load = table.text_or("gas_load", "");
  return bore;
}

/// @param tables of the cylinder: the scene's own, or those of a [[cylinder]] over them.
CylinderSpec read_cylinder(const Config& tables, const CrankClock& clock, double firing,
                           const std::optional<CrankBody>& crankshaft) {
  const auto piston = tables.find_table("piston");
  if (!piston) tables.fail("piston", "found nothing, expected [piston]");
  CylinderSpec cylinder;
  cylinder.crankshaft = crankshaft;
  const DescribedRod rod = read_rod(tables.table("rod"));
  cylinder.rod = rod.spec;
  cylinder.engine = read_engine(tables, clock, firing, rod.properties);
  cylinder.piston = read_piston(*piston);
  if (const auto table = tables.find_table("block")) cylinder.bore = read_bore(*table);
  if (const auto table = tables.find_table("gas")) cylinder.gas = read_gas(*table);
  if (const auto table = tables.find_table("contact")) {
    cylinder.contact = read_contact(*table);
    cylinder.rings = read_rings(*table, *cylinder.contact);
    for (const auto& [key, shapes, scaled] :
         {std::tuple{"bore_shape", &cylinder.contact->bore_shapes, &cylinder.scaled_bore},
          {"skirt_shape", &cylinder.contact->skirt_shapes, &cylinder.scaled_skirt}}) {
      SurfaceShapes found = read_surface_shapes(*table, key);
      *shapes = std::move(found.shapes);
      *scaled = std::move(found.scaled);
      cylinder.shape_files.insert(cylinder.shape_files.end(), found.files.begin(),
                                  found.files.end());
    }
  }
  cylinder.contact_where = tables.where("contact");
  cylinder.pin_offset_where = tables.table("engine").where("pin_offset_mm");
  cylinder.small_end = read_joint(tables, "small_end");
  cylinder.big_end = read_joint(tables, "big_end");
  if (cylinder.rod.model == RodModel::kMassless && cylinder.has_free_crank())
    tables.table("rod").fail("model",
                             "found \"massless\" with crank.speed = \"free\", expected a "
                             "rod with mass");
  for (const auto& [key, joint] :
       {std::pair{"small_end", &cylinder.small_end}, {"big_end", &cylinder.big_end}}) {
    if (cylinder.rod.model == RodModel::kMassless && (joint->friction || joint->film))
      tables.fail(key,
                  "found friction or an oil film with rod.model = \"massless\", expected "
                  "neither: such a rod bears no moment");
  }
  cylinder.guide = read_guide(tables);
  return cylinder;
}

}  // namespace

ComponentList read_cylinders(const Config& root) {
  const auto engine = root.find_table("engine");
  if (!engine) return {};
  const CrankClock clock = read_crank_clock(*engine);
  const std::optional<CrankBody> crankshaft = read_crank_body(root);
  if (!root.has("cylinder"))
    return {std::make_shared<CylinderComponent>(read_cylinder(root, clock, 0.0, crankshaft))};
  ComponentList cylinders;
  std::set<std::string> names;
  bool all_parked = true;
  for (const Config& table : root.tables("cylinder")) {
    const std::string name = read_name(table);
    if (!names.insert(name).second)
      table.fail("name", fmt::format("found a second \"{}\", expected each name once", name));
    const double firing = table.number_or("firing_deg", 0.0, Range::between(-720.0, 720.0));
    CylinderSpec spec =
        read_cylinder(table.with_fallback(root), clock, firing * kDegree, crankshaft);
    spec.name = name;
    if (table.flag_or("parked", false)) {
      cylinders.push_back(std::make_shared<ParkedCylinder>(name));
      continue;
    }
    all_parked = false;
    cylinders.push_back(std::make_shared<CylinderComponent>(std::move(spec)));
  }
  if (all_parked) root.fail("cylinder", "found all of them parked, expected one that is not");
  return cylinders;
}

}  // namespace clatter::dynamics
