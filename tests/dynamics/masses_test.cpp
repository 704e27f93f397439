// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of very different mass in one scene.
#include <gtest/gtest.h>

#include <cmath>

#include "core/dense/symmetric_eigen.hpp"
#include "tests/dynamics/mechanisms.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::started;

TEST(Masses, AGramAKilogramAndATonKeepTheirOwnAccuracyInOneScene) {
  // A chain of three masses and springs, the last one on the ground.
  const double mass[] = {1e-3, 1.0, 1e3}, frequency[] = {450.0, 300.0, 200.0}, end = 0.1;
  Eigen::Matrix3d K = Matrix3d::Zero(), M = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k) {
    const double stiffness = mass[k] * frequency[k] * frequency[k];
    M(k, k) = mass[k];
    K(k, k) += stiffness;
    if (k == 2) continue;
    K(k + 1, k + 1) += stiffness;
    K(k, k + 1) -= stiffness;
    K(k + 1, k) -= stiffness;
  }
  const dense::Eigenpairs exact = dense::symmetric_eigen(K, M);
  const Vector3d start(-0.5, 0.2, 0.1);  // [m/s]
  const Vector3d at = exact.vectors.transpose() * M * start;
  const Eigen::Array3d w = exact.values.array().sqrt();
  const Vector3d expected = exact.vectors * Vector3d(at.array() * (w * end).cos());
  struct Errors {
    Vector3d velocity;  // [m/s]
    double limit;       // of all steps together, all errors in phase [m/s]
  };
  const auto errors = [&](double tolerance) {
    System system;
    std::vector<std::vector<int>> y;
    for (int k = 0; k < 3; ++k) y.push_back(testing::add_slider(system, mass[k], 0.0, start(k)));
    for (size_t k = 0; k < 3; ++k) {
      std::unique_ptr<Port> other = std::make_unique<GroundPort>(Vector3d::Zero());
      if (k < 2) other = std::make_unique<NodePort>(Vector3d::Zero(), y[k + 1]);
      system.add_element(std::make_unique<PairElement>(
          "spring", std::make_unique<NodePort>(Vector3d::Zero(), y[k]), std::move(other),
          linear_joint(mass[k] * frequency[k] * frequency[k], 0.0)));
    }
    StepOptions options;
    options.largest = 1e-3;
    options.accuracy = {tolerance, 1e-3, 0.1, 1.0};
    const auto method = started(system, options);
    while (method->state().time < end) method->step(end);
    Errors found;
    found.limit = static_cast<double>(method->statistics().accepted) * tolerance * 0.1;
    for (int k = 0; k < 3; ++k)
      found.velocity(k) = std::abs(method->state().v_y(y[k][0]) - expected(k));
    return found;
  };
  for (const double tolerance : {1e-3, 1e-5}) {
    const Errors found = errors(tolerance);
    std::printf("tolerance %.0e: errors of 1 g, 1 kg, 1 t %.1e %.1e %.1e m/s, limit %.1e m/s\n",
                tolerance, found.velocity(0), found.velocity(1), found.velocity(2), found.limit);
    // The limit is of each body, the lightest one too, whatever the others weigh.
    for (int k = 0; k < 3; ++k) EXPECT_LT(found.velocity(k), found.limit) << k;
  }
}

}  // namespace
}  // namespace clatter::dynamics
