// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[contact.ring]]: the piston rings, for the layer of oil on the liner and for friction.
#include <memory>
#include <vector>

#include "core/base/config.hpp"
#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/ring/ring_pack.hpp"

namespace clatter::dynamics {

/// The rings of `contact`, from the highest to the lowest; the layer of `options`, if it has one,
/// gets them. InputError "file:line: contact.ring[0].key: ...".
std::vector<RingSpec> read_rings(const Config& contact, film::PistonLinerOptions& options);

/// Adds the load of the gas behind the rings to those of the layer on the liner.
void load_layer_rings(const std::vector<RingSpec>& rings, const TimeFunction& gas,
                      film::LinerLayerOptions& layer);

/// Friction of the rings, nullptr where none has any. @param gas the cylinder's pressure, when it
/// has one.
std::unique_ptr<ForceElement> ring_pack(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, const std::optional<Spline>& gas);

}  // namespace clatter::dynamics
