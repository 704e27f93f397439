#include "modal/eigen/block_lanczos.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <random>

#include "core/progress.hpp"
#include "modal/dense_product.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What one run carries from block to block.
class Run {
 public:
  Run(const ShiftInvert& problem, const BlockLanczosOptions& options);
  EigenResult solve();

 private:
  void fill_random(Index first);
  /// Makes columns [begin, begin + b) of V_, which are M-orthogonal to all before, M-orthonormal
  /// among themselves; gives R with old = new R and fills MV_. Directions that vanish are replaced
  /// by random ones.
  MatrixXd orthonormalise(Index begin);
  void remove_previous(Index begin, MatrixXd& coefficients);
  bool expand();
  void project();
  Index converged() const;
  void restart();
  EigenResult result() const;

  const ShiftInvert& problem_;
  const BlockLanczosOptions& options_;
  Index n_, b_, wanted_, limit_;
  Index size_ = 0;  // columns whose image under Op is in T_
  MatrixXd V_;      // n x (limit + b): basis, then the residual block
  MatrixXd MV_;     // M V
  MatrixXd T_;      // projection of Op
  MatrixXd R_;      // b x b: the residual block is V(:, size:) R
  VectorXd nu_;     // Ritz values, descending
  MatrixXd S_;      // their coordinates in V(:, :size)
  int64_t solves_ = 0;
  std::mt19937_64 engine_;
};

Index default_block(Index wanted) { return std::clamp<Index>(wanted / 8, 4, 8); }

Run::Run(const ShiftInvert& problem, const BlockLanczosOptions& options)
    : problem_(problem),
      options_(options),
      n_(problem.size),
      b_(options.block > 0 ? options.block : default_block(options.count)),
      wanted_(options.count),
      engine_(options.seed) {
  const Index room = options.basis > 0 ? options.basis : 2 * wanted_ + 4 * b_;
  const Index blocks = std::max<Index>((std::max(room, wanted_ + 2 * b_) + b_ - 1) / b_, 3);
  limit_ = blocks * b_;
  V_.resize(n_, limit_ + b_);
  MV_.resize(n_, limit_ + b_);
  T_ = MatrixXd::Zero(limit_, limit_);
}

void Run::fill_random(Index column) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (double& value : V_.col(column)) value = uniform(engine_);
}

void Run::remove_previous(Index begin, MatrixXd& coefficients) {
  if (begin == 0) return;
  auto block = V_.middleCols(begin, b_);
  const MatrixXd H = transposed_product(MV_.leftCols(begin), block);
  add_product(-1.0, V_.leftCols(begin), H, block);
  coefficients += H;
}

/// A times `right` in place.
void transform(DenseOut A, const MatrixXd& right) {
  const MatrixXd old = A;
  A.setZero();
  add_product(1.0, old, right, A);
}

MatrixXd Run::orthonormalise(Index begin) {
  // Below this ratio of squared lengths, what two passes left of earlier vectors is no longer
  // small.
  constexpr double kDependent = 1e-8;
  constexpr double kVanished = 1e-20;
  MatrixXd R = MatrixXd::Identity(b_, b_);
  auto block = V_.middleCols(begin, b_);
  auto image = MV_.middleCols(begin, b_);
  bool repeat = true;
  image = problem_.mass(block);
  for (int pass = 0; pass < 2 || (repeat && pass < 4); ++pass) {
    const MatrixXd gram = transposed_product(block, image);
    const VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(scale.asDiagonal() * gram *
                                                      scale.asDiagonal());
    const VectorXd d = eig.eigenvalues().cwiseMax(1e-30);
    const MatrixXd to_unit =
        scale.asDiagonal() * eig.eigenvectors() * d.cwiseSqrt().cwiseInverse().asDiagonal();
    const MatrixXd from_unit = d.cwiseSqrt().asDiagonal() * eig.eigenvectors().transpose() *
                               scale.cwiseInverse().asDiagonal();
    transform(block, to_unit);
    transform(image, to_unit);
    R = (from_unit * R).eval();
    repeat = d[0] < kDependent * d[b_ - 1];
    for (Index c = 0; c < b_; ++c) {
      if (d[c] > kVanished * d[b_ - 1] && block.col(c).allFinite()) continue;
      fill_random(begin + c);
      R.row(c).setZero();
    }
    if (!repeat) continue;
    MatrixXd ignored = MatrixXd::Zero(begin, b_);
    remove_previous(begin, ignored);
    remove_previous(begin, ignored);
    image = problem_.mass(block);
  }
  return R;
}

bool Run::expand() {
  const Index next = size_ + b_;
  {
    const MatrixXd answer = problem_.solve(MV_.middleCols(size_, b_));
    solves_ += b_;
    if (!answer.allFinite()) return false;
    V_.middleCols(next, b_) = answer;
  }
  MatrixXd H = MatrixXd::Zero(next, b_);
  remove_previous(next, H);
  remove_previous(next, H);  // twice is enough (Parlett 1998, section 6.9)
  T_.block(0, size_, next, b_) = H;
  T_.block(size_, 0, b_, next) = H.transpose();
  R_ = orthonormalise(next);
  size_ = next;
  return true;
}

void Run::project() {
  MatrixXd T = T_.topLeftCorner(size_, size_);
  T = (0.5 * (T + T.transpose())).eval();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eig(T);
  nu_ = eig.eigenvalues().reverse();
  S_ = eig.eigenvectors().rowwise().reverse();
}

Index Run::converged() const {
  Index count = 0;
  while (count < std::min(wanted_, size_)) {
    const double residual = (R_ * S_.col(count).tail(b_)).norm();
    if (!(residual <= options_.tolerance * std::abs(nu_[count]))) break;
    ++count;
  }
  return count;
}

void Run::restart() {
  // The wanted vectors, and some more whose progress would be lost.
  const Index keep = std::min(wanted_ + b_, size_ - b_);
  for (MatrixXd* basis : {&V_, &MV_}) {
    MatrixXd kept = MatrixXd::Zero(n_, keep);
    add_product(1.0, basis->leftCols(size_), S_.leftCols(keep), kept);
    const MatrixXd residual_block = basis->middleCols(size_, b_);
    basis->leftCols(keep) = kept;
    basis->middleCols(keep, b_) = residual_block;
  }
  T_.setZero();
  T_.topLeftCorner(keep, keep) = nu_.head(keep).asDiagonal();
  size_ = keep;
}

EigenResult Run::result() const {
  EigenResult out;
  out.values = nu_.head(wanted_).cwiseInverse().array() + problem_.sigma;
  out.vectors = MatrixXd::Zero(n_, wanted_);
  add_product(1.0, V_.leftCols(size_), S_.leftCols(wanted_), out.vectors);
  out.status = EigenStatus::kConverged;
  return out;
}

EigenResult Run::solve() {
  for (Index c = 0; c < b_; ++c) fill_random(c);
  const Index given = std::min(options_.start.cols(), b_);
  if (given > 0) V_.leftCols(given) = options_.start.leftCols(given);
  (void)orthonormalise(0);
  Progress progress("eigenpairs", static_cast<double>(wanted_));
  EigenResult out;
  for (int restarts = 0; restarts <= options_.max_restarts; ++restarts) {
    while (size_ + b_ <= limit_) {
      if (!expand()) {
        out.status = EigenStatus::kOperatorFailed;
        out.message = "the solve returned values that are not finite";
        return out;
      }
      if (size_ < wanted_ + b_) continue;
      project();
      const Index done = converged();
      progress.update(static_cast<double>(done));
      if (done < wanted_) continue;
      out = result();
      out.solves = solves_;
      return out;
    }
    restart();
  }
  out.status = EigenStatus::kNotConverged;
  out.message = fmt::format("{} of {} modes converged in {} restarts", converged(), wanted_,
                            options_.max_restarts);
  out.solves = solves_;
  return out;
}

}  // namespace

EigenResult solve_block_lanczos(const ShiftInvert& problem, const BlockLanczosOptions& options) {
  EigenResult refused;
  refused.status = EigenStatus::kBadInput;
  const int64_t block = options.block > 0 ? options.block : default_block(options.count);
  if (options.count < 1) {
    refused.message = fmt::format("{} modes asked for, expected at least 1", options.count);
    return refused;
  }
  if (2 * int64_t{options.count} + 6 * block > problem.size) {
    refused.message = fmt::format("{} modes of {} unknowns leave no room for the subspace",
                                  options.count, problem.size);
    return refused;
  }
  return Run(problem, options).solve();
}

}  // namespace clatter::modal
