// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/row_team.hpp"

namespace clatter::sparse {

void RowTeam::sum(double* /*values*/, int64_t /*count*/) const {}
void RowTeam::least(double* /*values*/, int64_t /*count*/) const {}
void RowTeam::agree(double* /*values*/, int64_t /*count*/) const {}
RowMatrix RowTeam::gather(const RowMatrix& rows) const { return rows; }
std::vector<int32_t> RowTeam::gather(const std::vector<int32_t>& values) const { return values; }

Eigen::MatrixXd RowTeam::sum(Eigen::MatrixXd part) const {
  sum(part.data(), part.size());
  return part;
}

double RowTeam::sum(double part) const {
  sum(&part, 1);
  return part;
}

double RowTeam::least(double value) const {
  least(&value, 1);
  return value;
}

Eigen::VectorXd RowTeam::norms(const Eigen::Ref<const Eigen::MatrixXd>& x) const {
  Eigen::VectorXd squares = x.colwise().squaredNorm();
  sum(squares.data(), squares.size());
  return squares.cwiseSqrt();
}

const RowTeam& one_process() {
  static const RowTeam alone;
  return alone;
}

}  // namespace clatter::sparse
