// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// engine.balanced: loads that cancel the mechanism's inertia on the block's rigid modes.
#include <vector>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/given/crank.hpp"
#include "dynamics/integrate/system.hpp"

namespace clatter::dynamics {

/// What the ideal mechanism's inertia does to the block, with the opposite sign: the rate of
/// momentum of piston and rod about the engine's origin, less the moment of the crank's drive,
///
///   F = sum m a,   M = sum (r x m a + I phi'') - T e_x,   T omega = d(kinetic energy)/dt.
///
/// The ideal mechanism loads the block with -F: at the bearings and, with the side force, on the
/// liner at the pin's height. T is held by the drive, so the side force's roll moment is -M_x.
/// @param piston rate of momentum of the piston about the pin's centre per unit acceleration along
/// z [kg], [kg m]. @param pin (x, y) of the pin's centre [m].
Wrench mechanism_inertia(const EngineSpec& engine, const SliderCrank& crank, const Wrench& piston,
                         const Eigen::Vector2d& pin, double time);

/// Loads on the block by mechanism_inertia(), without the ramp of the start. They act as inertia
/// forces of a rigid motion (ModalBody::force_of), so a free block's elastic modes get nothing of
/// them. None without `engine.balanced`, an elastic block, or where the block is not free.
std::vector<Load> balance_loads(const CylinderBodies& bodies, const SliderCrank& crank);

}  // namespace clatter::dynamics
