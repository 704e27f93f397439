// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/free_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/dense/qr.hpp"
#include "core/dense/svd.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::fe {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoForce = 1e-10;  // rounding of assembly and elimination leaves some 1e-13
/// Twice the strain energy of a motion of unit mass, over the largest K_ii / M_ii of a reduced
/// model; rounding of the reduction leaves some 1e-17.
constexpr double kNoEnergy = 1e-14;

void join_entries(const SparseMatrix& lower, DofUnion& sets) {
  for (int j = 0; j < lower.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(lower, j); it; ++it)
      if (it.value() != 0.0) sets.join(static_cast<int32_t>(it.row()), j);
}

/// Combinations (6 x p) of motions with the mass matrix R^T M R that are M-orthonormal. A row of
/// points has no rotation about its own line.
MatrixXd moving_combinations(const MatrixXd& mass) {
  const VectorXd scale =
      mass.diagonal().unaryExpr([](double m) { return m > 0.0 ? 1.0 / std::sqrt(m) : 0.0; });
  const dense::Eigenpairs gram =
      dense::symmetric_eigen(scale.asDiagonal() * mass * scale.asDiagonal());
  const Index moving = (gram.values.array() > 1e-12).count();
  return scale.asDiagonal() * gram.vectors.rightCols(moving) *
         gram.values.tail(moving).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Combinations (p x m) of motions that need no force; row i of `force` (rows x p) is relative to
/// the magnitudes that cancel in it.
MatrixXd forceless(const MatrixXd& force) {
  // By QR and SVD, not by F^T F, whose rounding would hide weak supports.
  const Index p = force.cols();
  if (p == 0) return MatrixXd(0, 0);
  const MatrixXd V = dense::svd(dense::qr(force).R).V;
  const Eigen::RowVectorXd most = (force * V).cwiseAbs().colwise().maxCoeff();
  std::vector<Index> free;
  for (Index c = 0; c < p; ++c)
    if (most[c] <= kNoForce) free.push_back(c);
  return V(Eigen::all, free);
}

/// The DoFs of each body, ascending.
std::vector<std::vector<Index>> rows_of(const std::vector<int>& body, int bodies) {
  std::vector<std::vector<Index>> rows(static_cast<size_t>(bodies));
  for (size_t i = 0; i < body.size(); ++i) rows[body[i]].push_back(static_cast<Index>(i));
  return rows;
}

}  // namespace

DofUnion::DofUnion(Index size) : above_(static_cast<size_t>(size)) {
  std::iota(above_.begin(), above_.end(), 0);
}

int32_t DofUnion::root(int32_t i) {
  while (above(i) != i) i = above(i) = above(above(i));
  return i;
}

void DofUnion::join(int32_t i, int32_t j) {
  const int32_t a = root(i), b = root(j);
  above(std::max(a, b)) = std::min(a, b);
}

void DofUnion::join_all(const std::vector<int32_t>& roots) {
  for (size_t i = 0; i < roots.size(); ++i) join(static_cast<int32_t>(i), roots[i]);
}

std::vector<int32_t> DofUnion::roots() {
  std::vector<int32_t> out(above_.size());
  for (size_t i = 0; i < out.size(); ++i) out[i] = root(static_cast<int32_t>(i));
  return out;
}

std::vector<int> numbered_sets(DofUnion& sets) {
  const std::vector<int32_t> roots = sets.roots();
  std::vector<int> number(roots.size(), -1);
  int count = 0;
  for (size_t i = 0; i < roots.size(); ++i) {
    const auto root = static_cast<size_t>(roots[i]);  // not after i
    number[i] = root == i ? count++ : number[root];
  }
  return number;
}

std::vector<int> bodies_of(const SparseMatrix& K, const SparseMatrix& M) {
  DofUnion sets(K.cols());
  join_entries(K, sets);
  join_entries(M, sets);
  return numbered_sets(sets);
}

FreeMotions free_motions(const SparseMatrix& K, const SparseMatrix& M, const MatrixXd& rigid) {
  return free_motions(
      RigidProducts{bodies_of(K, M), [&](const MatrixXd& x) { return multiply_symmetric(M, x); },
                    [&](const MatrixXd& x) { return multiply_symmetric(K, x); },
                    [&](const MatrixXd& x) { return magnitude_product(K, x); }},
      rigid);
}

FreeMotions free_motions(const RigidProducts& products, const MatrixXd& rigid) {
  FreeMotions out;
  const std::vector<int>& body = products.body;
  const auto size_of_all = static_cast<Index>(body.size());
  out.bodies = body.empty() ? 0 : 1 + *std::max_element(body.begin(), body.end());
  const auto rows = rows_of(body, out.bodies);
  // All bodies share the same six columns; each has its own rows.
  const MatrixXd momentum = products.mass(rigid);
  MatrixXd motion = MatrixXd::Zero(size_of_all, 6);
  std::vector<MatrixXd> moving;
  for (const auto& own : rows) {
    const MatrixXd R = rigid(own, Eigen::all);
    moving.push_back(moving_combinations(R.transpose() * momentum(own, Eigen::all)));
    motion(own, Eigen::seqN(0, moving.back().cols())) = R * moving.back();
    out.moving += moving.back().cols();
  }
  const VectorXd size = products.magnitude(motion).rowwise().maxCoeff();
  MatrixXd force = products.stiffness(motion);
  for (Index i = 0; i < force.rows(); ++i) force.row(i) *= size[i] > 0.0 ? 1.0 / size[i] : 0.0;

  std::vector<MatrixXd> free;
  for (size_t b = 0; b < rows.size(); ++b) {
    free.push_back(forceless(force(rows[b], Eigen::seqN(0, moving[b].cols()))));
    out.body.insert(out.body.end(), static_cast<size_t>(free[b].cols()), static_cast<int>(b));
  }
  out.q = MatrixXd::Zero(size_of_all, static_cast<Index>(out.body.size()));
  out.unit.resize(6, out.q.cols());
  Index at = 0;
  for (size_t b = 0; b < rows.size(); ++b) {
    const auto columns = Eigen::seqN(at, free[b].cols());
    out.q(rows[b], columns) = motion(rows[b], Eigen::seqN(0, moving[b].cols())) * free[b];
    out.unit(Eigen::all, columns) = moving[b] * free[b];
    at += free[b].cols();
  }
  return out;
}

MatrixXd free_motions(const rom::ReducedModel& model, const std::vector<int32_t>& left) {
  const MatrixXd K = model.K_rr(left, left), M = model.M_rr(left, left);
  const MatrixXd R = model.rigid(left, Eigen::all);
  const MatrixXd U = R * moving_combinations(R.transpose() * M * R);
  if (U.cols() == 0) return U;
  // Forces are no measure: a coordinate that is a motion itself has a row of rounding in K, which
  // is all that a force could be compared with.
  double fastest = 0.0;
  for (Index i = 0; i < K.rows(); ++i)
    if (M(i, i) > 0.0) fastest = std::max(fastest, K(i, i) / M(i, i));
  const dense::Eigenpairs energy = dense::symmetric_eigen(U.transpose() * K * U);
  const Index free = (energy.values.array() <= kNoEnergy * fastest).count();
  return free == U.cols() ? U : U * energy.vectors.leftCols(free);
}

FreeMotions free_motions(const fe::FeModel& model) {
  return free_motions(model.K, model.M, model.rigid);
}

double characteristic_length(const fe::FeModel& model) {
  if (model.nodes.rows() == 0) return 1.0;
  const Eigen::RowVector3d span =
      model.nodes.colwise().maxCoeff() - model.nodes.colwise().minCoeff();
  return std::max(0.5 * span.norm(), 1e-12);
}

std::string motion_name(const Eigen::VectorXd& motion, double length) {
  const Eigen::Vector3d shift = motion.head(3), turn = motion.tail(3);
  const bool turns = turn.norm() * length > 1e-3 * shift.norm();
  Index axis = 0;
  (turns ? turn : shift).cwiseAbs().maxCoeff(&axis);
  return fmt::format("{} {}", turns ? "rotation about" : "displacement along", "xyz"[axis]);
}

}  // namespace clatter::fe
