// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/export/pencil_modes.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::condense {

PencilModes modes_of(const rom::ReducedModel& model) {
  const dense::Eigenpairs solved = dense::symmetric_eigen(model.K_rr, model.M_rr);
  if (!solved.ok)
    throw InputError(
        fmt::format("{}: M_rr: found a matrix that is not positive definite, expected "
                    "positive masses",
                    model.name));
  PencilModes modes{solved.vectors, solved.values};
  // Rounding of a zero eigenvalue, n eps lambda_max, with a margin.
  const double zero = 1e-14 * model.size() * modes.Lambda.maxCoeff();
  modes.rigid = static_cast<int>((modes.Lambda.array() <= zero).count());
  return modes;
}

PencilModes elastic_modes_of(const rom::ReducedModel& model) {
  const PencilModes all = modes_of(model);
  if (all.elastic() == 0)
    throw InputError(fmt::format("{}: found no elastic mode, expected one or more", model.name));
  return {all.Phi.rightCols(all.elastic()), all.Lambda.tail(all.elastic()), 0};
}

Eigen::MatrixXd damping_of(const rom::ReducedModel& model) {
  Eigen::MatrixXd D = model.alpha * model.K_rr + model.beta * model.M_rr;
  if (model.modal_damping.empty() && model.loss.rows() == 0) return D;
  const PencilModes modes = modes_of(model);
  const Eigen::MatrixXd M_Phi = model.M_rr * modes.Phi;
  Eigen::VectorXd rates = model.damping_rates(modes.Lambda, modes.Phi);
  rates.array() -= model.alpha * modes.Lambda.array() + model.beta;  // in D already
  rates.head(modes.rigid).setZero();
  return D + M_Phi * rates.asDiagonal() * M_Phi.transpose();
}

}  // namespace clatter::condense
