// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/drive_component.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "dynamics/component/component_catalogue.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

const Range kSpeedRpm = Range::between(-1e5, 1e5);

/// The order of the speed that a torque T cos(order mean t + phase) on an inertia J makes:
/// amplitude T / (J order mean), a quarter of a period later.
SpeedOrder order_of_torque(const DriveOrder& one, const DriveSpec& spec) {
  double torque = *one.torque;
  if (one.at_speed) torque *= std::pow(spec.speed / *one.at_speed, 2);
  return {one.order, torque / (*spec.inertia * one.order * spec.speed),
          one.phase - 0.5 * std::numbers::pi};
}

const Keys<DriveOrder>& drive_order_keys() {
  static const Keys<DriveOrder> keys(
      "order", "an order of the speed", [](auto& key, DriveOrder& order) {
        key.number("order", order.order, Range::between(1e-6, 1e6), "per turn").required();
        key.number("amplitude_rpm", order.amplitude, kSpeedRpm, "amplitude of its cosine");
        key.number("torque_n_m", order.torque, Range::between(-1e9, 1e9),
                   "amplitude of a torque that turns inertia_kg_m2 of the drive")
            .shown_in("N m");
        key.one_of({"amplitude_rpm", "torque_n_m"});
        key.number("at_speed_rpm", order.at_speed, Range::between(1e-6, 1e6),
                   "speed at which the torque has this amplitude: it grows with the square of the "
                   "speed, as torques of masses do")
            .needs("torque_n_m");
        key.number("phase_deg", order.phase, kAngleDeg, "phase of the cosine");
      });
  return keys;
}

void make_drive(const Config& table, DriveSpec& spec) {
  if (!spec.table.empty()) return;
  std::vector<SpeedOrder> orders;
  for (const DriveOrder& one : spec.orders) {
    if (one.torque && spec.speed == 0.0)
      table.fail("speed_rpm", "found 0 with orders of a torque, expected a speed");
    if (one.torque && !spec.inertia)
      table.fail("inertia_kg_m2", "is missing, torque_n_m of an order needs it");
    orders.push_back(one.torque ? order_of_torque(one, spec)
                                : SpeedOrder{one.order, *one.amplitude, one.phase});
  }
  spec.drive =
      with_context(table.where("speed_rpm"), [&] { return Drive(spec.speed, spec.start, orders); });
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

const Keys<DriveSpec>& drive_keys() {
  static const Keys<DriveSpec> keys(
      "drive", "a shaft that turns as prescribed", [](auto& key, DriveSpec& drive) {
        key.where(drive.where);
        name_row(key, drive.name).required();
        key.table("on", drive.bearing, point_keys(), "its bearing; without it the ground");
        axis_row(key, drive.axis);
        key.vector("centre_mm", drive.centre, kPositionMm, "a point of the axis");
        key.number("start_deg", drive.start, kAngleDeg,
                   "angle at time 0, added to that of a table");
        key.number("speed_rpm", drive.speed, kSpeedRpm, "mean speed");
        key.path("table", drive.table, "CSV of speed or angle over time");
        key.one_of({"speed_rpm", "table"});
        key.text("column", drive.column,
                 "column of the table in rpm, rad/s, deg or rad; without it the second one")
            .needs("table");
        key.flag("unwrap", drive.unwrap,
                 "whether angles of the table that begin anew after a turn or a cycle go on in "
                 "whole turns")
            .needs("table");
        key.tables("order", drive.orders, drive_order_keys()).needs("speed_rpm");
        key.number("inertia_kg_m2", drive.inertia, Range::between(1e-12, 1e12),
                   "what torques of orders turn")
            .needs("order");
        key.check(make_drive);
      });
  return keys;
}

std::vector<std::filesystem::path> DriveComponent::inputs() const {
  if (spec_.table.empty()) return {};
  return {spec_.table};
}

void DriveComponent::add_bodies(ModelBuilder& model) {
  if (!spec_.table.empty())
    spec_.drive = Drive(
        read_turn_table(spec_.table, spec_.column, spec_.unwrap, model.time.begin, model.time.end),
        spec_.start);
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

double speed_of_drive(const Config& root, const Config& table, const std::string& key,
                      const std::string& name) {
  for (const Config& one : root.tables("drive")) {
    if (one.text_or("name", "") != name) continue;
    const DriveSpec drive = drive_keys().read(one);
    if (!drive.table.empty())
      table.fail(key, fmt::format("found \"{}\", whose speed is a table, expected a drive with "
                                  "speed_rpm",
                                  name));
    return drive.speed;
  }
  table.fail(key, fmt::format("found \"{}\", expected the name of a [[drive]]", name));
}

std::vector<SpeedOrder> orders_of_drive(const Config& root, const std::string& name) {
  std::vector<SpeedOrder> orders;
  for (const Config& one : root.tables("drive"))
    if (one.text_or("name", "") == name)
      for (const DriveOrder& order : drive_keys().read(one).orders)
        if (order.amplitude) orders.push_back({order.order, *order.amplitude, order.phase});
  return orders;
}

ComponentList read_drives(const Config& root) {
  ComponentList drives;
  for (const Config& table : root.tables("drive"))
    drives.push_back(std::make_shared<DriveComponent>(drive_keys().read(table)));
  return drives;
}

}  // namespace clatter::dynamics
