// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/nodal_matrix.hpp"

#include "assembly/constraint/support.hpp"

namespace clatter::assembly {

std::vector<MatrixRow> rows_of(const MatrixSpec& spec, const mesh::Mesh& mesh,
                               const DofNumbers& numbers) {
  std::vector<MatrixRow> rows;
  for (const EquationSpec::Term& term : spec.terms) {
    const NodeOrPoint owner = selected(term.selection, mesh, numbers)[0];
    rows.push_back({numbers.of(owner, term.direction), term.direction, numbers.position(owner)});
  }
  return rows;
}

Eigen::Matrix<double, 6, 6> rigid_mass_of(const Recipe& recipe, const mesh::Mesh& mesh,
                                          const DofNumbers& numbers,
                                          const Eigen::MatrixXd& nodal_rigid) {
  Eigen::Matrix<double, 6, 6> total = Eigen::Matrix<double, 6, 6>::Zero();
  for (const MatrixSpec& spec : recipe.matrices) {
    if (!spec.is_mass) continue;
    std::vector<int32_t> ids;
    for (const MatrixRow& row : rows_of(spec, mesh, numbers)) ids.push_back(row.id);
    const Eigen::MatrixXd R = nodal_rigid(ids, Eigen::all);
    total += R.transpose() * spec.values * R;
  }
  return total;
}

}  // namespace clatter::assembly
