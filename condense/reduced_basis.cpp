#include "condense/reduced_basis.hpp"

#include <algorithm>

#include "modal/dense_product.hpp"
#include "modal/symmetric_product.hpp"

namespace clatter::condense {

Eigen::MatrixXd project(const PartitionedMatrix& A, const ReducedBasis& basis) {
  constexpr Eigen::Index kBlock = 64;
  const modal::SymmetricProduct interior(A.ii);
  const SparseMatrix bi = A.ib.transpose();
  Eigen::MatrixXd out(basis.size(), basis.size());
  for (Eigen::Index first = 0; first < basis.size(); first += kBlock) {
    const Eigen::Index count = std::min(kBlock, basis.size() - first);
    const Eigen::MatrixXd V_i = basis.V_i.middleCols(first, count);
    const Eigen::MatrixXd V_b = basis.V_b.middleCols(first, count);
    Eigen::MatrixXd image_i = interior * V_i;
    image_i += A.ib * V_b;
    const Eigen::MatrixXd image_b = bi * V_i + A.bb * V_b;
    out.middleCols(first, count) = modal::transposed_product(basis.V_i, image_i) +
                                   modal::transposed_product(basis.V_b, image_b);
  }
  return 0.5 * (out + out.transpose());
}

Eigen::VectorXd project_load(const Eigen::VectorXd& load, const DofPartition& partition,
                             const ReducedBasis& basis) {
  const Eigen::VectorXd interior = load(partition.interior);
  const Eigen::VectorXd boundary = load(partition.boundary);
  return basis.V_i.transpose() * interior + basis.V_b.transpose() * boundary;
}

std::vector<int> independent_columns(const Eigen::MatrixXd& M_rr, int protected_count,
                                     double tolerance) {
  const Eigen::Index r = M_rr.rows();
  Eigen::MatrixXd L = Eigen::MatrixXd::Zero(r, r);  // rows of the kept columns' Cholesky factor
  std::vector<int> kept;
  for (Eigen::Index j = 0; j < r; ++j) {
    const auto rank = static_cast<Eigen::Index>(kept.size());
    Eigen::VectorXd row = M_rr.col(j)(kept);
    L.topLeftCorner(rank, rank).triangularView<Eigen::Lower>().solveInPlace(row);
    const double left = M_rr(j, j) - row.squaredNorm();
    if (j >= protected_count && left <= tolerance * M_rr(j, j)) continue;
    L.row(rank).head(rank) = row.transpose();
    L(rank, rank) = std::sqrt(std::max(left, 1e-300));
    kept.push_back(static_cast<int>(j));
  }
  return kept;
}

void select_columns(ReducedBasis& basis, const std::vector<int>& kept) {
  if (static_cast<Eigen::Index>(kept.size()) == basis.size()) return;
  basis.V_b = basis.V_b(Eigen::all, kept).eval();
  basis.V_i = basis.V_i(Eigen::all, kept).eval();
}

}  // namespace clatter::condense
