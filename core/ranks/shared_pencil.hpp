// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// K and M of an eigenproblem by rows, each on its owner.
#include <memory>

#include "core/fe/free_motions.hpp"
#include "core/ranks/mumps_factor.hpp"
#include "core/ranks/shared_fe_model.hpp"
#include "core/sparse/eigen/matrix_pencil.hpp"

namespace clatter::ranks {

class SharedPencil : public sparse::MatrixPencil {
 public:
  /// @param own must outlive this.
  /// @param extent kInterior or kWhole: the rows are those of the interior in the order in which
  /// `own` got them, or all in the order of the part's DoFs.
  SharedPencil(const SharedMatrices& own, Extent extent);
  int64_t size() const override;
  Eigen::Index rows() const override { return K_->size(); }
  const sparse::RowTeam& team() const override { return own_.ranks; }
  std::pair<Eigen::VectorXd, Eigen::VectorXd> diagonals() const override {
    return {K_->diagonal(), M_->diagonal()};
  }
  std::unique_ptr<sparse::Factor> factor(double sigma,
                                         const sparse::FactorOptions& options) const override;
  sparse::InertiaCount count_below(double limit, const std::vector<int64_t>& order) const override;
  std::shared_ptr<const sparse::SymmetricOperator> stiffness(
      const std::vector<int64_t>& /*order*/) const override {
    return K_;
  }
  std::shared_ptr<const sparse::SymmetricOperator> mass(
      const std::vector<int64_t>& /*order*/) const override {
    return M_;
  }
  Eigen::MatrixXd stiffness_times(const Eigen::MatrixXd& x) const override { return *K_ * x; }
  Eigen::MatrixXd mass_times(const Eigen::MatrixXd& x) const override { return *M_ * x; }
  Eigen::MatrixXd magnitude_times(const Eigen::MatrixXd& x) const override {
    return K_->magnitude_times(x);
  }
  std::unique_ptr<sparse::ArpackRoutines> arpack() const override;
  /// The factor of K with the coupling to the boundary.
  std::unique_ptr<sparse::Factor> factor_with_boundary() const;
  /// Places of the own rows among all rows.
  std::vector<int32_t> own_places() const;
  /// The free rigid-body motions, n x m, complete on every rank.
  /// @param rigid n x 6, unit rigid-body motions.
  fe::FreeMotions free_motions(const Eigen::MatrixXd& rigid) const;

 private:
  std::unique_ptr<sparse::Factor> probed(double sigma, Extent extent,
                                         const sparse::FactorOptions& options) const;
  /// Place of the row at each index in elimination order.
  const std::vector<int32_t>& places() const;
  /// The body of each row, of all ranks' entries.
  std::vector<int> bodies() const;
  const SharedMatrices& own_;
  Extent extent_;
  std::shared_ptr<const SharedMatrix> K_, M_;
};

}  // namespace clatter::ranks
