// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/drive_component.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]

const Range kAngleDeg = Range::between(-1e6, 1e6), kSpeedRpm = Range::between(-1e5, 1e5);

/// The order of the speed that a torque T cos(order mean t + phase) on an inertia J makes:
/// amplitude T / (J order mean), a quarter of a period later.
SpeedOrder order_of_torque(const Config& one, double order, double mean, double inertia) {
  double torque = one.number("torque_n_m", Range::between(-1e9, 1e9));
  if (one.has("at_speed_rpm"))
    torque *= std::pow(mean / (one.number("at_speed_rpm", Range::between(1e-6, 1e6)) * kRpm), 2);
  const double phase = one.number_or("phase_deg", 0.0, kAngleDeg) * kDegree;
  return {order, torque / (inertia * order * mean), phase - 0.5 * std::numbers::pi};
}

SpeedOrder read_order(const Config& table, const Config& one, double mean) {
  const double order = one.number("order", Range::between(1e-6, 1e6));
  if (!one.has("torque_n_m"))
    return {order, one.number("amplitude_rpm", kSpeedRpm) * kRpm,
            one.number_or("phase_deg", 0.0, kAngleDeg) * kDegree};
  if (one.has("amplitude_rpm"))
    one.fail("amplitude_rpm", "found with torque_n_m, expected one of both");
  if (mean == 0.0) table.fail("speed_rpm", "found 0 with orders of a torque, expected a speed");
  return order_of_torque(one, order, mean,
                         table.number("inertia_kg_m2", Range::between(1e-12, 1e12)));
}

DriveSpec read_drive(const Config& table) {
  DriveSpec spec;
  spec.name = read_name(table);
  spec.where = table.where();
  if (table.has("centre_mm")) spec.centre = read_vector(table, "centre_mm", 1e6) * kMilli;
  const std::string axis = table.choice("axis", {"x", "y", "z"});
  spec.axis = axis[0] - 'x';
  if (table.has("on")) spec.bearing = read_point(table, "on");
  const double start = table.number_or("start_deg", 0.0, kAngleDeg) * kDegree;
  if (table.has("table")) {
    for (const char* key : {"speed_rpm", "order", "inertia_kg_m2"})
      if (table.has(key)) table.fail(key, "found with table, expected one of both");
    spec.table = table.path("table");
    spec.column = table.text_or("column", "");
    spec.start = start;
    return spec;
  }
  if (table.has("column")) table.fail("column", "found without table");
  const double mean = table.number("speed_rpm", kSpeedRpm) * kRpm;
  std::vector<SpeedOrder> orders;
  for (const Config& one : table.tables("order")) orders.push_back(read_order(table, one, mean));
  spec.drive = with_context(table.where("speed_rpm"), [&] { return Drive(mean, start, orders); });
  return spec;
}

/// The bearing of a shaft; nullptr: on the ground.
std::unique_ptr<NodePort> bearing_port(ModelBuilder& model, const PointSpec& bearing) {
  if (bearing.body.empty()) return nullptr;
  auto port = model.port(bearing);
  auto* node = dynamic_cast<NodePort*>(port.get());
  if (node == nullptr)
    throw InputError(
        fmt::format("{}.body: found \"{}\", expected a reduced part whose frame is at "
                    "rest",
                    bearing.where, bearing.body));
  static_cast<void>(port.release());
  return std::unique_ptr<NodePort>(node);
}

}  // namespace

std::vector<std::filesystem::path> DriveComponent::inputs() const {
  if (spec_.table.empty()) return {};
  return {spec_.table};
}

void DriveComponent::add_bodies(ModelBuilder& model) {
  if (!spec_.table.empty())
    spec_.drive = Drive(
        read_turn_table(spec_.table, spec_.column, model.time.begin, model.time.end), spec_.start);
  DriveSpec given = spec_;
  if (model.at_rest) given.drive = Drive(0.0, given.drive.at(model.time.begin).position);
  const auto port = [spec = given, begin = model.time.begin, &model](System&,
                                                                     const Eigen::Vector3d& at) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(spec.axis);
    const Eigen::AngleAxisd back(-spec.drive.at(begin).position, axis);
    return std::make_unique<DrivenPort>(spec.drive, spec.centre, back * (at - spec.centre), axis,
                                        bearing_port(model, spec.bearing));
  };
  model.add_ports(spec_.name, port, spec_.where);
  model.add_shaft(spec_.name, {given.drive, spec_.centre, Eigen::Vector3d::Unit(spec_.axis)});
}

void DriveComponent::add_body_effects(const ModelBuilder&, EffectTable& effects) const {
  effects.add(find_effect(kComponentEffects, "drive"), "drive " + spec_.name, true,
              "[[drive]]: turns as prescribed, no body");
}

double speed_of_drive(const Config& root, const Config& table, std::string_view key) {
  const std::string name = table.text(key);
  for (const Config& drive : root.tables("drive")) {
    if (drive.text_or("name", "") != name) continue;
    if (!drive.has("speed_rpm"))
      table.fail(key, fmt::format("found \"{}\", whose speed is a table, expected a drive with "
                                  "speed_rpm",
                                  name));
    return drive.number("speed_rpm", kSpeedRpm) * kRpm;
  }
  table.fail(key, fmt::format("found \"{}\", expected the name of a [[drive]]", name));
}

ComponentList read_drives(const Config& root) {
  ComponentList drives;
  for (const Config& table : root.tables("drive"))
    drives.push_back(std::make_shared<DriveComponent>(read_drive(table)));
  return drives;
}

}  // namespace clatter::dynamics
