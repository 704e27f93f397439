// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>

#include "dynamics/component/block_table.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/component/crank_keys.hpp"
#include "dynamics/component/engine_table.hpp"
#include "dynamics/crank/crank_spec.hpp"
#include "dynamics/shaft/shaft_spec.hpp"

namespace clatter::dynamics {
namespace {

/// A bearing by the keys of all laws, of which `model` says the one that holds.
struct CrankBearingTable : CrankBearingSpec {
  enum class Model : char { kLinear, kTable, kButenschoen, kMoes, kFilm };
  Model model = Model::kLinear;
  double stiffness = 0.0, damping = 0.0;  // [N/m], [N s/m]
  std::filesystem::path table;
  std::string column;
  JournalFilmOptions film;
};

void choose_law(const Config& table, CrankBearingTable& bearing) {
  using Model = CrankBearingTable::Model;
  switch (bearing.model) {
    case Model::kLinear:
      bearing.law = LinearBearingSpec{bearing.stiffness, bearing.damping};
      return;
    case Model::kTable:
      bearing.law = TableBearingSpec{bearing.table, bearing.column, bearing.damping};
      return;
    case Model::kFilm:
      bearing.law = bearing.film;
      break;
    case Model::kMoes:
      bearing.law = ImpedanceSpec{bearing.film.size, BearingModel::kMoes};
      break;
    case Model::kButenschoen:
      bearing.law = ImpedanceSpec{bearing.film.size, BearingModel::kButenschoen};
      break;
  }
  check_bearing_width(table, bearing.film.size);
}

const Keys<CrankBearingTable>& crank_bearing_keys() {
  using Model = CrankBearingTable::Model;
  static const Keys<CrankBearingTable> keys(
      "bearing", "a main bearing", [](auto& key, CrankBearingTable& bearing) {
        JournalFilmOptions& film = bearing.film;
        key.where(bearing.where);
        name_row(key, bearing.name).required();
        key.text("set", bearing.set, "set of an elastic block on which it acts, on the crank axis");
        key.number("at_mm", bearing.at, kPositionMm, "its x; without it that of the set");
        key.choice("model", bearing.model,
                   {{"linear", Model::kLinear},
                    {"table", Model::kTable},
                    {"butenschoen", Model::kButenschoen},
                    {"moes", Model::kMoes},
                    {"film", Model::kFilm}},
                   "a spring, a table, an oil film by one of two formulas or on a grid");
        key.number("stiffness_n_m", bearing.stiffness, Range::between(1e-3, 1e20), "of the spring")
            .of("model", "linear");
        key.path("table", bearing.table,
                 "CSV of the radial force [N] or [kN] over the eccentricity [um], which rises from "
                 "0 at 0")
            .of("model", "table");
        key.text("column", bearing.column, "column of the table; without it the second one")
            .needs("table");
        key.number("damping_n_s_m", bearing.damping, kAnyDamping, "of spring and table")
            .needs("model", {"linear", "table"});
        bearing_size_rows(key, film.size, {"butenschoen", "moes", "film"});
        key.all_need("model", "film", "", [&] {
          key.integer("cells_around", film.cells_around, Range::between(12.0, 2000.0),
                      "cells of the grid around");
          key.integer("cells_along", film.cells_along, Range::between(2.0, 200.0),
                      "cells of the grid along half of the width");
          key.number("groove_deg", film.groove, Range::between(-360.0, 360.0),
                     "angle of the supply groove from +z about +x");
          key.number("supply_bar", film.supply_pressure, Range::between(0.0, 1e3),
                     "pressure of the oil in the groove over that at the ends");
          key.number("bulk_modulus_mpa", film.bulk_modulus, Range::between(0.0, 1e6),
                     "bulk modulus of the oil; 0: incompressible");
          key.flag("cavitation", film.cavitation,
                   "the film ruptures, with conservation of mass; else it is full everywhere");
        });
        key.check(choose_law);
      });
  return keys;
}

const Keys<UnbalanceSpec>& unbalance_keys() {
  static const Keys<UnbalanceSpec> keys(
      "unbalance", "a mass beside the axis, part of the crankshaft's",
      [](auto& key, UnbalanceSpec& unbalance) {
        key.number("at_mm", unbalance.at, kPositionMm, "its x").required();
        key.number("moment_kg_m", unbalance.moment, Range::between(0.0, 1e6),
                   "mass times distance from the axis")
            .required();
        key.number("angle_deg", unbalance.angle, Range::between(-720.0, 720.0),
                   "from +z at crank angle 0, about +x");
      });
  return keys;
}

const Keys<CrankLoadSpec>& crank_load_keys() {
  using Law = CrankLoadSpec::Law;
  static const Keys<CrankLoadSpec> keys(
      "load", "the torque against a free crank", [](auto& key, CrankLoadSpec& load) {
        key.choice("law", load.law,
                   {{"mean", Law::kMean},
                    {"constant", Law::kConstant},
                    {"speed", Law::kSpeed},
                    {"table", Law::kTable}},
                   "what keeps the mean speed, a constant, by the square of the speed, or a table");
        key.number("torque_n_m", load.torque, Range::between(-1e9, 1e9),
                   "the torque; of the mean in the first cycle, 0 without it")
            .shown_in("N m")
            .needs("law", {"mean", "constant", "speed"})
            .required_with("law", {"constant", "speed"});
        key.number("at_speed_rpm", load.at_speed, Range::between(0.01, 1e6),
                   "speed at which it is torque_n_m; that of the engine without it")
            .needs("law", "speed");
        key.path("table", load.table, "CSV of the torque over the crank angle").of("law", "table");
        key.text("column", load.column, "column of the table; without it the second one")
            .needs("table");
        interpolation_row(key, load.interpolation).needs("table");
      });
  return keys;
}

struct CrankTable : CrankSpec {
  std::vector<CrankBearingTable> described;
};

const Keys<CrankTable>& crank_keys() {
  static const Keys<CrankTable> keys(
      "crank", "the crankshaft as a body in main bearings, its rotation prescribed or free",
      [](auto& key, CrankTable& crank) {
        key.part(crank.body, crank_body_keys());
        key.tables("bearing", crank.described, crank_bearing_keys());
        key.tables("unbalance", crank.unbalances, unbalance_keys()).needs("bearing");
        key.table("load", crank.load, crank_load_keys())
            .needs("speed", "free", "with a prescribed speed the torque is a result");
      });
  return keys;
}

void check_bearings(const Config& crank, const std::vector<CrankBearingSpec>& bearings,
                    bool on_block) {
  const std::vector<Config> tables = crank.tables("bearing");
  std::map<std::string, std::string> names;
  for (size_t k = 0; k < bearings.size(); ++k) {
    check_new_name(tables[k], "bearing", bearings[k].name, names);
    if (on_block && bearings[k].set.empty())
      tables[k].fail("set",
                     "found nothing, expected a set of the block, on which the bearing acts");
    if (!on_block && !bearings[k].at)
      tables[k].fail("at_mm", "found nothing, expected the bearing's x: there is no elastic block");
  }
}

}  // namespace

const keys::Table& crank_table() { return crank_keys().table(); }

std::optional<CrankSpec> read_crankshaft(const Config& root) {
  const auto table = root.find_table("crank");
  if (!table) return std::nullopt;
  CrankTable found = crank_keys().read(*table);
  CrankSpec crank = found;
  crank.bearings.assign(found.described.begin(), found.described.end());
  const bool on_block = has_elastic_block(root);
  check_bearings(*table, crank.bearings, on_block);
  // A rigid block is the ground and has no sets: the key may be that of a base scene.
  if (!on_block)
    for (CrankBearingSpec& bearing : crank.bearings) bearing.set.clear();
  const EngineTable engine = engine_keys().read(root.table("engine"));
  crank.clock = engine.clock;
  crank.rotation = engine.stroke.rotation;
  if (crank.load.at_speed == 0.0) crank.load.at_speed = crank.clock.speed;
  return crank;
}

}  // namespace clatter::dynamics
