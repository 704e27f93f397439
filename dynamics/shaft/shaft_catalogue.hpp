// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of shafts and of torques over angle.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kShaftEffects{
    EffectEntry{"shaft", "rigid slices at its stations, their mass and moments those of the shaft",
                "[[shaft]], [[shaft.section]], [[shaft.disc]]", "[[shaft]]"},
    EffectEntry{"torsion of a shaft", "M = k (a_2 - a_1) + T k (a_2' - a_1'), k = G I_p / l",
                "shear_modulus_gpa, [[shaft.section]]", "shaft.model = \"torsion\" or \"full\""},
    EffectEntry{"bending of a shaft",
                "Timoshenko's beam with the shear factor of Cowper 1966 between stations",
                "youngs_modulus_gpa, [[shaft.section]]", "shaft.model = \"full\"",
                "camshafts: 30 % of the timing drive"},
    EffectEntry{"gyroscopic moments of a shaft", "I_p a' (t' x w) (Genta 2005, chapter 2)",
                "polar_kg_m2", "shaft.model = \"full\""},
    EffectEntry{"bearings of a shaft",
                "impedances (Butenschoen 1976; Childs, Moes and van Leeuwen 1977), a spring, or "
                "F = -K(a') d - C(a') d'",
                "[[shaft.bearing]]", "[[shaft.bearing]] with shaft.model = \"full\""},
    EffectEntry{"unbalance of a disc", "F = -(U a' t)', with its moment on the angle (Lagrange)",
                "unbalance_g_mm, unbalance_deg", "[[shaft.disc]] with unbalance_g_mm"},
    EffectEntry{"phaser", "M = k <|a| - play> + c a' between disc and shaft",
                "[shaft.disc.phaser]: stiffness_n_m_rad, damping, backlash_deg",
                "[shaft.disc.phaser] with shaft.model not \"rigid\""},
    EffectEntry{"torques over angle", "M(angle) by a table, orders, drag and viscous part",
                "value_n_m, table, orders, drag_n_m", "[[torque]]"},
    EffectEntry{"cam torque", "M = -sum n <F_0 + k y + m speed^2 y''> y' (virtual work)",
                "lift law, spring_force_n, spring_stiffness_n_m, mass_kg", "[[cam_torque]]"},
};

}  // namespace clatter::dynamics
