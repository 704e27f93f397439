// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A block with four equal cylinders in a row, the typical symmetry of engines.
#include <array>
#include <map>
#include <vector>

#include "tests/core/sparse/spring_models.hpp"

namespace clatter::test {

/// Four square rings of point masses around open bores along z, neighbours connected by springs
/// `weak` times as stiff as the others. The block is symmetric under x -> -x: node a + half is the
/// image of node a.
struct FourCylinders : Pencil {
  int half = 0;  // nodes on one side of the mirror

  /// The mirror image of a displacement vector.
  Eigen::VectorXd image(const Eigen::VectorXd& u) const {
    Eigen::VectorXd out(u.size());
    out << u.tail(3 * half), u.head(3 * half);
    for (int a = 0; a < 2 * half; ++a) out[3 * a] = -out[3 * a];
    return out;
  }
};

/// One side, grid points with x < 0; bay 0 is adjacent to the mirror plane.
inline std::vector<std::array<int, 3>> two_bays(int ring, int height) {
  std::vector<std::array<int, 3>> points;
  for (int x = 1; x <= 2 * ring; ++x)
    for (int z = 0; z < height; ++z)
      for (int y = 0; y < ring; ++y) {
        const int inside = (x - 1) % ring;
        const bool bore = inside > 1 && inside < ring - 2 && y > 1 && y < ring - 2;
        if (!bore) points.push_back({-x, y, z});
      }
  return points;
}

inline FourCylinders four_cylinders(double weak, int ring = 6, int height = 3, double k = 1e8,
                                    double m = 0.05) {
  const std::vector<std::array<int, 3>> points = two_bays(ring, height);
  std::map<std::array<int, 3>, int> at;
  for (const auto& point : points) at.emplace(point, static_cast<int>(at.size()));
  FourCylinders block;
  block.half = static_cast<int>(points.size());
  std::vector<Eigen::Triplet<double>> entries;
  const auto spring = [&](int a, int b, const Eigen::Vector3d& d, double stiffness) {
    const Eigen::Matrix3d s = stiffness * d * d.transpose();
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) {
        entries.emplace_back(3 * a + p, 3 * a + q, s(p, q));
        entries.emplace_back(3 * b + p, 3 * b + q, s(p, q));
        entries.emplace_back(3 * a + p, 3 * b + q, -s(p, q));
        entries.emplace_back(3 * b + p, 3 * a + q, -s(p, q));
      }
  };
  for (const auto& [p, a] : at)
    for (int step = 14; step < 27; ++step) {  // the later half of the 26 neighbours
      const int dx = step / 9 - 1, dy = step / 3 % 3 - 1, dz = step % 3 - 1;
      const auto ahead = at.find({p[0] + dx, p[1] + dy, p[2] + dz});
      const Eigen::Vector3d d = Eigen::Vector3d(dx, 1.1 * dy, 1.3 * dz).normalized();
      if (ahead != at.end()) {
        const double joint = (p[0] + 1) / ring == (p[0] + dx + 1) / ring ? k : weak * k;
        spring(a, ahead->second, d, joint);
        spring(a + block.half, ahead->second + block.half, {-d[0], d[1], d[2]}, joint);
      } else if (p[0] + dx == 0) {  // across the mirror plane
        const auto beyond = at.find({-1, p[1] + dy, p[2] + dz});
        if (beyond != at.end()) spring(a, beyond->second + block.half, d, weak * k);
      }
    }
  const int n = 6 * block.half;
  block.K = from_triplets(n, entries);
  block.M = diagonal(Eigen::VectorXd::Constant(n, m));
  return block;
}

}  // namespace clatter::test
