#include "modal/eigen/mode_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/threads.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRigidRatio = 1e-6;  // |f| < 1e-3 of the first elastic frequency
constexpr Index kColumns = 32;        // of vectors that are handled at a time

int rigid_modes(const VectorXd& values, double sigma) {
  // The first value that is clearly not rigid is the yardstick for those before it.
  const double shift = sigma < 0.0 ? -sigma : 0.0;
  double elastic = shift;
  for (Index j = values.size() - 1; j >= 0; --j) {
    if (values[j] > kRigidRatio * shift) elastic = values[j];
  }
  return static_cast<int>((values.array().abs() < kRigidRatio * elastic).count());
}

}  // namespace

VectorXd residuals_of(const SymmetricProduct& K, const SymmetricProduct& M, const ModeSet& modes) {
  const Index n = K.size();
  VectorXd out(modes.size());
  RowMatrix x, force, inertia;
  for (Index first = 0; first < modes.size(); first += kColumns) {
    const Index count = std::min(kColumns, modes.size() - first);
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

void refuse_residuals(const ModeSet& modes, double most) {
  for (Index j = 0; j < modes.size(); ++j) {
    if (modes.residuals[j] <= most) continue;
    throw NumericsError(
        fmt::format("modes: mode {} at {:.6g} Hz has residual {:.1e}, expected at most {:.1e}",
                    j + 1, hz_of_value(modes.values[j]), modes.residuals[j], most));
  }
}

void present(const std::vector<int64_t>& order, ModeSet& modes) {
  parallel_pieces(modes.size(), [&](int64_t begin, int64_t end) {
    VectorXd inside;
    for (int64_t j = begin; j < end; ++j) {
      auto x = modes.vectors.col(j);
      inside = x;
      for (size_t i = 0; i < order.size(); ++i) x[order[i]] = inside[static_cast<Index>(i)];
      Index largest = 0;
      x.cwiseAbs().maxCoeff(&largest);
      if (x[largest] < 0.0) x *= -1.0;
    }
  });
  modes.rigid = rigid_modes(modes.values, modes.sigma);
}

}  // namespace clatter::modal
