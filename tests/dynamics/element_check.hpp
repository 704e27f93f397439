// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Checks of the tangent and the power of one force element.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dynamics/element/element.hpp"

namespace clatter::dynamics::testing {

/// The tangent of all coordinates.
inline Eigen::MatrixXd complete_tangent(const Response& response) {
  const Eigen::Index n = response.force.size();
  if (response.touched.empty()) return response.tangent;
  Eigen::MatrixXd tangent = Eigen::MatrixXd::Zero(n, n);
  tangent(response.touched, response.touched) = response.tangent;
  return tangent;
}

/// Largest difference of the columns of the tangent from central differences over 2 `h`, relative
/// to the tangent; y = `before` + kappa v at the stage.
inline double tangent_error(ForceElement& element, const Stage& stage, const Eigen::VectorXd& y,
                            const Eigen::VectorXd& before, double h) {
  Response at, plus, minus;
  element.evaluate(stage, y, (y - before) / stage.kappa, true, at);
  const Eigen::MatrixXd tangent = complete_tangent(at);
  double worst = 0.0;
  for (Eigen::Index j = 0; j < y.size(); ++j) {
    Eigen::VectorXd a = y, b = y;
    a(j) += h;
    b(j) -= h;
    element.evaluate(stage, a, (a - before) / stage.kappa, false, plus);
    element.evaluate(stage, b, (b - before) / stage.kappa, false, minus);
    const Eigen::VectorXd column = (plus.force - minus.force) / (2.0 * h);
    worst = std::max(worst, (column - tangent.col(j)).norm() / tangent.norm());
  }
  return worst;
}

/// |force . v + d(stored)/dt + lost - input| over their sizes, of a motion through y with velocity
/// v at `time`; something is lost.
inline double power_error(ForceElement& element, double time, const Eigen::VectorXd& y,
                          const Eigen::VectorXd& v, double h) {
  Response response;
  const auto at = [&](double t) {
    element.evaluate({t, 1e-6, 1, {}}, y + (t - time) * v, v, false, response);
    element.finish_stage({t, 1e-6, 1, {}});
    return element.power(y, v);
  };
  const double rate = (at(time + h).stored - at(time - h).stored) / (2.0 * h);
  const Power power = at(time);
  EXPECT_GT(power.lost, 0.0);
  const double work = response.force.dot(v);
  return std::abs(work + rate + power.lost - power.input) /
         (std::abs(work) + power.lost + std::abs(power.input));
}

}  // namespace clatter::dynamics::testing
