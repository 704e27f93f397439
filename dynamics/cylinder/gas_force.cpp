// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/gas_force.hpp"

#include "dynamics/cylinder/cylinder_loads.hpp"

namespace clatter::dynamics {

void GasForce::evaluate(const Stage& stage, const Eigen::VectorXd& y, const Eigen::VectorXd&,
                        bool with_tangent, Response& response) {
  const auto at = [&](double turn) { return pressure_(crank_angle(crank_, stage.time, turn)); };
  const double share = ramp_(stage.time);
  last_ = share * (at(y(1)) - ambient_);
  response.force.setZero(2);
  response.force(0) = last_;
  if (!with_tangent) return;
  constexpr double kStep = 1e-5;  // [rad]: central difference of a piecewise cubic
  response.tangent.setZero(2, 2);
  response.tangent(0, 1) = share * (at(y(1) + kStep) - at(y(1) - kStep)) / (2.0 * kStep);
}

TurningAngle GasForce::table_angle(double time, const Eigen::VectorXd& y,
                                   const Eigen::VectorXd& v) const {
  const double turns = crank_.spin(time) < 0.0 ? -v(1) : v(1);
  return {crank_angle(crank_, time, y(1)), crank_.turn(time).velocity + turns};
}

std::vector<std::unique_ptr<ForceElement>> gas_forces(const CylinderBodies& bodies,
                                                      const SliderCrank& crank, const Spline& gas) {
  System& system = bodies.model.system;
  const int turn =
      system.coordinate(bodies.model.body(CrankBody::kName), bodies.spec.crankshaft->turn());
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
        load.term, system.combined_coordinate(load.index, volume), turn, crank, gas,
        bodies.spec.gas->ambient, ramped(bodies.model.time, [](double) { return 1.0; })));
  }
  return forces;
}

}  // namespace clatter::dynamics
