#pragma once
// What is done with modes once they are found: residuals, the order of the unknowns, signs.
#include "modal/eigen/eigen_solver.hpp"
#include "modal/symmetric_product.hpp"

namespace clatter::modal {

/// |K x - lambda M x| / (|lambda - sigma| |M x|) of each mode; K, M and vectors in one order.
Eigen::VectorXd residuals_of(const SymmetricProduct& K, const SymmetricProduct& M,
                             const ModeSet& modes);

/// Throws NumericsError naming the first mode whose residual is above `most`.
void refuse_residuals(const ModeSet& modes, double most);

/// Puts the vectors' rows where the unknowns stand, row order[i] from row i, makes the largest
/// entry of each vector positive, and counts the rigid modes.
void present(const std::vector<int64_t>& order, ModeSet& modes);

}  // namespace clatter::modal
