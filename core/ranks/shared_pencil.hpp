// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// K and M of an eigenproblem by rows, each on its owner.
#include <memory>

#include "core/ranks/mumps_factor.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"

namespace clatter::ranks {

class SharedPencil : public sparse::MatrixPencil {
 public:
  /// @param K, M the complete rows of this rank; must outlive this.
  /// @param extent kInterior or kWhole.
  SharedPencil(const Ranks& ranks, const RowShares& shares, const Entries& K, const Entries& M,
               Extent extent);
  int64_t size() const override;
  Eigen::Index rows() const override { return K_->size(); }
  const sparse::RowTeam& team() const override { return ranks_; }
  sparse::PencilBounds bounds() const override;
  double default_shift() const override;
  std::unique_ptr<sparse::Factor> factor(double sigma,
                                         const sparse::FactorOptions& options) const override;
  sparse::InertiaCount count_below(double limit, const std::vector<int64_t>& order) const override;
  std::unique_ptr<sparse::SymmetricOperator> stiffness(
      const std::vector<int64_t>& order) const override;
  std::unique_ptr<sparse::SymmetricOperator> mass(const std::vector<int64_t>& order) const override;
  Eigen::MatrixXd stiffness_times(const Eigen::MatrixXd& x) const override { return *K_ * x; }
  Eigen::MatrixXd mass_times(const Eigen::MatrixXd& x) const override { return *M_ * x; }
  Eigen::MatrixXd magnitude_times(const Eigen::MatrixXd& x) const override {
    return K_->magnitude_times(x);
  }
  std::unique_ptr<sparse::ArpackRoutines> arpack() const override;
  /// The factor of K with the coupling to the boundary.
  std::unique_ptr<sparse::Factor> factor_with_boundary() const;

 private:
  std::unique_ptr<sparse::Factor> probed(double sigma, Extent extent,
                                         const sparse::FactorOptions& options) const;
  const Ranks& ranks_;
  RowShares shares_;
  const Entries &K_entries_, &M_entries_;
  Extent extent_;
  std::shared_ptr<const SharedMatrix> K_, M_;
};

}  // namespace clatter::ranks
