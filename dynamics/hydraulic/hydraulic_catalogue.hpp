// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of tensioners and lash adjusters.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kHydraulicEffects{
    EffectEntry{"hydraulic element",
                "F = A (p - p_out) + <force - rate s>, m' = sum rho(p_upstream) Q",
                "sizes, oil, supply of [[tensioner]], [[lash_adjuster]]",
                "model = \"hydraulic\", \"constant_pressure\" or \"constant_force\"",
                "chamber: 10 % of the timing drive"},
    EffectEntry{"oil of the chamber",
                "V = m / rho(p) with free air (Gholizadeh, Burton and Schoenau 2011); leak G dp "
                "(Merritt 1967)",
                "modulus_gpa, free_air, gap_um, viscosity_mpa_s",
                "model = \"hydraulic\" and dry = false"},
    EffectEntry{"check valve",
                "Q = alpha pi d lift sqrt(2/rho) dp / (dp^2 + laminar^2)^(1/4) "
                "(Merritt 1967)",
                "check_valve: seat_mm, lift_mm, discharge",
                "model = \"hydraulic\" and check_valve.ball not \"stuck_shut\""},
    EffectEntry{"relief valve", "Q = gradient (p - p_out - opening)",
                "relief: opening_bar, gradient_ml_s_bar", "relief.opening_bar > 0"},
};

}  // namespace clatter::dynamics
