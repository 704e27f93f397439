// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_component.hpp"

#include <cmath>

#include "dynamics/component/body_component.hpp"
#include "dynamics/cylinder/cylinder_effects.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/cylinder/cylinder_loads.hpp"
#include "dynamics/cylinder/gas_force.hpp"
#include "dynamics/cylinder/liner_ends_text.hpp"
#include "dynamics/cylinder/piston_axis.hpp"

namespace clatter::dynamics {

std::vector<BodySpec> CylinderComponent::reduced_bodies() const {
  BodySpec piston = spec_.piston;
  piston.name = spec_.name_of("piston");
  return {piston};
}

std::vector<std::filesystem::path> CylinderComponent::inputs() const {
  std::vector<std::filesystem::path> files = spec_.shape_files;
  if (spec_.gas) files.push_back(spec_.gas->table);
  if (!spec_.engine.speed_table.empty()) files.push_back(spec_.engine.speed_table);
  return files;
}

ComponentSize CylinderComponent::size() const {
  ComponentSize size{.modes = 3, .film_cells = 0};  // of the rod
  if (!spec_.contact) return size;
  film::PistonLinerOptions contact = *spec_.contact;
  double along = contact.cells_along;
  if (contact.liner_layer) {  // one field, where a cell of the pad has four
    set_layer_range(crank_, contact);
    along += 0.25 * contact.liner_layer->cells((contact.skirt_top - contact.skirt_bottom) /
                                               contact.cells_along);
  }
  size.film_cells = std::llround(2.0 * contact.cells_around * along);  // of two pads
  return size;
}

void CylinderComponent::add_bodies(ModelBuilder& model) {
  model.add_body(make_rigid_rod(spec_.name_of("rod"), spec_.engine.rod), spec_.piston.where);
  model.set_moving_frame(spec_.name_of("piston"));
}

void CylinderComponent::add_elements(ModelBuilder& model) {
  const CylinderBodies bodies{spec_, model};
  check_piston_axis(bodies);
  piston_ = bodies.piston_index();
  rod_ = bodies.rod_index();
  pin_axis_ = bodies.axes().pin;
  pin_ = pin_node(bodies);
  model.system.add_element(pin_joint(bodies, crank_, pin_));
  model.system.add_element(crank_joint(bodies, crank_));
  model.system.add_element(pin_guide(bodies, crank_, pin_));
  if (spec_.has_free_crank()) {
    turn_ = model.system.coordinate(model.body(CrankBody::kName), spec_.crankshaft->turn());
    if (const auto gas = gas_pressure(spec_))
      for (auto& force : gas_forces(bodies, crank_, *gas))
        model.system.add_element(std::move(force));
  }
  if (!spec_.contact) return;
  LinerContact contact = liner_contact(bodies, crank_, pin_);
  contact_ = contact.element.get();
  liner_ = std::move(contact.liner);
  model.system.add_element(std::move(contact.element));
}

void CylinderComponent::add_loads(ModelBuilder& model) {
  gas_ = gas_pressure(spec_);
  for (Load& load : cylinder_loads({spec_, model}, crank_, gas_))
    model.system.add_load(std::move(load));
}

void CylinderComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  add_body_effect(*find_body(model.loaded, spec_.name_of("piston")), effects);
}

void CylinderComponent::add_effects(const ModelBuilder& model, EffectTable& effects) const {
  const bool on_block = spec_.bore && model.has_body("block");
  const std::string ends = contact_ != nullptr ? liner_ends_text(crank_, contact_->options()) : "";
  add_cylinder_effects(spec_, on_block, ends, effects);
}

std::map<int, Eigen::Vector3d> CylinderComponent::frames(double time) const {
  const Eigen::Vector2d rod = crank_.rod_point(time, spec_.engine.rod.centre).position;
  return {{piston_, {pin_axis_.x(), pin_axis_.y(), crank_.piston_pin(time).position}},
          {rod_, {pin_axis_.x(), rod.x(), rod.y()}}};
}

Eigen::Vector2d CylinderComponent::secondary_motion(double time, const Eigen::VectorXd& y) const {
  Eigen::Vector2d motion(y(pin_[1]), y(pin_[3]));
  if (liner_) {
    const double tilt = y(liner_->tilt);
    motion -= Eigen::Vector2d(y(liner_->lateral) - tilt * crank_.piston_pin(time).position, tilt);
  }
  return motion;
}

void CylinderComponent::record(const System& system, const StageState& state,
                               History& history) const {
  const std::string prefix = spec_.name_of("");
  const Eigen::Vector2d motion = secondary_motion(state.time, state.y);
  history.set_prefix(prefix);
  history.put("piston_lateral", "m", motion.x());
  history.put("piston_tilt", "rad", motion.y());
  if (gas_)
    history.put("gas_pressure", "Pa",
                (*gas_)(crank_angle(crank_, state.time, turn_ >= 0 ? state.y(turn_) : 0.0)));
  for (int e = elements_.first; e < elements_.end; ++e) {
    const ForceElement& element = system.element(e);
    // The joints' histories have their names, those of the contact are the cylinder's.
    history.set_prefix(&element == contact_ ? prefix : "");
    element.record(history);
  }
  history.set_prefix("");
}

}  // namespace clatter::dynamics
