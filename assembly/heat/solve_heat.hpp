// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The steady temperature fields of a recipe.
#include <map>
#include <string>

#include "assembly/constraint/part_data.hpp"
#include "core/fe/fe_model.hpp"
#include "core/fe/pattern.hpp"

namespace clatter::assembly {

/// Solves K T = q of core/fe/heat.hpp for each [[heat]]. Both sides of a tie or bolt have the same
/// temperature, T_slave = P T_master by the projection of the displacements (tie/mortar.hpp),
/// unless the heat has a conductance for it. Prints the range of temperatures and the heat through
/// each boundary. InputError for a body whose temperature nothing fixes and for conflicts of ties
/// and fixed temperatures; NumericsError when the heat that enters and leaves does not balance to
/// 1e-8.
/// @param pattern of the mesh.
std::map<std::string, fe::HeatField> solve_heat(const PartData& part,
                                                const fe::NodePattern& pattern);

}  // namespace clatter::assembly
