#pragma once
// Why a matrix of a model could not be factorised, for people.
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::modes {

/// The same error with the model's name, what `matrix` it was ("K - sigma M"), where it stopped
/// (node, place, direction; the body when there are several) and the likely cause: an unknown
/// without stiffness or mass, a body that nothing holds, or a mechanism.
/// @param left the DoF of the model behind each row of the matrix.
sparse::NotPositiveDefinite explained(const fe::FeModel& model, const std::string& matrix,
                                      const std::vector<int32_t>& left,
                                      const sparse::NotPositiveDefinite& error);

}  // namespace clatter::modes
