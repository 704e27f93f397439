// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the truncation of reduced parts costs the modes of their assembly.
#include <Eigen/Core>
#include <string>

#include "core/fe/fe_model.hpp"

namespace clatter::fe {

/// Relative errors of frequencies, all from above: modes x parts, in the order of `parts`. Of a
/// part with truncation F and the cut-off lambda_c, to first order (ReducedModel::truncation)
///   lambda / 2 x^T F x / (1 - lambda / lambda_c),
/// where the last factor bounds it. NaN for a part whose F is not known, and for modes above its
/// cut-off. Estimates up to 0.01 are within a factor of two; above 0.05 they are too low.
/// @param values lambda [rad2/s2], one for each mode.
/// @param vectors n x modes, of unit modal mass.
Eigen::MatrixXd part_errors(const FeParts& parts, const Eigen::VectorXd& values,
                            const Eigen::MatrixXd& vectors);

/// Names of the parts whose truncation is not known, joined by commas; empty when all are.
std::string parts_without_truncation(const FeParts& parts);

/// Warns of them, with the way out.
void warn_of_unknown_errors(const FeParts& parts, const std::string& model);

}  // namespace clatter::fe
