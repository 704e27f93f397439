// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// [[contact.ring]]: the piston rings, for the layer of oil on the liner and for friction.
#include <memory>
#include <optional>
#include <vector>

#include "core/keys/keys.hpp"
#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/cylinder/cylinder_elements.hpp"
#include "dynamics/ring/ring_pack.hpp"

namespace clatter::dynamics {

struct RingTable : RingSpec {
  std::optional<double> tangential;  // force in the closed ring, instead of the load [N]
};
const keys::Keys<RingTable>& ring_keys();

/// The rings of the table `contact`, from the highest to the lowest. InputError for rings that are
/// not above the skirt of `options` and each other.
std::vector<RingSpec> checked_rings(const Config& contact, const std::vector<RingTable>& found,
                                    const film::PistonLinerOptions& options);

/// Adds the load of the gas behind the rings to those of the layer on the liner.
void load_layer_rings(const std::vector<RingSpec>& rings, const TimeFunction& gas,
                      film::LinerLayerOptions& layer);

/// Friction of the rings, nullptr where none has any. @param gas the cylinder's pressure, when it
/// has one.
std::unique_ptr<ForceElement> ring_pack(const CylinderBodies& bodies, const SliderCrank& crank,
                                        const PinNode& pin, const std::optional<Spline>& gas);

}  // namespace clatter::dynamics
