// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/torque_component.hpp"

#include <fmt/format.h>

#include <numbers>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "dynamics/component/component_keys.hpp"
#include "dynamics/shaft/shaft_catalogue.hpp"

namespace clatter::dynamics {
namespace {

constexpr double kPerRpm = std::numbers::pi / 30.0;  // [rad/s]
const Range kTorque = Range::between(-1e12, 1e12), kTurn = Range::between(-1e6, 1e6);

TorqueSpec read_torque(const Config& table, size_t number) {
  const Range loss = Range::between(0.0, 1e12);
  TorqueSpec spec;
  spec.name = "torque " + (table.has("name") ? read_name(table) : fmt::format("{}", number));
  spec.bodies = read_turn_bodies(table);
  TorqueTable& law = spec.table;
  law.constant = table.number_or("value_n_m", 0.0, kTorque);
  for (const Config& one : table.tables("order"))
    law.orders.push_back({one.number("order", Range::between(1e-6, 1e6)),
                          one.number("amplitude_n_m", kTorque),
                          one.number_or("phase_deg", 0.0, kTurn) * kDegree});
  if (table.has("table")) {
    spec.file = table.path("table");
    const double period = table.number_or("period_deg", 360.0, Range::between(1e-3, 1e6)) * kDegree;
    const int degree = table.choice("spline", {"cubic", "quintic"}) == "cubic" ? 3 : 5;
    law.table = read_angle_table(spec.file, table.text_or("column", ""), "N m", period, degree);
    law.scale = table.number_or("scale", 1.0, kTorque);
  }
  law.zero = table.number_or("zero_deg", 0.0, kTurn) * kDegree;
  if (table.has("at_speed_rpm"))
    law.speed = table.number("at_speed_rpm", Range::between(1e-6, 1e6)) * kPerRpm;
  law.drag = table.number_or("drag_n_m", 0.0, loss);
  law.drag_speed = table.number_or("drag_speed_rad_s", law.drag_speed, Range::between(1e-9, 1e6));
  law.viscous = table.number_or("viscous_n_m_s", 0.0, loss);
  if (law.constant == 0.0 && law.orders.empty() && !law.table && law.drag == 0.0 &&
      law.viscous == 0.0)
    throw InputError(table.where() +
                     ": torque: found none, expected value_n_m, table, [[torque.order]], drag_n_m "
                     "or viscous_n_m_s");
  return spec;
}

}  // namespace

TurnBodies read_turn_bodies(const Config& table) {
  TurnBodies bodies;
  bodies.body = table.text("body");
  bodies.where = table.where("body");
  bodies.reaction = table.text_or("reaction", "");
  bodies.reaction_where = table.where("reaction");
  return bodies;
}

TurnAngles angles_of(const TurnBodies& bodies, ModelBuilder& model) {
  const TurningBody& turn = model.turn(bodies.body, bodies.where);
  TurnAngles angles;
  angles.angle = model.system.coordinate(turn.body, turn.dof);
  if (bodies.reaction.empty()) return angles;
  const TurningBody& other = model.turn(bodies.reaction, bodies.reaction_where);
  const int reaction = model.system.coordinate(other.body, other.dof);
  if (other.axis != turn.axis || reaction == angles.angle)
    throw InputError(fmt::format(
        "{}: \"{}\" turns about {}, expected another body that turns about "
        "{}, as \"{}\"",
        bodies.reaction_where, bodies.reaction, "xyz"[other.axis], "xyz"[turn.axis], bodies.body));
  angles.reaction = reaction;
  return angles;
}

std::vector<std::filesystem::path> TorqueComponent::inputs() const {
  std::vector<std::filesystem::path> tables;
  for (const TorqueSpec& torque : torques_)
    if (!torque.file.empty()) tables.push_back(torque.file);
  return tables;
}

void TorqueComponent::add_elements(ModelBuilder& model) {
  for (const TorqueSpec& torque : torques_) {
    const TurnAngles at = angles_of(torque.bodies, model);
    model.system.add_element(
        std::make_unique<TableTorque>(torque.name, at.angle, at.reaction, torque.table,
                                      ramped(model.time, [](double) { return 1.0; })));
  }
}

void TorqueComponent::add_effects(const ModelBuilder&, EffectTable& effects) const {
  if (!torques_.empty())
    effects.add(find_effect(kShaftEffects, "torques over angle"), true, "[[torque]]", "torque");
}

ComponentList read_torques(const Config& root) {
  std::vector<TorqueSpec> torques;
  for (const Config& table : root.tables("torque"))
    torques.push_back(read_torque(table, torques.size() + 1));
  return {std::make_shared<TorqueComponent>(std::move(torques))};
}

}  // namespace clatter::dynamics
