// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of valve trains.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kValveEffects{
    EffectEntry{"valve train", "m s'' of each valve, follower in its plane, coils of the spring",
                "[[valve]]: lift law, lobe, mass_kg", "valve.model = \"full\"",
                "12 valves: twice the seconds of the timing drive"},
    EffectEntry{"torque of valves", "M = F dy/dtheta, springs and inertia (virtual work)",
                "[[valve]]: lift law, lobe, spring", "valve.model = \"quasi_static\"",
                "10 % of the timing drive"},
    EffectEntry{"valve spring",
                "p = F_0 - k e - c e' + <k_c d + c_c S d'> between n masses: surge and coils that "
                "touch",
                "wire or stiffness_n_m and mass_kg, force_n, to_solid_mm",
                "[[valve_spring]], valve.model = \"full\""},
    EffectEntry{"lash adjuster of valves", "m' = sum rho(p_upstream) Q: see hydraulic element",
                "[valve.lash_adjuster]", "lash_adjuster.model = \"hydraulic\""},
    EffectEntry{"roller on cam", "Winkler mattress on the profile of the lift law",
                "lift law, [valve.follower]", "[[follower]], valve.model = \"full\""},
    EffectEntry{"contacts of valve and follower", "k d (1 + chi d') (Hunt and Crossley 1975)",
                "[valve.seat], ball and pad of [valve.follower]", "valve.model = \"full\""},
    EffectEntry{"follower", "a body with three coordinates in its plane", "[[follower]]",
                "[[follower]]"},
};

}  // namespace clatter::dynamics
