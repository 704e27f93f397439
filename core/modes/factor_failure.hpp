// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Explains to the user why a matrix of a model could not be factorised.
#include <string>
#include <vector>

#include "core/fe/fe_model.hpp"
#include "core/sparse/factor/supernodal_factor.hpp"

namespace clatter::modes {

/// The same error with the model's name, the `matrix` ("K - sigma M"), where factorisation stopped
/// (node, position, direction; the body if there are several) and the likely cause: a DoF without
/// stiffness or mass, an unsupported body, or a mechanism.
/// @param left DoF of the model for each row of the matrix.
sparse::NotPositiveDefinite explained(const fe::FeModel& model, const std::string& matrix,
                                      const std::vector<int32_t>& left,
                                      const sparse::NotPositiveDefinite& error);

}  // namespace clatter::modes
