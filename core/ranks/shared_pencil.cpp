// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/ranks/shared_pencil.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/ranks/parpack.hpp"

namespace clatter::ranks {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// A matrix that the pencil keeps.
class KeptMatrix : public sparse::SymmetricOperator {
 public:
  explicit KeptMatrix(std::shared_ptr<const SharedMatrix> matrix) : matrix_(std::move(matrix)) {}
  MatrixXd operator*(const Eigen::Ref<const MatrixXd>& x) const override { return *matrix_ * x; }
  void multiply(const double* x, double* y, int count) const override {
    matrix_->multiply(x, y, count);
  }
  Index size() const override { return matrix_->size(); }

 private:
  std::shared_ptr<const SharedMatrix> matrix_;
};

}  // namespace

SharedPencil::SharedPencil(const Ranks& ranks, const RowShares& shares, const Entries& K,
                           const Entries& M, Extent extent)
    : ranks_(ranks),
      shares_(shares),
      K_entries_(K),
      M_entries_(M),
      extent_(extent),
      K_(std::make_shared<SharedMatrix>(ranks, shares, K, extent == Extent::kWhole)),
      M_(std::make_shared<SharedMatrix>(ranks, shares, M, extent == Extent::kWhole)) {}

int64_t SharedPencil::size() const {
  return extent_ == Extent::kWhole ? shares_.size() : shares_.interior();
}

sparse::PencilBounds SharedPencil::bounds() const {
  sparse::PencilBounds out;
  double massless = 0.0;
  for (Index j = 0; j < rows(); ++j) {
    if (M_->diagonal()[j] > 0.0)
      out.top = std::max(out.top, K_->diagonal()[j] / M_->diagonal()[j]);
    else
      massless += 1.0;
  }
  out.top = -ranks_.least(-out.top);
  out.massless = static_cast<int64_t>(ranks_.sum(massless));
  return out;
}

double SharedPencil::default_shift() const {
  RowMatrix ratio(rows(), 1);
  Index count = 0;
  for (Index j = 0; j < rows(); ++j)
    if (M_->diagonal()[j] > 0.0) ratio(count++, 0) = K_->diagonal()[j] / M_->diagonal()[j];
  RowMatrix all = ranks_.gather(RowMatrix(ratio.topRows(count)));
  double shift = 0.0;
  if (all.rows() > 0) {
    double* median = all.data() + all.rows() / 2;
    std::nth_element(all.data(), median, all.data() + all.rows());
    shift = -0.1 * *median * std::pow(static_cast<double>(size()), -2.0 / 3.0);
  }
  ranks_.agree(&shift, 1);
  return shift;
}

std::unique_ptr<sparse::Factor> SharedPencil::probed(double sigma, Extent extent,
                                                     const sparse::FactorOptions& options) const {
  auto made = std::make_unique<MumpsFactor>(
      ranks_, shares_, ShiftedEntries{K_entries_, M_entries_, sigma}, extent, options);
  made->probe([&](const MatrixXd& x) -> MatrixXd { return *K_ * x - sigma * (*M_ * x); }, options);
  return made;
}

std::unique_ptr<sparse::Factor> SharedPencil::factor(double sigma,
                                                     const sparse::FactorOptions& options) const {
  return probed(sigma, extent_, options);
}

std::unique_ptr<sparse::Factor> SharedPencil::factor_with_boundary() const {
  return probed(0.0, Extent::kInteriorToBoundary, {});
}

sparse::InertiaCount SharedPencil::count_below(double limit,
                                               const std::vector<int64_t>& /*order*/) const {
  return ranks::count_below(ranks_, shares_, K_entries_, M_entries_, limit, extent_);
}

std::unique_ptr<sparse::SymmetricOperator> SharedPencil::stiffness(
    const std::vector<int64_t>& /*order*/) const {
  return std::make_unique<KeptMatrix>(K_);
}

std::unique_ptr<sparse::SymmetricOperator> SharedPencil::mass(
    const std::vector<int64_t>& /*order*/) const {
  return std::make_unique<KeptMatrix>(M_);
}

std::unique_ptr<sparse::ArpackRoutines> SharedPencil::arpack() const {
  return std::make_unique<ParpackRoutines>(ranks_);
}

}  // namespace clatter::ranks
