// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/spring.hpp"

namespace clatter::assembly {
namespace {

SparseMatrix lower_of(const SparseMatrix& full) { return full.triangularView<Eigen::Lower>(); }

}  // namespace

void add_springs(const std::vector<SpringSpec>& springs, const std::vector<Functional>& elongations,
                 const Elimination& elimination, CoordinateBlocks& K) {
  if (springs.empty()) return;
  const auto n = static_cast<Eigen::Index>(springs.size());
  std::vector<Eigen::Triplet<double, int32_t>> entries;
  Eigen::VectorXd stiffness(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Functional& elongation = elongations[static_cast<size_t>(i)];
    stiffness[i] = springs[static_cast<size_t>(i)].stiffness;
    for (size_t k = 0; k < elongation.dofs.size(); ++k)
      entries.emplace_back(static_cast<int32_t>(i), elongation.dofs[k], elongation.values[k]);
  }
  SparseMatrix C(n, elimination.T.rows());  // duplicate terms are summed
  C.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix t = C * elimination.T;
  const SparseMatrix force = stiffness.asDiagonal() * t;  // of the springs, n_springs x n
  K.qq += lower_of(SparseMatrix(t.transpose()) * force);
  if (elimination.supports() == 0) return;
  const SparseMatrix t_s = C * elimination.T_s;
  const SparseMatrix force_s = stiffness.asDiagonal() * t_s;
  K.sq += SparseMatrix(t_s.transpose()) * force;
  K.ss += lower_of(SparseMatrix(t_s.transpose()) * force_s);
}

}  // namespace clatter::assembly
