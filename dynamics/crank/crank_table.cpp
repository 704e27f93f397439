// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <numbers>
#include <set>
#include <utility>

#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/crank_keys.hpp"
#include "dynamics/crank/crank_spec.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]
const Range kPosition = Range::between(-1e6, 1e6), kDampingRange = Range::between(0.0, 1e15);
const Range kTorque = Range::between(-1e9, 1e9);

JournalFilmOptions read_film(const Config& table) {
  JournalFilmOptions film;
  film.size = read_bearing_size(table);
  film.cells_around = static_cast<int>(
      table.integer_or("cells_around", film.cells_around, Range::between(12, 2000)));
  film.cells_along =
      static_cast<int>(table.integer_or("cells_along", film.cells_along, Range::between(2, 200)));
  film.groove = table.number_or("groove_deg", 0.0, Range::between(-360.0, 360.0)) * kDegree;
  film.supply_pressure =
      table.number_or("supply_bar", film.supply_pressure * 1e-5, Range::between(0.0, 1e3)) * 1e5;
  film.bulk_modulus =
      table.number_or("bulk_modulus_mpa", film.bulk_modulus * 1e-6, Range::between(0.0, 1e6)) * 1e6;
  film.cavitation = table.flag_or("cavitation", film.cavitation);
  return film;
}

CrankBearingSpec read_crank_bearing(const Config& table, bool on_block) {
  CrankBearingSpec bearing;
  bearing.name = read_name(table);
  bearing.where = table.where();
  if (on_block) {
    if (!table.has("set"))
      table.fail("set", "found nothing, expected a set of the block, on which the bearing acts");
    bearing.set = table.text("set");
  } else if (table.has("set")) {
    // A rigid block is the ground and has no sets: the key may be that of a base scene.
    static_cast<void>(table.text("set"));
  }
  if (table.has("at_mm")) bearing.at = table.number("at_mm", kPosition) * kMilli;
  if (!on_block && !bearing.at)
    table.fail("at_mm", "found nothing, expected the bearing's x: there is no elastic block");
  const std::string model =
      table.choice("model", {"linear", "table", "butenschoen", "moes", "film"});
  if (model == "linear") {
    bearing.law = LinearBearingSpec{table.number("stiffness_n_m", Range::between(1e-3, 1e20)),
                                    table.number_or("damping_n_s_m", 0.0, kDampingRange)};
  } else if (model == "table") {
    bearing.law = TableBearingSpec{table.path("table"), table.text_or("column", ""),
                                   table.number_or("damping_n_s_m", 0.0, kDampingRange)};
  } else if (model == "film") {
    bearing.law = read_film(table);
  } else {
    bearing.law = ImpedanceSpec{read_bearing_size(table),
                                model == "moes" ? BearingModel::kMoes : BearingModel::kButenschoen};
  }
  return bearing;
}

CrankLoadSpec read_crank_load(const Config& table, const CrankClock& clock) {
  CrankLoadSpec load;
  const std::string law = table.choice("law", {"mean", "constant", "speed", "table"});
  if (law == "table") {
    load.law = CrankLoadSpec::Law::kTable;
    load.table = table.path("table");
    load.column = table.text_or("column", "");
    load.interpolation = read_interpolation(table, "cubic");
    return load;
  }
  if (law == "mean") {
    load.torque = table.number_or("torque_n_m", 0.0, kTorque);
    return load;
  }
  load.torque = table.number("torque_n_m", kTorque);
  load.law = law == "constant" ? CrankLoadSpec::Law::kConstant : CrankLoadSpec::Law::kSpeed;
  if (law == "speed")
    load.at_speed =
        table.number_or("at_speed_rpm", clock.speed / kRpm, Range::between(0.01, 1e6)) * kRpm;
  return load;
}

}  // namespace

std::optional<CrankSpec> read_crankshaft(const Config& root) {
  const auto table = root.find_table("crank");
  if (!table) return std::nullopt;
  const Config engine = root.table("engine");
  CrankSpec crank;
  crank.body = *read_crank_body(root);
  crank.clock = read_crank_clock(engine);
  if (engine.choice("rotation", {"forward", "backward"}) == "backward")
    crank.rotation = Rotation::kBackward;
  const auto block = root.find_table("block");
  const bool on_block = block && block->choice("model", {"elastic", "rigid"}) == "elastic";
  std::set<std::string> names;
  for (const Config& one : table->tables("bearing")) {
    crank.bearings.push_back(read_crank_bearing(one, on_block));
    if (!names.insert(crank.bearings.back().name).second)
      one.fail("name", fmt::format("found a second \"{}\", expected each name once",
                                   crank.bearings.back().name));
  }
  if (table->has("unbalance") && !crank.body.in_bearings)
    table->fail("unbalance", "found without [[crank.bearing]], which it loads");
  for (const Config& one : table->tables("unbalance"))
    crank.unbalances.push_back(
        {one.number("at_mm", kPosition) * kMilli,
         one.number("moment_kg_m", Range::between(0.0, 1e6)),
         one.number_or("angle_deg", 0.0, Range::between(-720.0, 720.0)) * kDegree});
  const auto load = table->find_table("load");
  if (load && !crank.body.is_free)
    table->fail("load",
                "found with a prescribed speed, whose torque follows from it, expected "
                "speed = \"free\"");
  if (load) crank.load = read_crank_load(*load, crank.clock);
  return crank;
}

}  // namespace clatter::dynamics
