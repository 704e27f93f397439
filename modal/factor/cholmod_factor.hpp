#pragma once
// Sparse supernodal Cholesky factorisation (CHOLMOD behind it) with the guards that CHOLMOD lacks.
#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/sparse.hpp"

namespace clatter::modal {

/// Fill-reducing orders; kNatural keeps the order of the matrix (tests and given permutations).
enum class Ordering { kMetis, kAmd, kNatural };

struct FactorOptions {
  Ordering ordering = Ordering::kMetis;
  std::vector<int64_t> permutation;  // used in place of an ordering when not empty
  double memory_limit_gib = 0.0;     // 0: the machine's memory
  double min_rcond = 1e-13;          // smallest accepted ratio of pivots (hard case C2)
  double max_condition = 1e11;       // largest accepted |A| |x| / |b| of a random solve (A1)
};

/// What a factorisation costs and how good it is.
struct FactorReport {
  int64_t size = 0;
  int64_t entries = 0;           // of L
  double flops = 0.0;            // of the numeric factorisation
  double predicted_gib = 0.0;    // memory of L
  std::string ordering;          // "metis", "amd", "natural", "given"
  double rcond = 0.0;            // (min L_jj / max L_jj)^2 of the scaled matrix
  double probe_residual = 0.0;   // |A x - b| / |b| for a random b
  double probe_condition = 0.0;  // |A| |x| / |b| of that solve: a lower bound of the condition
  double analyse_seconds = 0.0;
  double factor_seconds = 0.0;
};

/// The matrix is not positive definite, or singular to working precision. `column` is where the
/// factorisation stopped, or -1 when it is not known.
struct NotPositiveDefinite : NumericsError {
  NotPositiveDefinite(const std::string& message, int64_t stopped_at)
      : NumericsError(message), column(stopped_at) {}
  int64_t column;
};

/// METIS counts in 32 bits (hard case C5): kMetis is replaced by kAmd when the full pattern of a
/// matrix with `lower_entries` entries in its lower triangle and `size` rows does not fit.
Ordering safe_ordering(Ordering wanted, int64_t size, int64_t lower_entries);

/// P S A S P^T = L L^T with S = diag(A)^(-1/2) rounded to powers of two, so that the pivots' ratio
/// judges the body and not its units. A is symmetric positive definite, given by its lower
/// triangle.
class CholmodFactor {
 public:
  /// Orders, predicts memory, factorises and probes. Throws NotPositiveDefinite, or NumericsError
  /// when L would not fit into memory.
  explicit CholmodFactor(const SparseMatrix& lower, const FactorOptions& options = {});
  /// Orders and predicts only; nothing numeric is done or kept.
  static FactorReport predict(const SparseMatrix& lower, const FactorOptions& options = {});
  ~CholmodFactor();
  CholmodFactor(CholmodFactor&&) noexcept;
  CholmodFactor& operator=(CholmodFactor&&) noexcept;

  /// x = A^{-1} b, b is n x m; columns go through the factor in blocks of 64. Safe to call from
  /// several threads (one at a time runs).
  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const;
  /// The same for one vector without allocation beyond the first call.
  void solve(const double* b, double* x) const;

  int64_t size() const;
  const FactorReport& report() const;
  /// Row of A that stands at place j of the factor, n entries.
  std::vector<int64_t> permutation() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace clatter::modal
