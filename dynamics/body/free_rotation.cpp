// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/body/free_rotation.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "dynamics/body/rotation.hpp"

namespace clatter::dynamics {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace {

constexpr size_t kOrder = 20;
/// Of the last terms of the series, relative to the first: below rounding.
constexpr double kRest = 0.1 * std::numeric_limits<double>::epsilon();

/// The length within which a term c t^order is below kRest.
double reach(double c, size_t order) {
  return c > 0.0 ? std::pow(kRest / c, 1.0 / static_cast<double>(order))
                 : std::numeric_limits<double>::infinity();
}

/// Moves q by at most `left` [s], either sign, and returns the time it moved.
double advance(const Matrix3d& inverse, const Vector3d& momentum, double left, Vector4d& q) {
  std::array<Vector3d, kOrder + 1> m, w;
  std::array<Vector4d, kOrder + 1> r;
  r[0] = q;
  m[0] = rotation_matrix(q).transpose() * momentum;
  const double size = m[0].norm();
  for (size_t k = 0; k < kOrder; ++k) {
    w[k] = inverse * m[k];
    m[k + 1].setZero();
    r[k + 1].setZero();
    for (size_t j = 0; j <= k; ++j) {
      m[k + 1] += m[j].cross(w[k - j]);
      r[k + 1] += quaternion_rates(r[j]) * w[k - j];
    }
    m[k + 1] /= static_cast<double>(k + 1);
    r[k + 1] /= 2.0 * static_cast<double>(k + 1);
  }
  double length = std::abs(left);
  for (const size_t k : {kOrder - 1, kOrder})
    length = std::min(
        {length, reach(r[k].norm(), k), size > 0.0 ? reach(m[k].norm() / size, k) : length});
  const double step = std::copysign(length, left);
  q = r[kOrder];
  for (size_t k = kOrder; k-- > 0;) q = q * step + r[k];
  q.normalize();
  return length < std::abs(left) ? step : left;
}

}  // namespace

FreeRotation::FreeRotation(const Matrix3d& inertia, double time, const Vector4d& rotation,
                           const Vector3d& spin)
    : inertia_(inertia), inverse_(inertia.inverse()) {
  restart(time, rotation, spin);
}

void FreeRotation::restart(double time, const Vector4d& rotation, const Vector3d& spin) {
  start_ = time_ = time;
  first_ = {rotation, rotation_matrix(rotation), spin};
  momentum_ = first_.A * (inertia_ * (first_.A.transpose() * spin));
  last_ = first_;
}

const Attitude& FreeRotation::at(double time) const {
  if (time == start_) return first_;
  if (time == time_) return last_;
  Vector4d q = first_.q;
  for (double left = time - start_; left != 0.0;) left -= advance(inverse_, momentum_, left, q);
  const Matrix3d A = rotation_matrix(q);
  last_ = {q, A, A * (inverse_ * (A.transpose() * momentum_))};
  time_ = time;
  return last_;
}

}  // namespace clatter::dynamics
