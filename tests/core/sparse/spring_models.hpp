// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Small models with known or cheaply computed spectra: chains and elastic boxes of springs.
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/sparse.hpp"
#include "core/sparse/eigen/eigen_solver.hpp"

namespace clatter::test {

struct Pencil {
  SparseMatrix K, M;  // lower triangles
};

inline SparseMatrix from_triplets(int n, const std::vector<Eigen::Triplet<double>>& entries) {
  SparseMatrix full(n, n);
  full.setFromTriplets(entries.begin(), entries.end());
  return full.triangularView<Eigen::Lower>();
}

inline SparseMatrix diagonal(const Eigen::VectorXd& values) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < values.size(); ++i) entries.emplace_back(i, i, values[i]);
  return from_triplets(static_cast<int>(values.size()), entries);
}

/// n equal masses m in a row, springs k between them, free at both ends:
/// lambda_j = 4 k/m sin^2(j pi / 2n), j = 0 .. n-1.
inline Pencil free_chain(int n, double k = 1e7, double m = 0.1) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i + 1 < n; ++i) {
    entries.emplace_back(i, i, k);
    entries.emplace_back(i + 1, i + 1, k);
    entries.emplace_back(i + 1, i, -k);
  }
  return {from_triplets(n, entries), diagonal(Eigen::VectorXd::Constant(n, m))};
}

inline double free_chain_value(int n, int j, double k = 1e7, double m = 0.1) {
  return 4.0 * k / m * std::pow(std::sin(j * std::numbers::pi / (2.0 * n)), 2);
}

/// Two copies of a model that are not connected: every eigenvalue is double (hard case A2).
inline Pencil twice(const Pencil& one) {
  const int n = static_cast<int>(one.K.rows());
  const auto doubled = [n](const SparseMatrix& matrix) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < n; ++j) {
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it) {
        const int row = static_cast<int>(it.row());
        entries.emplace_back(row, j, it.value());
        entries.emplace_back(row + n, j + n, it.value());
      }
    }
    return from_triplets(2 * n, entries);
  };
  return {doubled(one.K), doubled(one.M)};
}

/// A free elastic box of nx x ny x nz point masses at distance `pitch`, connected to all neighbours
/// in the cube around them by axial springs; DoF 3 a + d. Exactly six rigid-body motions.
struct SpringBox : Pencil {
  Eigen::MatrixXd nodes;  // a x 3
  Eigen::MatrixXd rigid;  // n x 6, unit motions about the origin
};

inline SpringBox spring_box(int nx, int ny, int nz, double pitch = 0.02, double k = 1e8,
                            double m = 0.05) {
  SpringBox box;
  const int count = nx * ny * nz;
  const auto id = [&](int x, int y, int z) { return (z * ny + y) * nx + x; };
  box.nodes.resize(count, 3);
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        box.nodes.row(id(x, y, z)) = pitch * Eigen::RowVector3d(x, 1.1 * y, 1.3 * z);
  std::vector<Eigen::Triplet<double>> entries;
  const auto join = [&](int a, int b) {
    const Eigen::RowVector3d d = (box.nodes.row(b) - box.nodes.row(a)).normalized();
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        const double value = k * d[p] * d[q];
        entries.emplace_back(3 * a + p, 3 * a + q, value);
        entries.emplace_back(3 * b + p, 3 * b + q, value);
        entries.emplace_back(3 * a + p, 3 * b + q, -value);
        entries.emplace_back(3 * b + p, 3 * a + q, -value);
      }
  };
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        for (int dz = 0; dz <= 1; ++dz)
          for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
              const bool forward = dz > 0 || dy > 0 || (dy == 0 && dx > 0);
              if (!forward || x + dx < 0 || x + dx >= nx || y + dy < 0 || y + dy >= ny ||
                  z + dz >= nz)
                continue;
              join(id(x, y, z), id(x + dx, y + dy, z + dz));
            }
  box.K = from_triplets(3 * count, entries);
  Eigen::VectorXd mass(3 * count);
  for (int a = 0; a < count; ++a) mass.segment(3 * a, 3).setConstant(m * (1.0 + 0.3 * (a % 5)));
  box.M = diagonal(mass);
  box.rigid = Eigen::MatrixXd::Zero(3 * count, 6);
  for (int a = 0; a < count; ++a) {
    const Eigen::RowVector3d r = box.nodes.row(a);
    box.rigid.block<3, 3>(3 * a, 0).setIdentity();
    box.rigid.block<3, 3>(3 * a, 3) << 0, r.z(), -r.y(), -r.z(), 0, r.x(), r.y(), -r.x(), 0;
  }
  return box;
}

inline sparse::EigenOptions by_count(
    int count, sparse::EigenMethod method = sparse::EigenMethod::kBlockLanczos) {
  sparse::EigenOptions options;
  options.count = count;
  options.method = method;
  return options;
}

constexpr sparse::EigenMethod kBoth[] = {sparse::EigenMethod::kBlockLanczos,
                                         sparse::EigenMethod::kArpack};

}  // namespace clatter::test
