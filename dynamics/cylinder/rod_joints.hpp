// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The joints of a connecting rod: with the piston's pin and with the crank pin.
#include <memory>

#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/element/element.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

// By the law of [small_end] and [big_end]: a spring, a spring with friction, an oil film.
// InputError for sets that a body lacks.

std::unique_ptr<ForceElement> pin_joint(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin);
std::unique_ptr<ForceElement> crank_joint(const CylinderBodies& bodies, const SliderCrank& crank);

}  // namespace clatter::dynamics
