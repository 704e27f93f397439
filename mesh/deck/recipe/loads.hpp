// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Supports, loads and cases of recipe.hpp.
#include "mesh/deck/recipe/names.hpp"
#include "mesh/deck/recipe/recipe.hpp"

namespace clatter::mesh::deck {

/// [[support]] tables of one support: nodes together, each point separately.
void add_support(const Support& support, RecipeNames& names, recipe::File& file);

/// Supports of the first step, then [[load]] and [[case]] of every step with the same supports.
void add_steps(Deck& deck, RecipeNames& names, Recipe& recipe);

}  // namespace clatter::mesh::deck
