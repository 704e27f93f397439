// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/row_team.hpp"

namespace clatter::sparse {

void RowTeam::sum(double* /*values*/, int64_t /*count*/) const {}
void RowTeam::least(double* /*values*/, int64_t /*count*/) const {}
void RowTeam::agree(double* /*values*/, int64_t /*count*/) const {}
RowMatrix RowTeam::gather(RowMatrix rows) const { return rows; }
std::vector<int32_t> RowTeam::gather(std::vector<int32_t> values) const { return values; }

Eigen::MatrixXd RowTeam::gather_at(const std::vector<int32_t>& places, const Eigen::MatrixXd& rows,
                                   Eigen::Index size) const {
  const std::vector<int32_t> at = gather(places);
  const RowMatrix all = gather(RowMatrix(rows));
  Eigen::MatrixXd out(size, rank() == 0 ? all.cols() : 0);
  if (rank() == 0) out(at, Eigen::all) = all;
  return out;
}

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
