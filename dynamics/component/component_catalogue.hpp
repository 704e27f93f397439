// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of bodies, joints, springs, mounts, stops, bearings of the crankshaft, and gravity.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kComponentEffects{
    EffectEntry{"elastic body",
                "eq. (14): mu eta'' + delta eta' + omega^2 eta = phi^T f, mode by mode",
                "rom: its reduced model", "model = \"elastic\" of [piston], [block], [[body]]",
                "elastic piston: 25 % of the truck diesel's slap"},
    EffectEntry{"large motion of a reduced part",
                "eq. (9): Coriolis, centrifugal and Euler forces by inertia invariants "
                "(Shabana, chapter 5)",
                "rom with inertia_invariants = true", "body.motion = \"space\" or body.drive"},
    EffectEntry{"rigid body",
                "eq. (3): constant mass in a plane; A = R(p) A_f(t), L' = moment in "
                "space",
                "mass_kg, inertia_kg_m2", "[[rigid_body]]"},
    EffectEntry{"drive", "none: the angle is given over time", "speed_rpm or table", "[[drive]]"},
    EffectEntry{"elastic joints", "F = k d + c d'", "stiffness_n_m, damping_n_s_m or table",
                "[[bushing]]"},
    EffectEntry{"springs", "F = k (l - l_0) + c l' along the line of two points",
                "stiffness_n_m, damping_n_s_m, length_mm", "[[spring]]"},
    EffectEntry{"mounts", "F = -k u - c u' per node and axis", "stiffness_n_m, damping_n_s_m, sets",
                "[[mount]]"},
    EffectEntry{"stops",
                "N = k d^n (1 + chi d') (Hunt and Crossley 1975) with Coulomb friction; rigid: "
                "u -> -e u, impacts together (Moreau 1988, Smith et al. 2012)",
                "stiffness_n_m or restitution", "[[stop]]"},
    EffectEntry{
        "rolling discs",
        "N = k s (1 + chi s'), F = -mu N v_t / sqrt(v_t^2 + v_s^2) at the edge's lowest point",
        "radius_mm, stiffness_n_m", "[[rolling_disc]]"},
    EffectEntry{
        "main bearings",
        "linear, a table, impedances (Butenschoen 1976; Childs, Moes and van Leeuwen 1977), "
        "or Reynolds' equation on a grid",
        "[[crank.bearing]]", "[[crank.bearing]]"},
    EffectEntry{"gravity", "f = -phi^T M r g", "nothing", "gravity_m_s2 > 0",
                "3 % of the truck diesel's slap"},
};

}  // namespace clatter::dynamics
