#pragma once
// The rows of the basis that give the displacements of the skin.
#include <string>
#include <vector>

#include "condense/reduced_basis.hpp"
#include "core/reduced_model.hpp"

namespace clatter::condense {

/// Joins the named surfaces of the model into one skin of quadratic triangles (skin_faces.hpp) and
/// the rows T_skin = T(skin nodes, :) V that recover it. A face that stands in two of them is taken
/// once. InputError for an unknown surface.
Skin recover_skin(const assembly::FeModel& model, const DofPartition& partition,
                  const ReducedBasis& basis, const std::vector<std::string>& surfaces);

}  // namespace clatter::condense
