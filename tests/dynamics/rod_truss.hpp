// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A connecting rod of point masses and springs.
#include "tests/dynamics/truss.hpp"

namespace clatter::dynamics::testing {

inline constexpr double kRodLength = 0.210;  // [m]

/// Node 0 is the big end at the origin, node 1 the small end at (0, 0, 210 mm); between them three
/// frames of four masses, 2.2 kg in all. @param skew of the masses of each frame: 0 is symmetric in
/// x and y.
Truss rod_truss(double stiffness, double skew = 0.0);

/// Its reduced model with the sets "big_end" and "small_end".
rom::ReducedModel rod_model(const Truss& truss);

}  // namespace clatter::dynamics::testing
