#pragma once
// The stage's one call: mesh and recipe in, checked FE model out.
#include <map>
#include <string>

#include "assembly/recipe.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

struct BuiltModel {
  fe::FeModel model;
  /// dofs, pivots, fixed displacements; errors of mass, centre, inertia against the sum over the
  /// elements; residue of K on rigid motions; error of T on rigid motions; largest entry of T.
  std::map<std::string, double> certificate;
};

/// Assembles, couples, loads and proves a model; `clock` gets a lap a step. InputError for what
/// does not fit the mesh; NumericsError when mass properties or rigid motions are off.
BuiltModel build_fe_model(const mesh::Mesh& mesh, const Recipe& recipe, StepClock& clock);

}  // namespace clatter::assembly
