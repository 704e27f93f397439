// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Contents of a scene (stem.run.toml). dynamics/README.md documents the file; values here are SI.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/body/rigid_rod.hpp"
#include "dynamics/film/piston_liner_options.hpp"
#include "dynamics/force/pin_guide.hpp"
#include "dynamics/force/radial_law.hpp"
#include "dynamics/given/spline.hpp"
#include "dynamics/integrate/integrator.hpp"

namespace clatter::dynamics {

/// A body with a reduced model: [piston], [block], [[body]].
struct BodySpec {
  std::string name;
  std::filesystem::path rom;
  bool elastic = true;         // model = "elastic" | "rigid"
  double mode_limit_hz = 0.0;  // inertia of higher modes is dropped; 0: never
  /// Scales of the error test for this body; 0: those of [accuracy].
  double displacement_scale = 0.0, velocity_scale = 0.0;  // [m], [m/s]
  std::string where;                                      // "file:line", for messages
};

/// [engine] and [rod].
struct EngineSpec {
  double speed = 0.0;       // omega [rad/s]
  double stroke = 0.0;      // [m]
  double pin_offset = 0.0;  // of the pin from the bore's axis toward the thrust side [m]
  /// The block's rigid modes get no resultant, neither force nor moment, of this cylinder's inertia
  /// forces; its elastic modes get them all (balance.hpp).
  bool balanced = false;
  RodProperties rod;
};

/// [gas]: pressure over the crank angle.
struct GasSpec {
  std::filesystem::path table;
  std::string column;
  Spline::Kind interpolation = Spline::Kind::kMonotoneCubic;
  double ambient = 1e5;  // subtracted from the table's absolute pressure [Pa]
};

/// [piston].
struct PistonSpec : BodySpec {
  std::string pin = "pin";       // set of the pin's node, 6 DoFs
  std::string skirt = "skirt";   // contact grid
  std::string gas_load = "gas";  // unit load, per Pa; empty: none
};

/// [block]; a rigid block is not simulated.
struct BlockSpec : BodySpec {
  std::string liner = "liner";        // contact grid of the bore
  std::string liner_axial;            // set of its mean axial displacement; empty: rigid frame
  std::vector<std::string> bearings;  // main bearings next to the crank; empty: rigid frame
  std::string gas_load;               // unit load on the head, per Pa; empty: none
};

/// [[mount]]: springs and dampers between nodes of a body and the ground.
struct MountSpec {
  std::string body, where;
  std::vector<std::string> sets;
  std::vector<double> stiffness;  // x, y, z [N/m]
  std::vector<double> damping;    // x, y, z [N s/m]
};

/// [[load]]: a force on a body: a unit load of its reduced model, or one coordinate of a set.
struct LoadSpec {
  std::string body, where;
  std::string load;             // name among the model's loads, or:
  std::string set;              // a set of the model
  int component = 0;            // 0..5: x, y, z, rx, ry, rz
  double scale = 1.0;           // factor, or the constant value when there is no table
  std::filesystem::path table;  // over time [s], or over the crank angle in an engine scene
  std::string column, unit;
  Spline::Kind interpolation = Spline::Kind::kLinear;
};

/// [time] and [output].
struct TimeSpec {
  int cycles = 2;                 // engine scenes; the last one is reported
  double begin = 0.0, end = 0.0;  // [s]; engine scenes: 0 = FTDC of the reported cycle
  double ramp = 0.0;              // loads grow from zero over this time at the start [s]
  double output_step = 2e-5;      // as requested; it is adjusted to the span [s]
  std::string output_step_where, film_every_where;  // "file:line: key", for messages
};

struct Scene {
  std::filesystem::path file;
  std::vector<std::filesystem::path> inputs;  // every file that the scene reads, itself first
  std::string title, resolved;
  TimeSpec time;
  StepOptions steps;
  double film_every = 0.0;  // between stored film fields [s]; 0: none
  double gravity = 0.0;     // along -z [m/s2]
  std::optional<EngineSpec> engine;
  std::optional<PistonSpec> piston;
  std::optional<BlockSpec> block;
  std::optional<GasSpec> gas;
  std::optional<film::PistonLinerOptions> contact;
  std::string contact_where;     // "file:line: contact", for messages
  std::string pin_offset_where;  // "file:line: engine.pin_offset_mm"
  RadialLaw small_end, big_end;
  GuideLaw guide;                // [pin_guide]
  std::vector<BodySpec> bodies;  // [[body]]
  std::vector<MountSpec> mounts;
  std::vector<LoadSpec> loads;
};

/// Reads and checks a scene; InputError "file:line: key: found ..., expected ...".
Scene read_scene(const std::filesystem::path& path);
Scene read_scene(const Config& config, const std::filesystem::path& path);

}  // namespace clatter::dynamics
