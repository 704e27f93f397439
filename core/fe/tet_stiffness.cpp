// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/fe/tet_stiffness.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

namespace clatter::fe {
namespace {

/// Isotropic stiffness from H = int g g^T, g = (dN_1/dx, dN_1/dy, ...):
///   K(a i, b j) = lambda H(a i, b j) + mu H(a j, b i) + mu delta_ij sum_k H(a k, b k).
template <int N>
void spread(const Eigen::Matrix<double, 3 * N, 3 * N>& H, const Material& material,
            Eigen::MatrixXd& K) {
  const double lambda = material.lambda(), mu = material.mu();
  for (int b = 0; b < N; ++b) {
    for (int a = b; a < N; ++a) {
      const Eigen::Matrix3d block = H.template block<3, 3>(3 * a, 3 * b);
      Eigen::Matrix3d stiffness = lambda * block + mu * block.transpose();
      stiffness.diagonal().array() += mu * block.trace();
      K.block<3, 3>(3 * a, 3 * b) = stiffness;
      if (a != b) K.block<3, 3>(3 * b, 3 * a) = stiffness.transpose();
    }
  }
}

template <int N>
double stiffness_of(const mesh::CellNodes& nodes, const Material& material,
                    const CellPoints& points, Eigen::MatrixXd& K) {
  const Eigen::Matrix<double, N, 3> x = nodes;
  Eigen::Matrix<double, 3 * N, 3 * N> H = Eigen::Matrix<double, 3 * N, 3 * N>::Zero();
  double smallest = std::numeric_limits<double>::infinity();
  for (const CellPoint& point : points) {
    const Eigen::Matrix<double, N, 3> slope = point.shape.gradient;
    const Eigen::Matrix3d J = x.transpose() * slope;  // J(i, k) = dx_i / dxi_k
    const double det = J.determinant();
    smallest = std::min(smallest, det);
    if (!(det > 0.0)) return smallest;
    // Row-major so that the rows (dN_a/dx, dN_a/dy, dN_a/dz) are contiguous in memory.
    const Eigen::Matrix<double, N, 3, Eigen::RowMajor> g = slope * J.inverse();
    const Eigen::Map<const Eigen::Matrix<double, 3 * N, 1>> flat(g.data());
    H.noalias() += (point.weight * det) * flat * flat.transpose();
  }
  spread<N>(H, material, K);
  return smallest;
}

}  // namespace

double tet_stiffness(mesh::CellType type, const mesh::CellNodes& x, const Material& material,
                     const CellPoints& points, Eigen::MatrixXd& K) {
  return type == mesh::CellType::kTet4 ? stiffness_of<4>(x, material, points, K)
                                       : stiffness_of<10>(x, material, points, K);
}

}  // namespace clatter::fe
