// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/frame_inertia.hpp"

#include <algorithm>

#include "condense/basis/nodal_mass.hpp"
#include "core/sparse/dense_product.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Columns of T V, split by direction.
class NodalColumns {
 public:
  NodalColumns(const PartitionedModel& part, const ReducedBasis& basis)
      : part_(part), basis_(basis) {}

  std::array<MatrixXd, 3> operator()(Index first, Index count) const {
    MatrixXd q(part_.full.size(), count);
    const MatrixXd unit = MatrixXd::Identity(basis_.size(), basis_.size()).middleCols(first, count);
    q(part_.dofs.interior, Eigen::all) = basis_.interior(unit);
    q(part_.dofs.boundary, Eigen::all) = unit.topRows(basis_.boundary());
    const MatrixXd u = part_.full.T * q;
    std::array<MatrixXd, 3> by_direction;
    for (size_t d = 0; d < 3; ++d)
      by_direction[d] =
          u(Eigen::seqN(static_cast<Index>(d), u.rows() / 3, Eigen::fix<3>), Eigen::all);
    return by_direction;
  }

 private:
  const PartitionedModel& part_;
  const ReducedBasis& basis_;
};

}  // namespace

rom::InertiaInvariants frame_inertia(const PartitionedModel& part, const ReducedBasis& basis) {
  constexpr Index kBlock = 256;
  const SparseMatrix m = nodal_mass(part.full);
  const sparse::SymmetricProduct mass(m);
  const MatrixXd x = part.full.nodes;
  const MatrixXd m_x = mass * x;
  const VectorXd m_1 = mass * VectorXd::Ones(x.rows());
  const NodalColumns columns(part, basis);
  const Index r = basis.size();
  rom::InertiaInvariants out;
  out.place = x.transpose() * m_x;
  for (VectorXd& vector : out.first) vector.resize(r);
  for (VectorXd& vector : out.moment) vector.resize(r);
  for (MatrixXd& matrix : out.product) matrix.resize(r, r);
  for (Index right = 0; right < r; right += kBlock) {
    const Index n_right = std::min(kBlock, r - right);
    const std::array<MatrixXd, 3> U = columns(right, n_right);
    std::array<MatrixXd, 3> m_U;
    for (size_t k = 0; k < 3; ++k) {
      m_U[k] = mass * U[k];
      out.first[k].segment(right, n_right) = U[k].transpose() * m_1;
      for (size_t l = 0; l < 3; ++l)
        out.moment[3 * l + k].segment(right, n_right) =
            U[k].transpose() * m_x.col(static_cast<Index>(l));
    }
    for (Index left = 0; left < r; left += kBlock) {
      const Index n_left = std::min(kBlock, r - left);
      const std::array<MatrixXd, 3> other = left == right ? U : columns(left, n_left);
      for (size_t k = 0; k < 3; ++k)
        for (size_t l = k; l < 3; ++l)
          out.product[3 * k + l].block(left, right, n_left, n_right) =
              sparse::transposed_product(other[k], m_U[l]);
    }
  }
  complete_products(out);
  return out;
}

void complete_products(rom::InertiaInvariants& invariants) {
  for (size_t k = 0; k < 3; ++k) {
    MatrixXd& own = invariants.product[4 * k];
    own = (0.5 * (own + own.transpose())).eval();
    for (size_t l = k + 1; l < 3; ++l)
      invariants.product[3 * l + k] = invariants.product[3 * k + l].transpose();
  }
}

}  // namespace clatter::condense
