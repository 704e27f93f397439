// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/component/drive_component.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kRpm = std::numbers::pi / 30.0;  // [rad/s]

DriveSpec read_drive(const Config& table) {
  const Range angle = Range::between(-1e6, 1e6), speed = Range::between(-1e5, 1e5);
  DriveSpec spec;
  spec.name = read_name(table);
  spec.where = table.where();
  if (table.has("centre_mm")) spec.centre = read_vector(table, "centre_mm", 1e6) * kMilli;
  const std::string axis = table.choice("axis", {"x", "y", "z"});
  spec.axis = axis[0] - 'x';
  if (table.has("on")) spec.bearing = read_point(table, "on");
  const double start = table.number_or("start_deg", 0.0, angle) * kDegree;
  if (table.has("table")) {
    for (const char* key : {"speed_rpm", "order"})
      if (table.has(key)) table.fail(key, "found with table, expected one of both");
    spec.table = table.path("table");
    spec.column = table.text_or("column", "");
    spec.start = start;
    return spec;
  }
  if (table.has("column")) table.fail("column", "found without table");
  const double mean = table.number("speed_rpm", speed) * kRpm;
  std::vector<SpeedOrder> orders;
  for (const Config& one : table.tables("order"))
    orders.push_back({one.number("order", Range::between(1e-6, 1e6)),
                      one.number("amplitude_rpm", speed) * kRpm,
                      one.number_or("phase_deg", 0.0, angle) * kDegree});
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
  effects.add("drive " + spec_.name, true, "[[drive]]: turns as prescribed, no body");
}

ComponentList read_drives(const Config& root) {
  ComponentList drives;
  for (const Config& table : root.tables("drive"))
    drives.push_back(std::make_shared<DriveComponent>(read_drive(table)));
  return drives;
}

}  // namespace clatter::dynamics
