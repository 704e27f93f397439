// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/shaft/torque_component.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "dynamics/shaft/shaft_catalogue.hpp"

namespace clatter::dynamics {
namespace {

const Range kTorque = Range::between(-1e12, 1e12);

const Keys<TorqueOrder>& torque_order_keys() {
  static const Keys<TorqueOrder> keys(
      "order", "amplitude cos(order angle + phase)", [](auto& key, TorqueOrder& order) {
        key.number("order", order.order, Range::between(1e-6, 1e6), "per turn").required();
        key.number("amplitude_n_m", order.amplitude, kTorque, "amplitude")
            .shown_in("N m")
            .required();
        key.number("phase_deg", order.phase, kAngleDeg, "phase");
      });
  return keys;
}

void read_torque_table(const Config& table, TorqueSpec& found) {
  TorqueTable& law = found.table;
  if (!found.file.empty())
    law.table = read_angle_table(found.file, found.column, "N m", found.period, found.degree);
  if (law.constant == 0.0 && law.orders.empty() && !law.table && law.drag == 0.0 &&
      law.viscous == 0.0)
    throw InputError(table.where() +
                     ": torque: found none, expected value_n_m, table, [[torque.order]], drag_n_m "
                     "or viscous_n_m_s");
}

}  // namespace

const Keys<TorqueSpec>& torque_keys() {
  static const Keys<TorqueSpec> keys(
      "torque", "a torque over the angle of the body on which it acts",
      [](auto& key, TorqueSpec& torque) {
        const Range loss = Range::between(0.0, 1e12);
        TorqueTable& law = torque.table;
        name_row(key, torque.name);
        turn_body_rows(key, torque.bodies);
        key.number("value_n_m", law.constant, kTorque, "constant torque").shown_in("N m");
        key.tables("order", law.orders, torque_order_keys());
        key.path("table", torque.file, "CSV of the torque over the angle, one period");
        key.all_need("table", {}, "", [&] {
          key.text("column", torque.column, "column of the table; without it the second one");
          key.number("period_deg", torque.period, Range::between(1e-3, 1e6), "period of the table");
          key.choice("spline", torque.degree, {{"cubic", 3}, {"quintic", 5}},
                     "between the rows of the table");
          key.number("scale", law.scale, kTorque, "factor of the table");
        });
        key.number("zero_deg", law.zero, kAngleDeg,
                   "angle of the body where that of table and orders is 0");
        key.number("at_speed_rpm", law.speed, Range::between(1e-6, 1e6),
                   "speed at which constant, orders and table hold: they grow with its square; "
                   "at any without it");
        key.number("drag_n_m", law.drag, loss, "torque against the rotation").shown_in("N m");
        key.number("drag_speed_rad_s", law.drag_speed, Range::between(1e-9, 1e6),
                   "speed at which the drag is 71 % of it");
        key.number("viscous_n_m_s", law.viscous, loss, "torque against the speed, over the speed");
        key.check(read_torque_table);
      });
  return keys;
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
  return {std::make_shared<TorqueComponent>(read_elements(root, "torque", torque_keys()))};
}

}  // namespace clatter::dynamics
