// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The effects of chains.
#include "dynamics/component/effect_entry.hpp"

namespace clatter::dynamics {

inline constexpr std::array kChainEffects{
    EffectEntry{"chain",
                "eq. (3) of each link; joints F = k <|d| - c> d / |d| + c_d d', "
                "M = mu r k <|d| - c> s(r w / v_0)",
                "[[chain]]: links, pitch_mm, [chain.inner], [chain.outer], [chain.joint]",
                "[[chain]]", "joints: 4 % of the timing drive"},
    EffectEntry{"chain on a sprocket or guide",
                "Winkler mattress on the exact profile: p = b d (1 + chi d') (Hunt and Crossley "
                "1975), Coulomb friction",
                "[[chain.over]], [chain.over.contact]", "[[chain.over]]",
                "30 % of the timing drive"},
};

}  // namespace clatter::dynamics
