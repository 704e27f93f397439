// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Supports, loads and cases of recipe_text.hpp.
#include <string>

#include "mesh/deck/recipe/names.hpp"

namespace clatter::mesh::deck {

/// [[support]] tables of one support: nodes together, each point separately.
std::string support_text(const Support& support, RecipeNames& names);

/// Supports of the first step, then [[load]] and [[case]] of every step with the same supports.
std::string write_steps(Deck& deck, RecipeNames& names);

}  // namespace clatter::mesh::deck
