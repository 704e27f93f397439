// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Materials of recipe.hpp.
#include "mesh/deck/recipe/recipe.hpp"

namespace clatter::mesh::deck {

/// [material] tables: regions with the same material, axes and integration share one. [[shell]]
/// tables, which name them.
void add_materials(const Deck& deck, Recipe& recipe);

}  // namespace clatter::mesh::deck
