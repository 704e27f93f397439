// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/reduced_basis.hpp"

#include <algorithm>
#include <utility>

#include "core/sparse/dense_product.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::condense {

using Eigen::Index;
using Eigen::MatrixXd;

ReducedBasis::ReducedBasis(const PartitionedModel& part,
                           std::shared_ptr<const sparse::Factor> factor_ii)
    : part_(&part), factor_(std::move(factor_ii)) {
  shapes.resize(part.K.ib.rows(), 0);
}

MatrixXd ReducedBasis::interior(const Eigen::Ref<const MatrixXd>& q) const {
  const MatrixXd load = part_->K.ib * q.topRows(boundary());
  MatrixXd u = -factor_->solve(load);
  sparse::add_product(1.0, shapes, q.bottomRows(shapes.cols()), u);
  return u;
}

MatrixXd ReducedBasis::at_boundary(const Eigen::Ref<const MatrixXd>& f_i,
                                   const Eigen::Ref<const MatrixXd>& f_b) const {
  return f_b - factor_->boundary_product(f_i);
}

MatrixXd ReducedBasis::project(const Eigen::Ref<const MatrixXd>& f_i,
                               const Eigen::Ref<const MatrixXd>& f_b) const {
  MatrixXd out(size(), f_i.cols());
  out.topRows(boundary()) = at_boundary(f_i, f_b);
  out.bottomRows(shapes.cols()) = part_->team().sum(sparse::transposed_product(shapes, f_i));
  return out;
}

MatrixXd ReducedBasis::congruence(const SparseMatrix& A) const {
  constexpr Index kBlock = 64;
  const Index n_b = boundary(), r = size();
  const DofPartition& dofs = part_->dofs;
  // A u for columns u with these interior rows and, at most, those of the boundary.
  const auto force = [&](const MatrixXd& u_i, const MatrixXd& u_b) -> MatrixXd {
    MatrixXd u(A.rows(), u_i.cols());
    u(dofs.interior, Eigen::all) = u_i;
    u(dofs.boundary, Eigen::all) = u_b;
    return multiply_symmetric(A, u);
  };
  MatrixXd out(r, r);
  for (Index first = 0; first < n_b; first += kBlock) {
    const Index count = std::min(kBlock, n_b - first);
    const MatrixXd q = MatrixXd::Identity(r, n_b).middleCols(first, count);
    const MatrixXd f = force(interior(q), q.topRows(n_b));
    const MatrixXd f_i = f(dofs.interior, Eigen::all), f_b = f(dofs.boundary, Eigen::all);
    out.middleCols(first, count) = project(f_i, f_b);
  }
  for (Index first = 0; first < shapes.cols(); first += kBlock) {
    const Index count = std::min(kBlock, shapes.cols() - first);
    const MatrixXd f = force(shapes.middleCols(first, count), MatrixXd::Zero(n_b, count));
    out.block(n_b, n_b + first, shapes.cols(), count) =
        sparse::transposed_product(shapes, MatrixXd(f(dofs.interior, Eigen::all)));
  }
  out.topRightCorner(n_b, r - n_b) = out.bottomLeftCorner(r - n_b, n_b).transpose();
  return 0.5 * (out + out.transpose());
}

ReducedMatrices project(const PartitionedModel& part, const StaticReduction& statics,
                        const ReducedBasis& basis) {
  constexpr Index kBlock = 64;
  const auto stiffness = part.interior().stiffness({}), mass = part.interior().mass({});
  const sparse::RowTeam& team = part.team();
  const SparseMatrix M_bi = part.M.ib.transpose();
  const Index n_b = basis.boundary(), r = basis.size(), k = r - n_b;
  ReducedMatrices out;
  out.M_rr = out.K_rr = MatrixXd::Zero(r, r);
  out.M_rr.topLeftCorner(n_b, n_b) = statics.M_bb;
  out.K_rr.topLeftCorner(n_b, n_b) = statics.K_bb;
  for (Index first = 0; first < k; first += kBlock) {
    const Index count = std::min(kBlock, k - first);
    const auto X = basis.shapes.middleCols(first, count);
    const auto known = basis.shapes.leftCols(first + count);
    MatrixXd image = *mass * X;
    out.M_rr.block(0, n_b + first, n_b, count) = basis.at_boundary(image, team.sum(M_bi * X));
    out.M_rr.block(n_b, n_b + first, known.cols(), count) =
        team.sum(sparse::transposed_product(known, image));
    image = *stiffness * X;
    out.K_rr.block(n_b, n_b + first, known.cols(), count) =
        team.sum(sparse::transposed_product(known, image));
  }
  out.M_rr.triangularView<Eigen::StrictlyLower>() = out.M_rr.transpose();
  out.K_rr.triangularView<Eigen::StrictlyLower>() = out.K_rr.transpose();
  return out;
}

}  // namespace clatter::condense
