// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/local_modes.hpp"

#include <algorithm>
#include <random>

#include "core/base/error.hpp"
#include "core/dense/qr.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kLoose = 0.01;      // accepted residual of a wanted mode, relative to nu
constexpr double kDependent = 1e-9;  // a block reduced by this factor is linearly dependent
constexpr Index kDenseBlocks = 6;    // up to this many blocks, dense algebra is cheaper

/// Largest first.
dense::Eigenpairs descending(const MatrixXd& T) {
  dense::Eigenpairs eig = dense::symmetric_eigen(0.5 * (T + T.transpose()));
  if (!eig.ok) throw NumericsError("modes: a substructure's modes did not converge");
  eig.values = eig.values.reverse().eval();
  eig.vectors = eig.vectors.rowwise().reverse().eval();
  return eig;
}

LocalModes kept(const MatrixXd& Q, const dense::Eigenpairs& ritz, const MatrixXd& C, double cut) {
  const Index count = (ritz.values.array() >= cut).count();
  LocalModes out;
  out.values = ritz.values.head(count);
  out.vectors = Q * ritz.vectors.leftCols(count);
  out.coupling = C * ritz.vectors.leftCols(count);
  return out;
}

LocalModes all_by_dense(const LocalOperator& A, const LocalOptions& options) {
  MatrixXd T(A.size, A.size), C(A.inside, A.size), W, part;
  for (Index first = 0; first < A.size; first += options.block) {
    const Index count = std::min(options.block, A.size - first);
    MatrixXd unit = MatrixXd::Zero(A.size, options.block);
    unit.block(first, 0, count, count).setIdentity();
    A.apply(unit, W, part);
    T.middleCols(first, count) = W.leftCols(count);
    C.middleCols(first, count) = part.leftCols(count);
  }
  return kept(MatrixXd::Identity(A.size, A.size), descending(T), C, options.cut);
}

/// State of the Lanczos iteration.
struct Krylov {
  MatrixXd Q, C, T, R;  // n x size, inside x size, size x size; R: rest = next block R
  Index size = 0;

  void grow(Index n, Index inside, Index room) {
    if (room <= Q.cols()) return;
    room = std::max(room, 2 * Q.cols());
    Q.conservativeResize(n, room);
    C.conservativeResize(inside, room);
    const Index old = T.cols();
    T.conservativeResize(room, room);
    T.rightCols(room - old).setZero();
    T.bottomRows(room - old).setZero();
  }
};

/// Whether the wanted Ritz vectors and the first unwanted one have converged.
bool settled(const dense::Eigenpairs& ritz, const MatrixXd& R, double cut) {
  for (Index k = 0; k < ritz.values.size(); ++k) {
    const double residual = (R * ritz.vectors.col(k).tail(R.cols())).norm();
    const double nu = ritz.values[k];
    if (nu < cut) return residual <= cut - nu || residual <= 0.1 * cut;
    if (residual > kLoose * nu) return false;
  }
  return false;
}

MatrixXd random_block(Index n, Index block, uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return MatrixXd::NullaryExpr(n, block, [&] { return uniform(engine); });
}

}  // namespace

LocalModes local_modes(const LocalOperator& A, const LocalOptions& options) {
  const Index b = options.block;
  if (A.size <= kDenseBlocks * b) return all_by_dense(A, options);
  Krylov space;
  MatrixXd next = random_block(A.size, b, options.seed), W, part;
  Index check_at = 2 * b;
  for (;;) {
    const dense::Qr qr = dense::qr(next);
    if (space.size > 0) {
      space.R = qr.R;
      const double largest = space.T.topLeftCorner(space.size, space.size).diagonal().maxCoeff();
      const bool left = space.R.diagonal().cwiseAbs().minCoeff() < kDependent * largest;
      if (left || space.size + 2 * b > A.size) return all_by_dense(A, options);
      if (space.size >= check_at) {
        const dense::Eigenpairs ritz = descending(space.T.topLeftCorner(space.size, space.size));
        if (settled(ritz, space.R, options.cut))
          return kept(space.Q.leftCols(space.size), ritz, space.C.leftCols(space.size),
                      options.cut);
        check_at = space.size + std::max(b, space.size / 8);
      }
    }
    const Index end = space.size + b;
    space.grow(A.size, A.inside, end);
    space.Q.middleCols(space.size, b) = qr.Q;
    A.apply(space.Q.middleCols(space.size, b), W, part);
    space.C.middleCols(space.size, b) = part;
    const auto basis = space.Q.leftCols(end);
    const MatrixXd H = basis.transpose() * W;
    W.noalias() -= basis * H;
    W.noalias() -= basis * (basis.transpose() * W).eval();
    space.T.block(0, space.size, end, b) = H;
    space.T.block(space.size, 0, b, end) = H.transpose();
    space.size = end;
    next = W;
  }
}

}  // namespace clatter::sparse
