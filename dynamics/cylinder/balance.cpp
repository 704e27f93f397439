// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/balance.hpp"

#include "dynamics/cylinder/cylinder_rod.hpp"

namespace clatter::dynamics {

Wrench mechanism_inertia(const EngineSpec& engine, const SliderCrank& crank, const Wrench& piston,
                         const Eigen::Vector2d& pin, double time) {
  const Motion<double> stroke = crank.piston_pin(time);
  const Motion<double> angle = crank.rod_angle(time);
  const Motion<Eigen::Vector2d> centre = rod_centre(engine.rod, crank, time);
  const Eigen::Vector3d pin_at(pin.x(), pin.y(), stroke.position);
  const Eigen::Vector3d rod_at(pin.x(), centre.position.x(), centre.position.y());
  Wrench rod = Wrench::Zero();
  rod.segment<2>(1) = engine.rod.mass * centre.acceleration;
  rod(3) = engine.rod.inertia * angle.acceleration;
  Wrench total = moved(piston * stroke.acceleration, pin_at) + moved(rod, rod_at);
  const double power = piston(2) * stroke.acceleration * stroke.velocity +
                       engine.rod.mass * centre.acceleration.dot(centre.velocity) +
                       engine.rod.inertia * angle.acceleration * angle.velocity;
  total(3) -= power / crank.spin(time);
  return total;
}

std::vector<Load> balance_loads(const CylinderBodies& bodies, const SliderCrank& crank) {
  const EngineSpec& engine = bodies.spec.engine;
  if (!engine.balanced || bodies.block() == nullptr) return {};
  const ModalBody& block = bodies.block()->modal;
  if (block.rigid_modes != 6) return {};  // a held block needs no balance
  const ModalBody& body = bodies.piston().modal;
  const Wrench piston = body.rigid.transpose() * body.rigid.col(2);
  const Eigen::Vector2d pin = bodies.axes().pin;
  const std::string& name = bodies.spec.name;
  const std::string term =
      name.empty() ? "balance of the other cylinders" : name + " balance of the other cylinders";
  std::vector<Load> loads;
  for (int k = 0; k < 6; ++k) {
    loads.push_back({term, bodies.block_index(), block.force_of(Wrench::Unit(k)), [=](double t) {
                       return mechanism_inertia(engine, crank, piston, pin, t)(k);
                     }});
  }
  return loads;
}

}  // namespace clatter::dynamics
