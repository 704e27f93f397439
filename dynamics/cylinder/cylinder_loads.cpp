// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/cylinder/cylinder_loads.hpp"

#include <utility>

#include "dynamics/cylinder/balance.hpp"
#include "dynamics/cylinder/cylinder_rod.hpp"
#include "dynamics/given/load_table.hpp"

namespace clatter::dynamics {
namespace {

std::vector<Load> gas_loads(const CylinderBodies& bodies, const SliderCrank& crank,
                            const Spline& gas) {
  const TimeFunction pressure = gauge_pressure(bodies, crank, gas);
  const TimeFunction rows = rows_in_time(
      gas, [crank](double t) { return crank.angle(t); },
      [crank](double angle) { return crank.time(angle); });
  std::vector<Load> loads;
  for (const GasLoad& load : gas_unit_loads(bodies)) {
    const Eigen::VectorXd modal =
        load.body->modal.shapes.transpose() * unit_load(load.body->model, load.unit_load);
    loads.push_back({load.term, load.index, modal, pressure, rows});
  }
  return loads;
}

/// -M r a(t) for the accelerated frames of piston (translation, eq. (10)) and rod.
std::vector<Load> frame_inertia(const CylinderBodies& bodies, const SliderCrank& crank) {
  const std::string& name = bodies.spec.name;
  const std::string term = name.empty() ? "inertia frame" : name + " inertia frame";
  const int piston = bodies.piston_index();
  const auto stroke = [crank](double t) { return crank.piston_pin(t).acceleration; };
  std::vector<Load> loads{Load{term, piston, frame_force(bodies.model.system, piston, 2),
                               ramped(bodies.model.time, stroke)}};
  for (Load& load : rod_inertia(bodies, crank, term)) loads.push_back(std::move(load));
  return loads;
}

}  // namespace

std::vector<GasLoad> gas_unit_loads(const CylinderBodies& bodies) {
  const CylinderSpec& spec = bodies.spec;
  std::vector<GasLoad> loads;
  const auto add = [&](const LoadedBody& body, int index, const std::string& load,
                       const std::string& term) {
    if (!load.empty()) loads.push_back({&body, index, load, term});
  };
  add(bodies.piston(), bodies.piston_index(), spec.piston.gas_load,
      "gas on " + spec.name_of("piston"));
  if (bodies.block() != nullptr)
    add(*bodies.block(), bodies.block_index(), spec.bore->gas_load,
        spec.name.empty() ? "gas on block" : spec.name + " gas on block");
  return loads;
}

std::optional<Spline> gas_pressure(const CylinderSpec& spec) {
  if (!spec.gas) return std::nullopt;
  return read_gas_table(spec.gas->table, spec.gas->column, spec.gas->interpolation);
}

TimeFunction gauge_pressure(const CylinderBodies& bodies, const SliderCrank& crank,
                            const std::optional<Spline>& gas) {
  if (!gas) return {};
  return ramped(bodies.model.time, [crank, table = *gas, ambient = bodies.spec.gas->ambient](
                                       double t) { return table(crank.angle(t)) - ambient; });
}

std::vector<Load> cylinder_loads(const CylinderBodies& bodies, const SliderCrank& crank,
                                 const std::optional<Spline>& gas) {
  std::vector<Load> all;
  const auto append = [&](std::vector<Load> loads) {
    for (Load& load : loads) all.push_back(std::move(load));
  };
  if (gas && !bodies.spec.has_free_crank()) append(gas_loads(bodies, crank, *gas));
  append(frame_inertia(bodies, crank));
  std::vector<Load> balance = balance_loads(bodies, crank);
  for (Load& load : balance) load.value = ramped(bodies.model.time, std::move(load.value));
  append(std::move(balance));
  return all;
}

}  // namespace clatter::dynamics
