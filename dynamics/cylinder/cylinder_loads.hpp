// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The known forces of a cylinder: gas, inertia of moving frames.
#include <optional>
#include <string>
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/given/spline.hpp"

namespace clatter::dynamics {

/// Absolute pressure over the crank angle from firing TDC [Pa] of a cylinder with [gas].
std::optional<Spline> gas_pressure(const CylinderSpec& spec);

/// Gauge pressure over the time of the clock [Pa], which grows over the ramp of the start; empty
/// without `gas`.
TimeFunction gauge_pressure(const CylinderBodies& bodies, const SliderCrank& crank,
                            const std::optional<Spline>& gas);

/// A unit load per Pa of a cylinder's gas.
struct GasLoad {
  const LoadedBody* body;
  int index;              // of the body in the system
  std::string unit_load;  // of its reduced model
  std::string term;       // in the energy balance: "gas on piston"
};

/// Those of piston and head that the scene names.
std::vector<GasLoad> gas_unit_loads(const CylinderBodies& bodies);

/// Gas on piston and head, unless the crank's rotation is free (gas_force.hpp), inertia of the
/// frames of piston and rod, and the balance. All of them grow over the ramp of the start.
/// InputError for unit loads that do not exist.
/// @param gas the cylinder's pressure, when it has one.
std::vector<Load> cylinder_loads(const CylinderBodies& bodies, const SliderCrank& crank,
                                 const std::optional<Spline>& gas);

}  // namespace clatter::dynamics
