// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace clatter::dense {

/// e^A, n x n, by scaling, the rational function [13/13] of Pade and squaring (Higham 2005). NaN
/// where A is not finite.
Eigen::MatrixXd exponential(Eigen::MatrixXd A);

}  // namespace clatter::dense
