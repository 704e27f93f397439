// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/scene/contact_table.hpp"

namespace clatter::dynamics {
namespace {

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
  body.mode_limit_hz = table.number_or("mode_limit_hz", 0.0, Range::not_negative());
  body.where = table.where();
}

EngineSpec read_engine(const Config& root) {
  const Config table = root.table("engine");
  EngineSpec engine;
  engine.speed = table.number("speed_rpm", Range::positive()) * std::numbers::pi / 30.0;
  engine.stroke = table.number("stroke_mm", Range::positive()) * kMilli;
  engine.pin_offset = table.number_or("pin_offset_mm", 0.0) * kMilli;
  engine.balanced = table.flag_or("balanced", false);
  const Config rod = root.table("rod");
  engine.rod.length = rod.number("length_mm", Range::positive()) * kMilli;
  engine.rod.mass = rod.number("mass_kg", Range::positive());
  engine.rod.inertia = rod.number("inertia_kg_m2", Range::positive());
  engine.rod.centre =
      rod.number("centre_mm", Range{0.0, engine.rod.length / kMilli, false}) * kMilli;
  SliderCrank(0.5 * engine.stroke, engine.rod.length, engine.pin_offset, engine.speed);
  return engine;
}

RadialLaw read_law(const Config& root, std::string_view key) {
  RadialLaw law;
  const auto table = root.find_table(key);
  if (!table) return law;
  law.clearance =
      table->number_or("clearance_um", law.clearance / kMicro, Range::not_negative()) * kMicro;
  law.soft_stiffness =
      table->number_or("soft_stiffness_n_m", law.soft_stiffness, Range::not_negative());
  law.exponent = table->number_or("exponent", law.exponent, Range{1.0, 3.0, false});
  law.stiffness = table->number_or("stiffness", law.stiffness, Range::positive());
  law.damping = table->number_or("damping_n_s_m", law.damping, Range::not_negative());
  return law;
}

GuideLaw read_guide(const Config& root) {
  GuideLaw guide;
  const auto table = root.find_table("pin_guide");
  if (!table) return guide;
  const auto positive = Range::not_negative();
  guide.axial_stiffness = table->number_or("axial_stiffness_n_m", guide.axial_stiffness, positive);
  guide.axial_damping = table->number_or("axial_damping_n_s_m", guide.axial_damping, positive);
  guide.tilt_stiffness = table->number_or("tilt_stiffness_n_m", guide.tilt_stiffness, positive);
  guide.tilt_damping = table->number_or("tilt_damping_n_m_s", guide.tilt_damping, positive);
  return guide;
}

GasSpec read_gas(const Config& table) {
  GasSpec gas;
  gas.table = table.path("table");
  gas.column = table.text_or("column", "pressure");
  gas.interpolation = interpolation(table, "cubic");
  gas.ambient = table.number_or("ambient_bar", 1.0, Range::not_negative()) * 1e5;
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
  mount.stiffness = table.numbers("stiffness_n_m", 3);
  mount.damping =
      table.has("damping_n_s_m") ? table.numbers("damping_n_s_m", 3) : std::vector<double>(3, 0.0);
  for (const double value : mount.stiffness) {
    if (value < 0.0)
      table.fail("stiffness_n_m", fmt::format("found {}, expected at least 0", value));
  }
  for (const double value : mount.damping) {
    if (value < 0.0)
      table.fail("damping_n_s_m", fmt::format("found {}, expected at least 0", value));
  }
  return mount;
}

LoadSpec read_load(const Config& table) {
  static constexpr std::string_view kComponents[] = {"x", "y", "z", "rx", "ry", "rz"};
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
    load.scale = table.number_or("scale", 1.0);
  } else {
    load.scale = table.number("value");
  }
  return load;
}

void read_steps(const Config& root, Scene& scene) {
  const double turn = scene.engine ? 2.0 * std::numbers::pi / scene.engine->speed : 0.0;
  const double largest_us =
      scene.engine ? turn / 360.0 / kMicro : (scene.time.end - scene.time.begin) / 100.0 / kMicro;
  const Config time = root.table("time");
  const std::string method = scene.contact && scene.contact->effects.film
                                 ? time.choice("method", {"sdirk2", "tr-bdf2"})
                                 : time.choice("method", {"tr-bdf2", "sdirk2"});
  scene.steps.method = method == "sdirk2" ? &sdirk2() : &tr_bdf2();
  scene.steps.largest = time.number_or("largest_step_us", largest_us, Range::positive()) * kMicro;
  scene.steps.smallest = time.number_or("smallest_step_us", 1e-4, Range::positive()) * kMicro;
  scene.steps.first = std::min(1e-7, 1e-3 * scene.steps.largest);
  auto& accuracy = scene.steps.accuracy;
  const auto table = root.find_table("accuracy");
  if (!table) return;
  accuracy.tolerance = table->number_or("tolerance", accuracy.tolerance, Range{1e-12, 1.0, false});
  accuracy.displacement_scale =
      table->number_or("displacement_um", accuracy.displacement_scale / kMicro, Range::positive()) *
      kMicro;
  accuracy.velocity_scale =
      table->number_or("velocity_m_s", accuracy.velocity_scale, Range::positive());
  accuracy.arm = table->number_or("arm_mm", accuracy.arm / kMilli, Range::positive()) * kMilli;
}

void read_time(const Config& root, Scene& scene) {
  const Config time = root.table("time");
  scene.time.output_step = time.number_or("output_step_us", 20.0, Range::positive()) * kMicro;
  if (!scene.engine) {
    scene.time.end = time.number("end_s", Range::positive());
    return;
  }
  scene.time.cycles = static_cast<int>(time.integer_or("cycles", 2, Range{1.0, 1000.0, false}));
  const double ramp_deg = time.number_or("ramp_deg", 60.0, Range{0.0, 360.0, false});
  const double omega = scene.engine->speed;
  scene.time.begin = -(2.0 + 4.0 * (scene.time.cycles - 1)) * std::numbers::pi / omega;
  scene.time.end = 2.0 * std::numbers::pi / omega;
  scene.time.ramp = ramp_deg * kDegree / omega;
  scene.film_every =
      time.number_or("film_every_deg", 10.0, Range::not_negative()) * kDegree / omega;
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
  scene.gravity = root.number_or("gravity_m_s2", 0.0, Range::not_negative());
  for (const Config& table : root.tables("body")) {
    BodySpec body;
    read_body(table, table.text("name"), body);
    scene.bodies.push_back(body);
  }
  for (const Config& table : root.tables("mount")) scene.mounts.push_back(read_mount(table));
  for (const Config& table : root.tables("load")) scene.loads.push_back(read_load(table));
  if (scene.engine) {
    if (const auto table = root.find_table("piston")) scene.piston = read_piston(*table);
    if (const auto table = root.find_table("block")) scene.block = read_block(*table);
    if (const auto table = root.find_table("gas")) scene.gas = read_gas(*table);
    if (const auto table = root.find_table("contact")) scene.contact = read_contact(*table);
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
