// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The table [engine] of a scene: clock of the crank, stroke and pin of its cylinders.
#include <filesystem>
#include <string>

#include "core/keys/keys.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// What cylinders may have of their own, [cylinder.engine].
struct StrokeSpec {
  double stroke = 0.0;      // [m]
  double pin_offset = 0.0;  // of the pin from the bore's axis toward the thrust side [m]
  /// The block's rigid modes get no resultant, neither force nor moment, of this cylinder's inertia
  /// forces; its elastic modes get them all (balance.hpp).
  bool balanced = false;
  Rotation rotation = Rotation::kForward;
  std::string pin_offset_where;  // "file:line: engine.pin_offset_mm"
};
const keys::Keys<StrokeSpec>& stroke_keys();

/// [engine].
struct EngineTable {
  CrankClock clock;
  std::filesystem::path speed_table;  // of the clock; empty: it has none
  std::string speed_column;
  StrokeSpec stroke;
};
const keys::Keys<EngineTable>& engine_keys();

}  // namespace clatter::dynamics
