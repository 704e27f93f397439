// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/scene/contact_table.hpp"
#include "dynamics/scene/time_table.hpp"

namespace clatter::dynamics {
namespace {

// Ranges, here and in the other tables, are those of any machine, from model engines to ship
// diesels, with a wide margin: a value outside is a slip of unit or sign. They also keep products
// and powers of values finite.

Spline::Kind interpolation(const Config& table, std::string_view fallback) {
  const bool linear_first = fallback == "linear";
  const std::string kind = linear_first ? table.choice("interpolation", {"linear", "cubic"})
                                        : table.choice("interpolation", {"cubic", "linear"});
  return kind == "linear" ? Spline::Kind::kLinear : Spline::Kind::kMonotoneCubic;
}

void read_body(const Config& table, const std::string& name, BodySpec& body) {
  body.name = name;
  body.rom = table.path("rom");
  body.elastic = table.choice("model", {"elastic", "rigid"}) == "elastic";
  body.mode_limit_hz = table.number_or("mode_limit_hz", 0.0, Range::between(0.0, 1e9));
  if (table.has("displacement_um"))
    body.displacement_scale = table.number("displacement_um", kDisplacementScaleUm) * kMicro;
  if (table.has("velocity_m_s")) body.velocity_scale = table.number("velocity_m_s", kVelocityScale);
  body.where = table.where();
}

void read_rod(const Config& rod, RodProperties& out) {
  out.length = rod.number("length_mm", Range::between(1.0, 1e5)) * kMilli;
  out.mass = rod.number("mass_kg", Range::between(1e-6, 1e6));
  // Beyond these the radius of gyration is over the length, or under a thousandth of it.
  const double largest = out.mass * out.length * out.length;
  out.inertia = rod.number("inertia_kg_m2", Range::positive());
  if (!(out.inertia >= 1e-6 * largest && out.inertia <= largest))
    rod.fail("inertia_kg_m2",
             fmt::format("found {:g}, expected at least {:.3g} and at most {:.3g}, mass x length^2",
                         out.inertia, 1e-6 * largest, largest));
  out.centre = rod.number("centre_mm", Range::between(0.0, out.length / kMilli)) * kMilli;
}

/// The name of a [[body]]: a group of the run file, and different from the engine's own bodies.
std::string body_name(const Config& table, const Scene& scene) {
  const std::string name = table.text("name");
  if (name.empty() || name == "." || name.find('/') != std::string::npos)
    table.fail("name", fmt::format("found \"{}\", expected a name without /", name));
  if (scene.engine && name == "rod")
    table.fail("name", "found \"rod\", which is the rod of [rod]: expected another name");
  return name;
}

EngineSpec read_engine(const Config& root) {
  const Config table = root.table("engine");
  EngineSpec engine;
  engine.speed = table.number("speed_rpm", Range::between(0.01, 1e5)) * std::numbers::pi / 30.0;
  engine.stroke = table.number("stroke_mm", Range::between(0.1, 1e4)) * kMilli;
  engine.pin_offset = table.number_or("pin_offset_mm", 0.0, Range::between(-1e4, 1e4)) * kMilli;
  engine.balanced = table.flag_or("balanced", false);
  const Config rod = root.table("rod");
  read_rod(rod, engine.rod);
  const bool by_offset = engine.rod.length > 0.5 * engine.stroke;
  with_context(by_offset ? table.where("pin_offset_mm") : rod.where("length_mm"), [&] {
    SliderCrank(0.5 * engine.stroke, engine.rod.length, engine.pin_offset, engine.speed);
  });
  return engine;
}

RadialLaw read_law(const Config& root, std::string_view key) {
  RadialLaw law;
  const auto table = root.find_table(key);
  if (!table) return law;
  law.clearance =
      table->number_or("clearance_um", law.clearance / kMicro, Range::between(0.0, 1e5)) * kMicro;
  law.soft_stiffness =
      table->number_or("soft_stiffness_n_m", law.soft_stiffness, Range::between(0.0, 1e15));
  law.exponent = table->number_or("exponent", law.exponent, Range{1.0, 3.0, false});
  law.stiffness = table->number_or("stiffness", law.stiffness, Range::between(1.0, 1e27));
  law.damping = table->number_or("damping_n_s_m", law.damping, Range::between(0.0, 1e12));
  return law;
}

GuideLaw read_guide(const Config& root) {
  GuideLaw guide;
  const auto table = root.find_table("pin_guide");
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
  gas.interpolation = interpolation(table, "cubic");
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

BlockSpec read_block(const Config& table) {
  BlockSpec block;
  read_body(table, "block", block);
  block.liner = table.text_or("liner", block.liner);
  block.liner_axial = table.text_or("liner_axial", "");
  block.bearings = table.texts_or("bearings", {});
  block.gas_load = table.text_or("gas_load", "");
  return block;
}

MountSpec read_mount(const Config& table) {
  MountSpec mount;
  mount.where = table.where();
  mount.body = table.text_or("body", "block");
  mount.sets = table.texts("sets");
  if (mount.sets.empty()) table.fail("sets", "found none, expected names of sets of the body");
  mount.stiffness = table.numbers("stiffness_n_m", 3);
  mount.damping =
      table.has("damping_n_s_m") ? table.numbers("damping_n_s_m", 3) : std::vector<double>(3, 0.0);
  bool acts = false;
  const auto check = [&](const char* key, const std::vector<double>& values) {
    for (const double value : values) {
      if (!(value >= 0.0 && value <= 1e15))
        table.fail(key, fmt::format("found {}, expected at least 0 and at most 1e+15", value));
      acts = acts || value > 0.0;
    }
  };
  check("stiffness_n_m", mount.stiffness);
  check("damping_n_s_m", mount.damping);
  if (!acts)
    table.fail("stiffness_n_m", "found 0 everywhere, expected a stiffness or damping above 0");
  return mount;
}

LoadSpec read_load(const Config& table) {
  static constexpr std::string_view kComponents[] = {"x", "y", "z", "rx", "ry", "rz"};
  const Range factor = Range::between(-1e15, 1e15);
  LoadSpec load;
  load.where = table.where();
  load.body = table.text("body");
  if (table.has("load")) {
    load.load = table.text("load");
  } else {
    load.set = table.text("set");
    const auto name = table.choice("component", {"x", "y", "z", "rx", "ry", "rz"});
    load.component = static_cast<int>(
        std::find(std::begin(kComponents), std::end(kComponents), name) - std::begin(kComponents));
  }
  if (table.has("table")) {
    load.table = table.path("table");
    load.column = table.text_or("column", "");
    load.unit = table.text_or("unit", load.component < 3 ? "N" : "N m");
    load.interpolation = interpolation(table, "linear");
    load.scale = table.number_or("scale", 1.0, factor);
  } else {
    load.scale = table.number("value", factor);
  }
  return load;
}

void check_engine(const Config& root, const Scene& scene) {
  for (const char* key : {"piston", "block", "gas", "contact", "rod"}) {
    if (!scene.engine && root.has(key)) {
      root.fail(key, "found without [engine], expected [engine] with speed and stroke");
    }
  }
  if (scene.engine && !scene.piston) root.fail("piston", "found nothing, expected [piston]");
  if (!scene.engine && scene.bodies.empty()) {
    root.fail("body", "found no body, expected [engine] with [piston], or [[body]]");
  }
}

void list_inputs(const Config& root, Scene& scene) {
  scene.inputs = root.files();
  const auto add = [&](const std::filesystem::path& path) {
    if (path.empty()) return;
    if (std::find(scene.inputs.begin(), scene.inputs.end(), path) == scene.inputs.end()) {
      scene.inputs.push_back(path);
    }
  };
  if (scene.piston) add(scene.piston->rom);
  if (scene.block && scene.block->elastic) add(scene.block->rom);
  for (const auto& body : scene.bodies) add(body.rom);
  if (scene.gas) add(scene.gas->table);
  for (const auto& load : scene.loads) add(load.table);
}

}  // namespace

Scene read_scene(const std::filesystem::path& path) {
  return read_scene(Config::load_with_base(path), path);
}

Scene read_scene(const Config& root, const std::filesystem::path& path) {
  Scene scene;
  scene.file = path;
  scene.title = root.text_or("title", path.stem().stem().string());
  if (root.has("engine")) scene.engine = read_engine(root);
  read_time(root, scene);
  scene.gravity = root.number_or("gravity_m_s2", 0.0, Range::between(0.0, 1e5));
  for (const Config& table : root.tables("body")) {
    BodySpec body;
    read_body(table, body_name(table, scene), body);
    scene.bodies.push_back(body);
  }
  for (const Config& table : root.tables("mount")) scene.mounts.push_back(read_mount(table));
  for (const Config& table : root.tables("load")) scene.loads.push_back(read_load(table));
  if (scene.engine) {
    if (const auto table = root.find_table("piston")) scene.piston = read_piston(*table);
    if (const auto table = root.find_table("block")) scene.block = read_block(*table);
    if (const auto table = root.find_table("gas")) scene.gas = read_gas(*table);
    if (const auto table = root.find_table("contact")) scene.contact = read_contact(*table);
    scene.contact_where = root.where("contact");
    scene.pin_offset_where = root.table("engine").where("pin_offset_mm");
    scene.small_end = read_law(root, "small_end");
    scene.big_end = read_law(root, "big_end");
    scene.guide = read_guide(root);
  }
  read_steps(root, scene);
  check_engine(root, scene);
  root.finish();
  scene.resolved = root.resolved();
  list_inputs(root, scene);
  return scene;
}

}  // namespace clatter::dynamics
