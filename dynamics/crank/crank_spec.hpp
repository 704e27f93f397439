// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a scene says of its crankshaft; values are SI.
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/base/config.hpp"
#include "core/keys/table.hpp"
#include "dynamics/bearing/bearing_film.hpp"
#include "dynamics/bearing/journal_film.hpp"
#include "dynamics/body/crank_body.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// model = "linear".
struct LinearBearingSpec {
  double stiffness = 0.0, damping = 0.0;  // [N/m], [N s/m]
};

/// model = "table".
struct TableBearingSpec {
  std::filesystem::path table;
  std::string column;
  double damping = 0.0;  // [N s/m]
};

/// model = "butenschoen" | "moes".
struct ImpedanceSpec {
  BearingSize size;
  BearingModel model = BearingModel::kButenschoen;
};

/// One [[crank.bearing]].
struct CrankBearingSpec {
  std::string name, where;
  std::string set;           // of the block; empty: there is none
  std::optional<double> at;  // x [m]; else that of the set
  std::variant<LinearBearingSpec, TableBearingSpec, ImpedanceSpec, JournalFilmOptions> law;
  bool has_film() const { return std::holds_alternative<JournalFilmOptions>(law); }
};

/// One [[crank.unbalance]]: a mass beside the axis, part of the crankshaft's.
struct UnbalanceSpec {
  double at = 0.0;      // x [m]
  double moment = 0.0;  // mass times distance from the axis [kg m]
  double angle = 0.0;   // from the direction of +z at crank angle 0, about +x [rad]
};

/// [crank.load].
struct CrankLoadSpec {
  enum class Law { kMean, kConstant, kSpeed, kTable };
  Law law = Law::kMean;
  double torque = 0.0;    // [N m]; of kMean in the first cycle
  double at_speed = 0.0;  // of kSpeed [rad/s]
  std::filesystem::path table;
  std::string column;
  Spline::Kind interpolation = Spline::Kind::kMonotoneCubic;
};

/// [crank] with the clock and direction of its engine.
struct CrankSpec {
  CrankBody body;
  CrankClock clock;
  Rotation rotation = Rotation::kForward;
  std::vector<CrankBearingSpec> bearings;
  std::vector<UnbalanceSpec> unbalances;
  CrankLoadSpec load;  // of a free one
};

/// The crankshaft of the scene `root`, none without [crank]. InputError for keys that do not belong
/// to its bearings and speed.
std::optional<CrankSpec> read_crankshaft(const Config& root);
/// The keys of [crank].
const keys::Table& crank_table();

}  // namespace clatter::dynamics
