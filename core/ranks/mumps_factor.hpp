// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Factors and inertia by MUMPS over all ranks (Amestoy, Duff, L'Excellent and Koster 2001).
#include <functional>
#include <memory>

#include "core/ranks/shared_matrix.hpp"
#include "core/sparse/factor/factor.hpp"
#include "core/sparse/factor/inertia.hpp"

namespace clatter::ranks {

/// K - sigma M by entries.
struct ShiftedEntries {
  const Entries& K;
  const Entries& M;
  double sigma = 0.0;
};

/// Which rows and columns are factorised.
enum class Extent {
  kInterior,            // those of the interior
  kInteriorToBoundary,  // the same, with the coupling to the boundary: boundary_part()
  kWhole
};

/// S A S = L D L^T in the given elimination order (the order of the indices), S as
/// power_of_two_scale; the factor is distributed, and out of core where the memory of a rank is too
/// small. Every function is collective.
class MumpsFactor : public sparse::Factor {
 public:
  /// Throws NotPositiveDefinite, NumericsError when it does not fit into memory even out of core,
  /// FileError when the disk is full.
  MumpsFactor(const Ranks& ranks, const RowShares& shares, const ShiftedEntries& entries,
              Extent extent, const sparse::FactorOptions& options);
  ~MumpsFactor() override;

  Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& b) const override;
  void solve_in_order(double* x, int count) const override;
  Eigen::MatrixXd boundary_product(const Eigen::Ref<const Eigen::MatrixXd>& f) const override;
  const Eigen::MatrixXd& boundary_part() const override;
  const sparse::FactorReport& report() const override;
  std::vector<int64_t> permutation() const override { return {}; }
  /// The factor is on disk.
  bool out_of_core() const;
  /// Solves A x = b for a random b and enters residual and growth into the report; throws
  /// NotPositiveDefinite as SupernodalFactor does where A is singular to working precision.
  void probe(const std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>& A,
             const sparse::FactorOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Eigenvalues of K x = lambda M x below `limit`, by the negative pivots of K - limit M; the factor
/// is not kept.
sparse::InertiaCount count_below(const Ranks& ranks, const RowShares& shares, const Entries& K,
                                 const Entries& M, double limit, Extent extent);

}  // namespace clatter::ranks
