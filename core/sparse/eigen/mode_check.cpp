// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sparse/eigen/mode_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/threads.hpp"

namespace clatter::sparse {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kCheckedColumns = 32;  // vectors processed at a time
constexpr double kBackward = 1e-12;    // relative change of entries that explains a residual
constexpr double kZeroKnown = 0.1;     // of the rounding bound; actual values are far below it
constexpr double kZeroUnknown = 2.0;   // the same where zeros are recognised only by their values
constexpr double kResolved = 1e-10;    // of the shift; smaller values are zero to rounding
constexpr double kEps = std::numeric_limits<double>::epsilon();

}  // namespace

VectorXd residuals_of(const SymmetricProduct& K, const SymmetricProduct& M, const ModeSet& modes) {
  const Index n = K.size();
  VectorXd out(modes.size());
  RowMatrix x, force, inertia;
  for (Index first = 0; first < modes.size(); first += kCheckedColumns) {
    const Index count = std::min(kCheckedColumns, modes.size() - first);
    x = modes.vectors.middleCols(first, count);
    force.resize(n, count);
    inertia.resize(n, count);
    K.multiply(x.data(), force.data(), static_cast<int>(count));
    M.multiply(x.data(), inertia.data(), static_cast<int>(count));
    const auto values = modes.values.segment(first, count);
    const VectorXd length = inertia.colwise().norm();
    force -= inertia * values.asDiagonal();
    out.segment(first, count) = force.colwise().norm().transpose().array() /
                                ((values.array() - modes.sigma).abs() * length.array());
  }
  return out;
}

double beyond_rounding(const SparseMatrix& K, const SparseMatrix& M, double value,
                       const VectorXd& x) {
  const VectorXd inertia = value * multiply_symmetric(M, x);
  const double rest = (multiply_symmetric(K, x) - inertia).norm();
  return rest / (magnitude_product(K, x).norm() + inertia.norm()) / kBackward;
}

void refuse_residuals(const SparseMatrix& K, const SparseMatrix& M, const ModeSet& modes,
                      double most) {
  for (Index j = 0; j < modes.size(); ++j) {
    if (modes.residuals[j] <= most) continue;
    const double backward =
        kBackward * beyond_rounding(K, M, modes.values[j], modes.vectors.col(j));
    if (backward <= kBackward) continue;
    throw NumericsError(
        fmt::format("modes: mode {} at {:.6g} Hz has residual {:.1e}, expected at most {:.1e}, and "
                    "backward error {:.1e}, expected at most {:.1e}",
                    j + 1 + modes.known_rigid, hz_of_value(modes.values[j]), modes.residuals[j],
                    most, backward, kBackward));
  }
}

void restore_order(const std::vector<int64_t>& order, ModeSet& modes) {
  parallel_pieces(modes.size(), [&](int64_t begin, int64_t end) {
    VectorXd inside;
    for (int64_t j = begin; j < end; ++j) {
      auto x = modes.vectors.col(j);
      if (!order.empty()) inside = x;
      for (size_t i = 0; i < order.size(); ++i) x[order[i]] = inside[static_cast<Index>(i)];
      Index largest = 0;
      x.cwiseAbs().maxCoeff(&largest);
      if (x[largest] < 0.0) x *= -1.0;
    }
  });
}

void insert_rigid(const SparseMatrix& K, const Eigen::MatrixXd& rigid, bool known_beforehand,
                  ModeSet& modes) {
  const Index n = K.rows(), found = modes.size(), known = rigid.cols();
  modes.rounding = VectorXd::Zero(known + found);
  modes.known_rigid = modes.rigid = static_cast<int>(known);
  // |x|^T |K| |x| <= sum_i x_i^2 sum_j |K_ij|
  const VectorXd row_sums = magnitude_product(K, VectorXd::Ones(n));
  // Unknown zeros were computed as 1 / nu + sigma.
  const double zero = known_beforehand ? kZeroKnown : kZeroUnknown;
  const double unresolved = known_beforehand ? 0.0 : kResolved * std::abs(modes.sigma);
  for (Index j = 0; j < found; ++j) {
    const double uncertain = kEps * modes.vectors.col(j).cwiseAbs2().dot(row_sums);
    const double value = std::abs(modes.values[j]);
    if (value <= std::max(zero * uncertain, unresolved))
      ++modes.rigid;
    else
      modes.rounding[known + j] = 0.5 * uncertain / value;
  }
  if (known == 0) return;
  const auto prepend = [&](VectorXd& values, const VectorXd& first) {
    VectorXd all(known + values.size());
    all << first, values;
    values.swap(all);
  };
  prepend(modes.values, VectorXd::Zero(known));
  if (modes.errors.size() > 0) prepend(modes.errors, VectorXd::Zero(known));
  const VectorXd force = multiply_symmetric(K, rigid).colwise().norm();
  prepend(modes.residuals,
          force.cwiseQuotient(magnitude_product(K, rigid).colwise().norm().transpose()));
  // In place: the vectors may fill half the memory.
  modes.vectors.conservativeResize(n, known + found);
  double* data = modes.vectors.data();
  std::copy_backward(data, data + n * found, data + n * (known + found));
  modes.vectors.leftCols(known) = rigid;
}

}  // namespace clatter::sparse
