// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/gas_force.hpp"

#include "dynamics/cylinder/cylinder_loads.hpp"

namespace clatter::dynamics {

void GasForce::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd& v,
                        bool with_tangent, Response& response) {
  const double angle = table_angle(stage.time, y, v).angle, share = ramp_(stage.time);
  last_ = share * (pressure_(angle) - ambient_);
  response.force.setZero(2);
  response.force(0) = last_;
  if (!with_tangent) return;
  response.tangent.setZero(2, 2);
  response.tangent(0, 1) = share * crank_.sign() * pressure_.slope(angle);
}

std::vector<std::unique_ptr<ForceElement>> gas_forces(const CylinderBodies& bodies,
                                                      const CrankAngle& crank, const Spline& gas) {
  System& system = bodies.model.system;
  std::vector<std::unique_ptr<ForceElement>> forces;
  for (const GasLoad& load : gas_unit_loads(bodies)) {
    const Eigen::VectorXd& unit = unit_load(load.body->model, load.unit_load);
    WeightedDofs volume;
    for (Eigen::Index dof = 0; dof < unit.size(); ++dof) {
      if (unit(dof) == 0.0) continue;
      volume.dofs.push_back(static_cast<int>(dof));
      volume.weights.push_back(unit(dof));
    }
    forces.push_back(std::make_unique<GasForce>(
        load.term, system.combined_coordinate(load.index, volume), crank, gas,
        bodies.spec.gas->ambient, ramped(bodies.model.time, [](double) { return 1.0; })));
  }
  return forces;
}

}  // namespace clatter::dynamics
