// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/load/spring.hpp"

namespace clatter::assembly {
namespace {

using Triplets = std::vector<Eigen::Triplet<double, int32_t>>;

SparseMatrix lower_of(const SparseMatrix& full) { return full.triangularView<Eigen::Lower>(); }

/// Adds (C T)^T S (C T) and its blocks with supports; duplicate entries of C and S are summed.
/// @param rows of C and S.
void add_form(Eigen::Index rows, const Triplets& c_entries, const Triplets& s_entries,
              const Elimination& elimination, CoordinateBlocks& A) {
  SparseMatrix C(rows, elimination.T.rows()), S(rows, rows);
  C.setFromTriplets(c_entries.begin(), c_entries.end());
  S.setFromTriplets(s_entries.begin(), s_entries.end());
  const SparseMatrix t = C * elimination.T;
  const SparseMatrix force = S * t;
  A.qq += lower_of(SparseMatrix(t.transpose()) * force);
  if (elimination.supports() == 0) return;
  const SparseMatrix t_s = C * elimination.T_s;
  A.sq += SparseMatrix(t_s.transpose()) * force;
  if (A.ss.rows() > 0) A.ss += lower_of(SparseMatrix(t_s.transpose()) * SparseMatrix(S * t_s));
}

}  // namespace

void add_springs(const std::vector<SpringSpec>& springs, const std::vector<Functional>& elongations,
                 const Elimination& elimination, CoordinateBlocks& K) {
  if (springs.empty()) return;
  Triplets c, s;
  for (size_t i = 0; i < springs.size(); ++i) {
    const auto row = static_cast<int32_t>(i);
    s.emplace_back(row, row, springs[i].stiffness);
    for (size_t k = 0; k < elongations[i].dofs.size(); ++k)
      c.emplace_back(row, elongations[i].dofs[k], elongations[i].values[k]);
  }
  add_form(static_cast<Eigen::Index>(springs.size()), c, s, elimination, K);
}

void add_matrices(const std::vector<MatrixSpec>& matrices, const std::vector<Functional>& dofs,
                  bool of_mass, const Elimination& elimination, CoordinateBlocks& A) {
  Triplets c, s;
  int32_t row = 0;
  for (size_t m = 0; m < matrices.size(); ++m) {
    if (matrices[m].is_mass != of_mass) continue;
    const Eigen::MatrixXd& values = matrices[m].values;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      c.emplace_back(row + static_cast<int32_t>(i), dofs[m].dofs[i], 1.0);
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        if (values(i, j) != 0.0)
          s.emplace_back(row + static_cast<int32_t>(i), row + static_cast<int32_t>(j),
                         values(i, j));
    }
    row += static_cast<int32_t>(values.rows());
  }
  if (row > 0) add_form(row, c, s, elimination, A);
}

}  // namespace clatter::assembly
