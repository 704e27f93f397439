// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a scene says of a cylinder; values are SI.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/body/crank_body.hpp"
#include "dynamics/body/rigid_rod.hpp"
#include "dynamics/component/block_table.hpp"
#include "dynamics/component/engine_table.hpp"
#include "dynamics/cylinder/joint_spec.hpp"
#include "dynamics/cylinder/rod_spec.hpp"
#include "dynamics/cylinder/shape_scale.hpp"
#include "dynamics/element/pin_guide.hpp"
#include "dynamics/film/piston_liner_options.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/ring/ring_law.hpp"

namespace clatter::dynamics {

/// [engine] and [rod].
struct EngineSpec : StrokeSpec {
  CrankClock clock;
  RodProperties rod;
  double firing = 0.0;                // angle of the crankshaft at this cylinder's firing TDC [rad]
  std::filesystem::path speed_table;  // of the clock; empty: it has none

  SliderCrank crank() const {
    return SliderCrank(0.5 * stroke, rod.length, pin_offset, clock, firing, rotation);
  }
};

/// [gas]: pressure over the crank angle from the cylinder's firing TDC.
struct GasSpec {
  std::filesystem::path table;
  std::string column = "pressure";
  Spline::Kind interpolation = Spline::Kind::kMonotoneCubic;
  double ambient = 1e5;  // subtracted from the table's absolute pressure [Pa]
};

/// [piston].
struct PistonSpec : BodySpec {
  std::string pin = "pin";       // set of the pin's node, 6 DoFs
  std::string skirt = "skirt";   // contact grid
  std::string gas_load = "gas";  // unit load, per Pa; empty: none
};

/// A cylinder with piston, rod and joints; absent tables: none of it.
struct CylinderSpec {
  std::string name;  // empty: the only one of its scene
  EngineSpec engine;
  RodSpec rod;
  PistonSpec piston;
  std::optional<BoreSpec> bore;  // of a scene with a block, which may be rigid
  std::optional<GasSpec> gas;
  std::optional<film::PistonLinerOptions> contact;
  std::vector<RingSpec> rings;  // [[contact.ring]]
  std::vector<ScaledShapeSpec> scaled_bore, scaled_skirt;
  std::vector<std::filesystem::path> shape_files;  // of [[contact.bore_shape]], skirt_shape
  std::string contact_where;                       // "file:line: contact", for messages
  JointSpec small_end, big_end;
  GuideLaw guide;                       // [pin_guide]
  std::optional<CrankBody> crankshaft;  // [crank]; absent: it turns ideally and has no mass
  bool has_free_crank() const { return crankshaft && crankshaft->is_free; }

  /// The name of one of its bodies, elements or histories in files: "piston", or of a named
  /// cylinder "c1_piston".
  std::string name_of(const std::string& what) const {
    return name.empty() ? what : name + "_" + what;
  }
};

}  // namespace clatter::dynamics
