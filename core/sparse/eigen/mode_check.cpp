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

VectorXd norms_of(const RowMatrix& x, const RowTeam& team) {
  VectorXd squares = x.colwise().squaredNorm();
  team.sum(squares.data(), squares.size());
  return squares.cwiseSqrt();
}

}  // namespace

VectorXd residuals_of(const SymmetricOperator& K, const SymmetricOperator& M, const ModeSet& modes,
                      const RowTeam& team) {
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
    const VectorXd length = norms_of(inertia, team);
    force -= inertia * values.asDiagonal();
    out.segment(first, count) =
        norms_of(force, team).array() / ((values.array() - modes.sigma).abs() * length.array());
  }
  return out;
}

double beyond_rounding(const MatrixPencil& pencil, double value, const VectorXd& x) {
  const RowTeam& team = pencil.team();
  const VectorXd inertia = value * pencil.mass_times(x);
  const double rest = team.norms(pencil.stiffness_times(x) - inertia)[0];
  return rest / (team.norms(pencil.magnitude_times(x))[0] + team.norms(inertia)[0]) / kBackward;
}

void refuse_residuals(const MatrixPencil& pencil, const ModeSet& modes, double most) {
  for (Index j = 0; j < modes.size(); ++j) {
    if (modes.residuals[j] <= most) continue;
    const double backward =
        kBackward * beyond_rounding(pencil, modes.values[j], modes.vectors.col(j));
    if (backward <= kBackward) continue;
    throw NumericsError(
        fmt::format("modes: mode {} at {:.6g} Hz has residual {:.1e}, expected at most {:.1e}, and "
                    "backward error {:.1e}, expected at most {:.1e}",
                    j + 1 + modes.known_rigid, hz_of_value(modes.values[j]), modes.residuals[j],
                    most, backward, kBackward));
  }
}

void restore_order(const std::vector<int64_t>& order, ModeSet& modes, const RowTeam& team) {
  VectorXd highest(modes.size()), lowest(modes.size());  // of the largest entries of the processes
  parallel_pieces(modes.size(), [&](int64_t begin, int64_t end) {
    VectorXd inside;
    for (int64_t j = begin; j < end; ++j) {
      auto x = modes.vectors.col(j);
      if (!order.empty()) inside = x;
      for (size_t i = 0; i < order.size(); ++i) x[order[i]] = inside[static_cast<Index>(i)];
      Index largest = 0;
      if (x.size() > 0) x.cwiseAbs().maxCoeff(&largest);
      lowest[j] = x.size() > 0 ? x[largest] : 0.0;
      highest[j] = -lowest[j];
    }
  });
  team.least(highest.data(), highest.size());
  team.least(lowest.data(), lowest.size());
  parallel_pieces(modes.size(), [&](int64_t begin, int64_t end) {
    for (int64_t j = begin; j < end; ++j)
      if (lowest[j] < highest[j]) modes.vectors.col(j) *= -1.0;
  });
}

void insert_rigid(const MatrixPencil& pencil, const Eigen::MatrixXd& rigid, bool known_beforehand,
                  ModeSet& modes) {
  const RowTeam& team = pencil.team();
  const Index n = pencil.rows(), found = modes.size(), known = rigid.cols();
  modes.rounding = VectorXd::Zero(known + found);
  modes.known_rigid = modes.rigid = static_cast<int>(known);
  // |x|^T |K| |x| <= sum_i x_i^2 sum_j |K_ij|
  const VectorXd row_sums = pencil.magnitude_times(VectorXd::Ones(n));
  // Unknown zeros were computed as 1 / nu + sigma.
  const double zero = known_beforehand ? kZeroKnown : kZeroUnknown;
  const double unresolved = known_beforehand ? 0.0 : kResolved * std::abs(modes.sigma);
  VectorXd uncertain_of(found);
  for (Index j = 0; j < found; ++j)
    uncertain_of[j] = kEps * modes.vectors.col(j).cwiseAbs2().dot(row_sums);
  team.sum(uncertain_of.data(), found);
  for (Index j = 0; j < found; ++j) {
    const double uncertain = uncertain_of[j];
    const double value = std::abs(modes.values[j]);
    const bool is_zero = value <= std::max(zero * uncertain, unresolved);
    if (!is_zero && modes.values[j] < 0.0)
      throw NumericsError(fmt::format(
          "modes: found lambda = {:.6g} rad2/s2, expected none below 0: a motion that grows, since "
          "the part is stressed beyond its buckling load or has a negative stiffness",
          modes.values[j]));
    if (is_zero)
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
  const VectorXd force = team.norms(pencil.stiffness_times(rigid));
  // In a reduced model |K| |x| may be rounding as well.
  const VectorXd size = team.norms(pencil.magnitude_times(rigid)) +
                        std::abs(modes.sigma) * team.norms(pencil.mass_times(rigid));
  prepend(modes.residuals, force.cwiseQuotient(size));
  // In place: the vectors may fill half the memory.
  modes.vectors.conservativeResize(n, known + found);
  double* data = modes.vectors.data();
  std::copy_backward(data, data + n * found, data + n * (known + found));
  modes.vectors.leftCols(known) = rigid;
}

}  // namespace clatter::sparse
