// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_component.hpp"

#include <cmath>

#include "dynamics/component/body_component.hpp"
#include "dynamics/cylinder/clearance.hpp"
#include "dynamics/cylinder/cylinder_effects.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/cylinder/cylinder_loads.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"
#include "dynamics/cylinder/gas_force.hpp"
#include "dynamics/cylinder/liner_ends_text.hpp"
#include "dynamics/cylinder/piston_axis.hpp"
#include "dynamics/cylinder/ring_table.hpp"
#include "dynamics/cylinder/rod_joints.hpp"

namespace clatter::dynamics {

std::vector<BodySpec> CylinderComponent::reduced_bodies() const {
  BodySpec piston = spec_.piston;
  piston.name = spec_.name_of("piston");
  if (spec_.rod.model != RodModel::kElastic) return {piston};
  BodySpec rod = spec_.rod.body;
  rod.name = spec_.name_of("rod");
  return {piston, rod};
}

std::vector<std::filesystem::path> CylinderComponent::inputs() const {
  std::vector<std::filesystem::path> files = spec_.shape_files;
  if (spec_.gas) files.push_back(spec_.gas->table);
  for (const JointSpec* joint : {&spec_.small_end, &spec_.big_end})
    files.insert(files.end(), joint->files.begin(), joint->files.end());
  if (!spec_.engine.speed_table.empty()) files.push_back(spec_.engine.speed_table);
  return files;
}

ComponentTraits CylinderComponent::traits() const {
  ComponentTraits traits;
  traits.has_film = spec_.contact && spec_.contact->effects.film;
  if (spec_.rod.model == RodModel::kRigid || spec_.rod.model == RodModel::kTwoMass)
    traits.modes = kRodPlanar;
  if (!spec_.contact) return traits;
  film::PistonLinerOptions contact = *spec_.contact;
  double along = contact.cells_along;
  if (contact.liner_layer) {  // one field, where a cell of the pad has four
    set_layer_range(crank_, contact);
    along += 0.25 * contact.liner_layer->cells((contact.skirt_top - contact.skirt_bottom) /
                                               contact.cells_along);
  }
  const double pads = contact.span == film::SkirtSpan::kWhole ? 1.0 : 2.0;
  traits.film_cells = std::llround(pads * contact.cells_around * along);
  return traits;
}

void CylinderComponent::add_bodies(ModelBuilder& model) {
  spec_.engine.rod = rod_of(spec_, model.loaded);
  add_rod_body(spec_, model);
  model.set_moving_frame(spec_.name_of("piston"));
}

void CylinderComponent::add_elements(ModelBuilder& model) {
  const CylinderBodies bodies{spec_, model};
  check_piston_axis(bodies);
  piston_ = bodies.piston_index();
  if (spec_.rod.model != RodModel::kMassless) rod_ = bodies.rod_index();
  pin_axis_ = bodies.axes().pin;
  pin_ = pin_node(bodies);
  auto pin = pin_joint(bodies, crank_, pin_);
  auto crank_pin = crank_joint(bodies, crank_);
  if (spec_.rod.model == RodModel::kMassless) {
    model.system.add_element(massless_rod(bodies, std::move(pin), std::move(crank_pin)));
  } else {
    model.system.add_element(std::move(pin));
    model.system.add_element(std::move(crank_pin));
  }
  for (auto& element : elastic_rod_elements(bodies, crank_))
    model.system.add_element(std::move(element));
  model.system.add_element(pin_guide(bodies, crank_, pin_));
  gas_ = gas_pressure(spec_);
  angle_ = bodies.crank_angle(crank_);
  if (gas_ && angle_.is_free())
    for (auto& force : gas_forces(bodies, angle_, *gas_))
      model.system.add_element(std::move(force));
  if (!spec_.contact) return;
  check_scaled_shapes(spec_, bodies.block() != nullptr);
  LinerContact contact = liner_contact(bodies, crank_, pin_, gas_);
  contact_ = contact.element.get();
  liner_ = std::move(contact.liner);
  model.system.add_element(std::move(contact.element));
  auto rings = ring_pack(bodies, crank_, pin_, gas_);
  rings_ = rings.get();
  if (rings) model.system.add_element(std::move(rings));
}

void CylinderComponent::add_loads(ModelBuilder& model) {
  for (Load& load : cylinder_loads({spec_, model}, crank_, gas_))
    model.system.add_load(std::move(load));
}

void CylinderComponent::add_body_effects(const ModelBuilder& model, EffectTable& effects) const {
  add_body_effect(*find_body(model.loaded, spec_.name_of("piston")), effects);
  const LoadedBody* rod = find_body(model.loaded, spec_.name_of("rod"));
  if (rod != nullptr && rod->rod) add_body_effect(*rod, effects);
}

void CylinderComponent::add_effects(const ModelBuilder& model, EffectTable& effects) const {
  const bool on_block = spec_.bore && model.has_body("block");
  const std::string ends = contact_ != nullptr ? liner_ends_text(crank_, contact_->options()) : "";
  add_cylinder_effects(spec_, traits(), on_block, ends, effects);
  if (contact_ != nullptr) add_clearance_effect(spec_.name, crank_, contact_->options(), effects);
}

std::map<int, Eigen::Vector3d> CylinderComponent::frames(double time) const {
  std::map<int, Eigen::Vector3d> frames{
      {piston_, {pin_axis_.x(), pin_axis_.y(), crank_.piston_pin(time).position}}};
  const Eigen::Vector2d rod = rod_centre(spec_.engine.rod, crank_, time).position;
  if (rod_ >= 0) frames[rod_] = {pin_axis_.x(), rod.x(), rod.y()};
  return frames;
}

Eigen::Vector2d CylinderComponent::secondary_motion(double time, const Eigen::VectorXd& y) const {
  Eigen::Vector2d motion(y(pin_[1]), y(pin_[3]));
  if (liner_) {
    const double tilt = y(liner_->tilt);
    const double height = crank_.piston_pin(time).position + (angle_.is_free() ? y(pin_[2]) : 0.0);
    motion -= Eigen::Vector2d(y(liner_->lateral) - tilt * height, tilt);
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
    history.put(
        "gas_pressure", "Pa",
        (*gas_)(angle_.is_free() ? angle_.of(state.time, state.y) : crank_.angle(state.time)));
  for (int e = elements_.first; e < elements_.end; ++e) {
    const ForceElement& element = system.element(e);
    // The joints' histories have their names, those of contact and rings are the cylinder's.
    history.set_prefix(&element == contact_ || &element == rings_ ? prefix : "");
    element.record(history);
  }
  history.set_prefix("");
}

}  // namespace clatter::dynamics
