// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/pencil_modes.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "core/base/error.hpp"

namespace clatter::condense {

PencilModes modes_of(const rom::ReducedModel& model) {
  const Eigen::LLT<Eigen::MatrixXd> factor(model.M_rr);
  if (factor.info() != Eigen::Success)
    throw InputError(
        fmt::format("{}: M_rr: found a matrix that is not positive definite, expected "
                    "positive masses",
                    model.name));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solved(model.K_rr, model.M_rr);
  PencilModes modes{solved.eigenvectors(), solved.eigenvalues()};
  // Rounding of a zero eigenvalue, n eps lambda_max, with a margin.
  const double zero = 1e-14 * model.size() * modes.Lambda.maxCoeff();
  modes.rigid = static_cast<int>((modes.Lambda.array() <= zero).count());
  return modes;
}

}  // namespace clatter::condense
