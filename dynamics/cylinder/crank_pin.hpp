// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The crank pin as a point of the crankshaft.
#include <memory>

#include "dynamics/body/mechanism_port.hpp"
#include "dynamics/cylinder/cylinder_bodies.hpp"
#include "dynamics/given/crank.hpp"

namespace clatter::dynamics {

/// The cylinder's crank pin: on the crankshaft's axis in its main bearings; without those, on the
/// block's crank centre (crank_centre.hpp), or fixed. It turns with the clock, a free one besides.
std::unique_ptr<Port> crank_pin(const CylinderBodies& bodies, const SliderCrank& crank);

}  // namespace clatter::dynamics
