// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the steps from a recipe to a model read.
#include "assembly/coupling/dof_numbers.hpp"
#include "assembly/recipe/recipe.hpp"
#include "assembly/surface/surface_cache.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

/// A part before its model is built: references to data that outlives it.
struct PartData {
  const mesh::Mesh& mesh;
  const Recipe& recipe;  // checked against the mesh
  const DofNumbers& numbers;
  SurfaceCache& surfaces;
};

}  // namespace clatter::assembly
