// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/cad/skin_crossing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace clatter::mesh {
namespace {

using Eigen::Vector3d;

struct Triangle {
  std::array<int32_t, 3> nodes;
  int face;
};

// The intersection of the segment from a to b with the interior of the triangle.
std::optional<Vector3d> pierce(const Vector3d& a, const Vector3d& b,
                               const std::array<Vector3d, 3>& t) {
  const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double from = normal.dot(a - t[0]), to = normal.dot(b - t[0]);
  if ((from > 0.0) == (to > 0.0)) return std::nullopt;
  const Vector3d at = a + from / (from - to) * (b - a);
  for (size_t i = 0; i < 3; ++i) {
    const Vector3d edge = t[(i + 1) % 3] - t[i];
    if (edge.cross(at - t[i]).dot(normal) < 0.0) return std::nullopt;
  }
  return at;
}

// Triangles by the grid cubes that their boxes overlap.
class Grid {
 public:
  Grid(const RowMatrix& nodes, const std::vector<Triangle>& triangles) : nodes_(nodes) {
    double sum = 0.0;
    for (const Triangle& t : triangles) sum += (box(t).second - box(t).first).norm();
    side_ = std::max(sum / static_cast<double>(std::max<size_t>(triangles.size(), 1)), 1e-300);
    for (size_t i = 0; i < triangles.size(); ++i)
      for_each_cube(box(triangles[i]), [&](int64_t cube) { cubes_[cube].push_back(i); });
  }

  std::vector<size_t> near(const Triangle& t) const {
    std::vector<size_t> found;
    for_each_cube(box(t), [&](int64_t cube) {
      if (const auto at = cubes_.find(cube); at != cubes_.end())
        found.insert(found.end(), at->second.begin(), at->second.end());
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  std::pair<Vector3d, Vector3d> box(const Triangle& t) const {
    Vector3d low = nodes_.row(t.nodes[0]), high = low;
    for (int32_t n : t.nodes) {
      low = low.cwiseMin(nodes_.row(n).transpose());
      high = high.cwiseMax(nodes_.row(n).transpose());
    }
    return {low, high};
  }

  template <class Visit>
  void for_each_cube(const std::pair<Vector3d, Vector3d>& box, const Visit& visit) const {
    const auto index = [&](double x) { return static_cast<int64_t>(std::floor(x / side_)); };
    constexpr int64_t kStride = 1 << 20;
    for (int64_t i = index(box.first.x()); i <= index(box.second.x()); ++i)
      for (int64_t j = index(box.first.y()); j <= index(box.second.y()); ++j)
        for (int64_t k = index(box.first.z()); k <= index(box.second.z()); ++k)
          visit((i * kStride + j) * kStride + k);
  }

  const RowMatrix& nodes_;
  double side_ = 1.0;
  std::unordered_map<int64_t, std::vector<size_t>> cubes_;
};

bool share_a_node(const Triangle& a, const Triangle& b) {
  return std::any_of(a.nodes.begin(), a.nodes.end(), [&](int32_t n) {
    return std::find(b.nodes.begin(), b.nodes.end(), n) != b.nodes.end();
  });
}

}  // namespace

std::vector<SkinCrossing> find_crossings(const RowMatrix& nodes,
                                         const std::map<int, IndexMatrix>& triangles) {
  std::vector<Triangle> all;
  for (const auto& [face, table] : triangles)
    for (Eigen::Index r = 0; r < table.rows(); ++r)
      all.push_back({{table(r, 0), table(r, 1), table(r, 2)}, face});
  const Grid grid(nodes, all);
  const auto at = [&](int32_t n) { return Vector3d(nodes.row(n)); };
  std::map<std::pair<int, int>, SkinCrossing> found;
  for (const Triangle& t : all) {
    const std::array<Vector3d, 3> corners = {at(t.nodes[0]), at(t.nodes[1]), at(t.nodes[2])};
    for (size_t i : grid.near(t)) {
      const Triangle& other = all[i];
      if (share_a_node(t, other)) continue;
      for (size_t e = 0; e < 3; ++e) {
        const auto position = pierce(at(other.nodes[e]), at(other.nodes[(e + 1) % 3]), corners);
        if (!position) continue;
        const std::pair pair(std::min(t.face, other.face), std::max(t.face, other.face));
        ++found.try_emplace(pair, SkinCrossing{pair.first, pair.second, 0, *position})
              .first->second.count;
      }
    }
  }
  std::vector<SkinCrossing> list;
  for (const auto& entry : found) list.push_back(entry.second);
  return list;
}

std::string describe_crossings(const std::vector<SkinCrossing>& crossings) {
  constexpr size_t kMost = 8;
  std::vector<std::string> texts;
  for (size_t i = 0; i < std::min(kMost, crossings.size()); ++i) {
    const SkinCrossing& c = crossings[i];
    texts.push_back(
        fmt::format("face {} and face {} at ({:.5g}, {:.5g}, {:.5g}) ({} intersections)", c.face,
                    c.other, c.position.x(), c.position.y(), c.position.z(), c.count));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace clatter::mesh
