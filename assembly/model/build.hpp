// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The stage's main call: builds a checked FE model from a mesh and a recipe.
#include "assembly/model/fe_certificate.hpp"
#include "assembly/recipe/recipe.hpp"
#include "core/base/stopwatch.hpp"
#include "core/fe/fe_model.hpp"
#include "core/mesh/mesh.hpp"

namespace clatter::assembly {

struct BuiltModel {
  fe::FeModel model;
  FeCertificate certificate;
};

/// Assembles, constrains, loads and verifies a model; `clock` records one lap per step. InputError
/// for a recipe that does not fit the mesh; NumericsError when mass properties or rigid motions are
/// wrong.
BuiltModel build_fe_model(const mesh::Mesh& mesh, const Recipe& recipe, StepClock& clock);

}  // namespace clatter::assembly
