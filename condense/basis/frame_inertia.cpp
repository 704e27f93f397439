// SPDX-License-Identifier: GPL-3.0-or-later
#include "condense/basis/frame_inertia.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "condense/basis/row_inertia.hpp"
#include "core/base/error.hpp"
#include "core/fe/assemble.hpp"
#include "core/sparse/dense_product.hpp"
#include "core/sparse/symmetric_product.hpp"

namespace clatter::condense {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// T^T (m x I_3) T, lower triangle.
SparseMatrix with_directions(const SparseMatrix& m, const SparseMatrix& T) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < m.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(m, j); it; ++it)
      for (int d = 0; d < 3; ++d) {
        const int row = 3 * static_cast<int>(it.row()) + d, column = 3 * j + d;
        entries.emplace_back(row, column, it.value());
        if (row != column) entries.emplace_back(column, row, it.value());
      }
  SparseMatrix M(T.rows(), T.rows());
  M.setFromTriplets(entries.begin(), entries.end());
  const SparseMatrix MT = M * T;
  const SparseMatrix all = SparseMatrix(T.transpose()) * MT;
  return all.triangularView<Eigen::Lower>();
}

double largest_entry(const SparseMatrix& A) {
  return A.nonZeros() > 0 ? A.coeffs().abs().maxCoeff() : 0.0;
}

bool gives_back(const SparseMatrix& m, const fe::FeModel& model) {
  const SparseMatrix rest = with_directions(m, model.T) - model.M;
  return largest_entry(rest) <= 1e-10 * largest_entry(model.M);
}

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

double difference(const MatrixXd& found, const MatrixXd& expected) {
  return (found - expected).norm() / expected.norm();
}

}  // namespace

SparseMatrix without_directions(const SparseMatrix& M) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < M.outerSize(); j += 3)
    for (SparseMatrix::InnerIterator it(M, j); it; ++it)
      if (it.row() % 3 == 0) entries.emplace_back(it.row() / 3, j / 3, it.value());
  SparseMatrix m(M.rows() / 3, M.cols() / 3);
  m.setFromTriplets(entries.begin(), entries.end());
  return m;
}

SparseMatrix nodal_mass(const fe::FeModel& model, const std::function<SparseMatrix()>& direct,
                        const std::function<bool(const SparseMatrix& m)>& gives_back) {
  if (model.T.rows() == model.size()) {
    const SparseMatrix m = direct();
    if (gives_back(m)) return m;
  }
  if (!model.cells.blocks.empty()) {
    mesh::Mesh mesh;
    mesh.name = model.name;
    mesh.nodes = model.nodes;
    mesh.regions = model.cells.regions;
    mesh.cells = model.cells.blocks;
    const fe::NodePattern pattern = fe::node_pattern(mesh);
    for (const auto form : {fe::MassForm::kConsistent, fe::MassForm::kHrz}) {
      const SparseMatrix m =
          without_directions(fe::assemble(mesh, model.cells.materials, pattern, form).M);
      if (gives_back(m)) return m;
    }
  }
  throw InputError(fmt::format(
      "{}: inertia_invariants: found a mass that is not that of the cells (point masses, "
      "imported matrices), expected one",
      model.name));
}

SparseMatrix nodal_mass(const fe::FeModel& model) {
  return nodal_mass(
      model, [&] { return without_directions(model.M); },
      [&](const SparseMatrix& m) { return gives_back(m, model); });
}

rom::InertiaInvariants frame_inertia(const PartitionedModel& part, const ReducedBasis& basis) {
  if (part.shared) return frame_inertia_of_rows(part, basis);
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

double inertia_error(const rom::ReducedModel& reduced, bool free_body) {
  const rom::InertiaInvariants& found = reduced.inertia;
  double error = difference(found.product[0] + found.product[4] + found.product[8], reduced.M_rr);
  if (!free_body) return error;
  const MatrixXd momentum = reduced.M_rr * reduced.rigid;
  for (size_t k = 0; k < 3; ++k) {
    const size_t l = (k + 1) % 3, j = (k + 2) % 3;  // a rotation about j moves k towards l
    error = std::max(error, difference(found.first[k], momentum.col(static_cast<Index>(k))));
    error = std::max(error, difference(found.moment[3 * k + l] - found.moment[3 * l + k],
                                       momentum.col(static_cast<Index>(3 + j))));
  }
  // Of the mass matrix: a lumped one has more inertia than the cells.
  const Eigen::Matrix3d about_origin =
      reduced.rigid.rightCols(3).transpose() * momentum.rightCols(3);
  const Eigen::Matrix3d place =
      0.5 * about_origin.trace() * Eigen::Matrix3d::Identity() - about_origin;
  return std::max(error, difference(found.place, place));
}

}  // namespace clatter::condense
