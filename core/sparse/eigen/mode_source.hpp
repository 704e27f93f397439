#pragma once
// The lowest modes of one problem by the solver that is asked for: dense, block Lanczos, ARPACK or
// AMLS. Whether any is missing is the caller's question.
#include <string>
#include <vector>

#include "core/sparse/eigen/eigen_solver.hpp"
#include "core/sparse/eigen/shifted_pencil.hpp"

namespace clatter::sparse {

class ModeSource {
 public:
  /// @param K, M, options, factor as in solve_modes; must outlive this.
  ModeSource(const SparseMatrix& K, const SparseMatrix& M, const EigenOptions& options,
             const SupernodalFactor* factor);

  /// Dense algebra is used: rows keep their order, else they are in the order of the factor.
  bool dense() const { return n_ <= options_.dense_limit; }
  /// The lowest `count` modes beside the rigid ones; each retry starts from other vectors.
  EigenResult solve(int count, int retry);
  /// About how many modes lie below a value [rad2/s2]; of sparse problems.
  int estimated_below(double limit);

  /// n x m, M-orthonormal, rows as given: motions known beforehand to have no stiffness.
  const Eigen::MatrixXd& rigid() const { return rigid_; }
  double sigma() const { return dense() ? dense_sigma_ : pencil_.sigma(); }
  const std::string& method() const { return method_; }
  const std::vector<int64_t>& order() const { return pencil_.order(); }
  const ShiftInvert& problem() const { return pencil_.problem(); }
  const SymmetricProduct& mass() const { return pencil_.mass(); }
  const FactorReport& report() const { return pencil_.report(); }
  /// So far: vectors that went through a factor, factors made, seconds in the solvers.
  int64_t solves() const { return solves_ + pencil_.solves(); }
  int factors() const { return pencil_.factors(); }
  double seconds() const { return seconds_; }

 private:
  EigenResult attempt(int count, int retry);
  EigenResult by_dense(int count);
  /// With a shift that moves where the first blocks show that it is far.
  EigenResult by_block_lanczos(int count, int retry);
  EigenResult by_amls(int count, int retry);
  EigenResult by_arpack(int count, int retry);
  uint64_t seed(int retry) const { return options_.seed + 7919 * static_cast<uint64_t>(retry); }
  /// The caller's start vector in the factor's order; empty where there is none.
  Eigen::VectorXd start(int retry) const;

  const SparseMatrix& K_;
  const SparseMatrix& M_;
  const EigenOptions& options_;
  const Eigen::Index n_;
  const Eigen::MatrixXd rigid_;
  const Wanted wanted_;
  ShiftedPencil pencil_;
  double dense_sigma_ = 0.0;
  std::string method_;
  int64_t solves_ = 0;
  double seconds_ = 0.0;
};

}  // namespace clatter::sparse
