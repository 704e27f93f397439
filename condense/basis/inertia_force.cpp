// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/inertia_force.hpp"

namespace clatter::condense {

using Eigen::MatrixXd;

MatrixXd inertia_force(const PartitionedModel& part, const ReducedBasis& basis) {
  const fe::FeModel& model = part.full;
  const MatrixXd R_i = model.rigid(part.dofs.interior, Eigen::all);
  const MatrixXd R_b = model.rigid(part.dofs.boundary, Eigen::all);
  MatrixXd f_i = part.interior().mass_times(R_i) + part.M.ib * R_b;
  MatrixXd f_b = part.M.bb * R_b + part.team().sum(MatrixXd(part.M.ib.transpose() * R_i));
  if (model.supports.size() > 0) {
    const MatrixXd of_supports = model.supports.M_sq.transpose() * model.supports.rigid;
    f_i += of_supports(part.dofs.interior, Eigen::all);
    f_b += of_supports(part.dofs.boundary, Eigen::all);
  }
  return basis.project(f_i, f_b);
}

}  // namespace clatter::condense
