// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What reduced parts add to the model: matrices, loads, mass and the rows of their skins.
#include "assembly/constraint/part_data.hpp"
#include "assembly/load/load_vectors.hpp"
#include "assembly/load/mass_properties.hpp"
#include "core/fe/assemble.hpp"

namespace clatter::assembly {

/// Matrices B^T A B of all parts, q = B u, on all ids; lower triangles.
struct PartMatrices {
  SparseMatrix M, K;
  SparseMatrix loss;  // 0 x 0 where no part has one
};
PartMatrices part_matrices(const PartData& part);

/// Adds their mass properties.
void add_parts(MassMoments& moments, const PartData& part);

/// Adds their loads.
void add_loads_of_parts(LoadVectors& loads, const PartData& part, const Elimination& elimination);

/// Adds the nodes of their skins with their rows of T, surfaces of these, and FeModel::parts.
/// Surfaces: the part's name and _skin, and those of Skin::faces as the part names them; where the
/// mesh has no `skin`, that of all parts. InputError for two of one name, when T would have more
/// entries than an index can count.
void add_skins(fe::FeModel& model, const PartData& part, const Elimination& elimination);

}  // namespace clatter::assembly
