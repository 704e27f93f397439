// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/gasket_statics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/error.hpp"
#include "modal/static_factor.hpp"

namespace clatter::modal {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using sparse::SupernodalFactor;

constexpr int kMostSteps = 60;
constexpr int kMostSingular = 10;    // steps with a tangent that is singular
constexpr double kShortStep = 0.01;  // of Newton's: the tangent is close to singular
constexpr double kDescent = 0.1;     // of the energy that the first derivative promises (Armijo)
constexpr double kHolds = 1e-3;      // of a curve's steepest slope, where a tangent is singular
constexpr double kAtPoint = 1e-9;    // of the largest closure: at a point of the curve

/// What depends on the closures of a gasket.
struct Curve {
  const fe::FeGasket& gasket;
  VectorXd fixed;    // closure by s
  VectorXd closure;  // [m]

  double steepest() const {
    double most = 0.0;
    for (int k = 1; k < std::ssize(gasket.curve.closure); ++k)
      most = std::max(most, gasket.curve.slope(k));
    return most;
  }
  std::vector<int> lines() const {
    std::vector<int> all;
    for (const double c : closure) all.push_back(gasket.curve.line(c));
    return all;
  }
  /// True when the closures lie on these lines, up to rounding at their ends.
  bool on(const std::vector<int>& lines, double rounding) const {
    for (Index k = 0; k < closure.size(); ++k) {
      const int line = gasket.curve.line(closure(k));
      if (line == lines[k]) continue;
      const double end = gasket.curve.closure[std::min(line, lines[k])];
      if (std::abs(line - lines[k]) > 1 || std::abs(closure(k) - end) > rounding) return false;
    }
    return true;
  }
  /// Pressure less that of the stiffness in K.
  VectorXd beyond() const {
    VectorXd out(closure.size());
    for (Index k = 0; k < out.size(); ++k)
      out(k) = gasket.curve.pressure_at(closure(k)) - gasket.stiffness * closure(k);
    return out;
  }
};

class Pressing {
 public:
  Pressing(const fe::FeModel& model, const VectorXd& driven, const VectorXd& s)
      : model_(model), driven_(driven), q_(VectorXd::Zero(driven.size())) {
    for (const fe::FeGasket& gasket : model.gaskets) {
      VectorXd fixed = gasket.closing_s * s;
      curves_.push_back({gasket, fixed, fixed});
    }
  }

  PressedSolution solve(const std::string& where) {
    int singular = 0;
    for (int step = 1; step <= kMostSteps && singular <= kMostSingular; ++step) {
      const std::vector<std::vector<int>> lines = lines_now();
      const SparseMatrix K = tangent(lines, 0.0);
      std::optional<SupernodalFactor> factor;
      if (length_ > kShortStep) factor = positive(K);
      const bool exact = factor.has_value();
      if (!exact) factor = explained_factor(model_, tangent(lines, kHolds));
      move(*factor);
      if (exact && length_ == 1.0 && settled(lines)) {
        PressedSolution found = finish(*factor, K, lines, step);
        // Rounding may hide that the tangent is singular; then no digit of the solution is right.
        if (found.solved.forward[0] <= 1.0) return found;
        break;
      }
      if (exact) continue;
      ++singular;
      length_ = 1.0;
    }
    throw NumericsError(fmt::format(
        "{}: found no state of the gaskets that carries the loads, expected one: does a "
        "part hang on open gaskets alone?",
        where));
  }

 private:
  static std::optional<SupernodalFactor> positive(const SparseMatrix& K) {
    try {
      return static_factor(K);
    } catch (const sparse::NotPositiveDefinite&) {
      return {};
    }
  }

  std::vector<std::vector<int>> lines_now() const {
    std::vector<std::vector<int>> all;
    for (const Curve& curve : curves_) all.push_back(curve.lines());
    return all;
  }

  bool settled(const std::vector<std::vector<int>>& lines) const {
    double most = 0.0;
    for (const Curve& curve : curves_)
      most = std::max(most, curve.closure.lpNorm<Eigen::Infinity>());
    for (size_t g = 0; g < curves_.size(); ++g)
      if (!curves_[g].on(lines[g], kAtPoint * most)) return false;
    return true;
  }

  /// K with the slopes of the lines. @param least of the steepest slope.
  SparseMatrix tangent(const std::vector<std::vector<int>>& lines, double least) const {
    SparseMatrix K = model_.K;
    for (size_t g = 0; g < curves_.size(); ++g) {
      const fe::FeGasket& gasket = curves_[g].gasket;
      const double floor = least * curves_[g].steepest();
      VectorXd change(gasket.area.size());
      for (Index k = 0; k < change.size(); ++k)
        change(k) =
            gasket.area(k) * (std::max(floor, gasket.curve.slope(lines[g][k])) - gasket.stiffness);
      const SparseMatrix right = change.asDiagonal() * gasket.closing;
      K += SparseMatrix(SparseMatrix(gasket.closing.transpose()) * right)
               .triangularView<Eigen::Lower>();
    }
    return K;
  }

  VectorXd residual() const {
    VectorXd r = driven_ - VectorXd(multiply_symmetric(model_.K, q_));
    for (const Curve& curve : curves_)
      r -= curve.gasket.closing.transpose() * curve.gasket.area.cwiseProduct(curve.beyond());
    return r;
  }

  /// A Newton step, as long as it takes to the least energy on its way.
  void move(const SupernodalFactor& factor) {
    const VectorXd dq = factor.solve(residual());
    const double rise = dq.dot(VectorXd(multiply_symmetric(model_.K, dq)));
    const double fall = dq.dot(driven_ - VectorXd(multiply_symmetric(model_.K, q_)));
    std::vector<VectorXd> change;
    for (const Curve& curve : curves_) change.push_back(curve.gasket.closing * dq);
    // The derivative of the energy along the step; it does not fall.
    const auto slope_at = [&](double t) {
      double sum = t * rise - fall;
      for (size_t g = 0; g < curves_.size(); ++g) {
        Curve there = curves_[g];
        there.closure += t * change[g];
        sum += there.gasket.area.cwiseProduct(there.beyond()).dot(change[g]);
      }
      return sum;
    };
    length_ = length_of(slope_at);
    q_ += length_ * dq;
    for (size_t g = 0; g < curves_.size(); ++g) curves_[g].closure += length_ * change[g];
  }

  /// 1 where that surely lowers the energy: its change is at most the mean of the derivatives in
  /// the middle and at the end, since they do not fall. Else the least energy, by bisection.
  template <typename Slope>
  static double length_of(const Slope& slope_at) {
    const double start = slope_at(0.0);
    if (slope_at(0.5) + slope_at(1.0) <= kDescent * start) return 1.0;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 40; ++k) {
      const double mid = 0.5 * (low + high);
      (slope_at(mid) > 0.0 ? high : low) = mid;
    }
    return low > 0.0 ? low : high;
  }

  /// Solves the linear equations of the lines once more, with errors.
  PressedSolution finish(const SupernodalFactor& factor, const SparseMatrix& K,
                         const std::vector<std::vector<int>>& lines, int steps) {
    VectorXd f = driven_;
    for (size_t g = 0; g < curves_.size(); ++g) {
      const auto& [gasket, fixed, closure] = curves_[g];
      VectorXd beyond(fixed.size());  // at q = 0
      for (Index k = 0; k < fixed.size(); ++k)
        beyond(k) = gasket.curve.pressure_on(lines[g][k], fixed(k)) - gasket.stiffness * fixed(k);
      f -= gasket.closing.transpose() * gasket.area.cwiseProduct(beyond);
    }
    PressedSolution out{.solved = solve_refined(factor, K, f),
                        .factor = factor.report(),
                        .steps = steps,
                        .on_s = VectorXd::Zero(model_.supports.size())};
    for (Curve& curve : curves_) {
      const fe::FeGasket& gasket = curve.gasket;
      curve.closure = curve.fixed + gasket.closing * out.solved.x.col(0);
      fe::GasketState state{curve.closure, VectorXd(curve.closure.size())};
      for (Index k = 0; k < state.pressure.size(); ++k) {
        const double c = state.closure(k);
        state.pressure(k) = gasket.curve.pressure_at(c);
        out.energy += gasket.area(k) * (gasket.curve.energy(c) - 0.5 * gasket.stiffness * c * c);
      }
      out.on_s += gasket.closing_s.transpose() * gasket.area.cwiseProduct(curve.beyond());
      out.gaskets.push_back(std::move(state));
    }
    return out;
  }

  const fe::FeModel& model_;
  const VectorXd& driven_;
  VectorXd q_;
  std::vector<Curve> curves_;
  double length_ = 1.0;  // of the last step with the tangent
};

}  // namespace

PressedSolution solve_pressed(const fe::FeModel& model, const Eigen::VectorXd& driven,
                              const Eigen::VectorXd& s, const std::string& where) {
  return Pressing(model, driven, s).solve(where);
}

GasketSums sums_of(const fe::FeGasket& gasket, const fe::GasketState& state) {
  GasketSums sums{.area = gasket.area.sum(), .force = gasket.area.dot(state.pressure)};
  for (Index k = 0; k < gasket.area.size(); ++k) {
    if (state.pressure(k) > 0.0) sums.pressed += gasket.area(k);
    sums.highest = std::max(sums.highest, state.pressure(k));
    sums.opening = std::max(sums.opening, gasket.curve.closure[0] - state.closure(k));
  }
  return sums;
}

}  // namespace clatter::modal
