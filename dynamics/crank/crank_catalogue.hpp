// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of the crankshaft.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kCrankEffects{
    EffectEntry{"crankshaft", "m, m, I_d, I_d, I_p: a rigid body in axes that do not turn",
                "[crank]: mass_kg, diametral_kg_m2, polar_kg_m2, centre_mm", "[crank]"},
    EffectEntry{"gyroscopic moments of the crank", "-I_p w rz', I_p w ry' (Genta 2005, chapter 2)",
                "crank.polar_kg_m2", "crank.polar_kg_m2 > 0 with [[crank.bearing]]"},
    EffectEntry{"unbalance of the crank", "U (w^2 u - w' J u) (Genta 2005, chapter 2)",
                "[[crank.unbalance]]", "[[crank.unbalance]]"},
    EffectEntry{"free rotation of the crank", "I_p rx'' = torques of pins, journals and load",
                "crank.polar_kg_m2, [crank.load]", "crank.speed = \"free\""},
};

}  // namespace clatter::dynamics
