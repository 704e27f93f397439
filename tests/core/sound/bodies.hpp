// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Closed surfaces and sources with known sound.
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "core/sound/radiation.hpp"

namespace clatter::sound::testing {

struct Triangles {
  RowMatrix nodes;
  IndexMatrix faces;
};

/// The icosahedron, each face divided `levels` times in four, all nodes on the unit sphere.
inline Triangles sphere_triangles(int levels) {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<Eigen::Vector3d> points = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                         {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                         {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  std::vector<std::array<int, 3>> faces = {
      {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
      {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
      {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [at, added] =
          middles.try_emplace(std::minmax(a, b), static_cast<int>(points.size()));
      if (added) points.push_back(points[a].normalized() + points[b].normalized());
      return at->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : faces) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    faces = finer;
  }
  Triangles out{RowMatrix(points.size(), 3), IndexMatrix(faces.size(), 3)};
  for (size_t n = 0; n < points.size(); ++n)
    out.nodes.row(static_cast<Eigen::Index>(n)) = points[n].normalized().transpose();
  for (size_t f = 0; f < faces.size(); ++f)
    for (int a = 0; a < 3; ++a) out.faces(static_cast<Eigen::Index>(f), a) = faces[f][a];
  return out;
}

/// A sphere of radius 1 [m] in the sense that its flat faces enclose the volume 4 pi / 3.
inline Surface unit_sphere(int levels) {
  const Triangles sphere = sphere_triangles(levels);
  const Surface inside = closed_surface(sphere.nodes, sphere.faces);
  const double factor = std::cbrt(4.0 / 3.0 * std::numbers::pi / inside.volume);
  return closed_surface(factor * sphere.nodes, sphere.faces);
}

/// A bent egg without symmetry, about 1 x 0.6 x 0.8 m.
inline Surface bent_egg(int levels) {
  Triangles egg = sphere_triangles(levels);
  for (Eigen::Index n = 0; n < egg.nodes.rows(); ++n) {
    const Eigen::Vector3d p = egg.nodes.row(n);
    egg.nodes.row(n) << 0.5 * p[0], 0.3 * p[1] + 0.15 * p[0] * p[0], 0.4 * p[2] + 0.1 * p[0] * p[1];
  }
  return closed_surface(egg.nodes, egg.faces);
}

/// A box of this size about the origin, each side divided into squares of two triangles.
inline Surface box(const Eigen::Vector3d& size, double edge) {
  std::map<std::array<int, 3>, int> node_of;
  std::vector<std::array<int, 3>> faces;
  std::array<int, 3> n;
  for (int d = 0; d < 3; ++d) n[d] = std::max(1, static_cast<int>(std::lround(size[d] / edge)));
  const auto node = [&](std::array<int, 3> at) {
    return node_of.try_emplace(at, static_cast<int>(node_of.size())).first->second;
  };
  for (size_t d = 0; d < 3; ++d)
    for (int far = 0; far < 2; ++far) {
      const size_t u = (d + 1) % 3, v = (d + 2) % 3;
      for (int i = 0; i < n[u]; ++i)
        for (int j = 0; j < n[v]; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> p{};
            p[d] = far ? n[d] : 0;
            p[u] = i + di;
            p[v] = j + dj;
            return node(p);
          };
          std::array<int, 4> q = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          if (!far) std::swap(q[1], q[3]);
          faces.push_back({q[0], q[1], q[2]});
          faces.push_back({q[0], q[2], q[3]});
        }
    }
  RowMatrix nodes(node_of.size(), 3);
  for (const auto& [at, index] : node_of)
    for (size_t d = 0; d < 3; ++d)
      nodes(index, static_cast<Eigen::Index>(d)) =
          size[static_cast<Eigen::Index>(d)] * (at[d] / static_cast<double>(n[d]) - 0.5);
  IndexMatrix table(faces.size(), 3);
  for (size_t f = 0; f < faces.size(); ++f)
    for (size_t a = 0; a < 3; ++a)
      table(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(a)) = faces[f][a];
  return closed_surface(nodes, table);
}

inline const Space kAir{{1.204, 343.2}};

/// The frequency at which k = 2 pi f / c in kAir.
inline double frequency_of(double k) {
  return k * kAir.fluid.sound_speed / (2.0 * std::numbers::pi);
}

/// p = A exp(-i k r) / r about `centre`, and its normal velocity through faces.
struct Monopole {
  Eigen::Vector3d centre;
  Complex strength{0.4, 0.3};  // A [Pa m]

  Complex pressure(double k, const Eigen::Vector3d& x) const {
    const double r = (x - centre).norm();
    return strength * std::polar(1.0, -k * r) / r;
  }
  /// -dp/dn / (i omega rho), by the linear function with its values at three points of each face:
  /// 3 n_f.
  Eigen::VectorXcd velocity(double k, const Surface& surface) const {
    Eigen::VectorXcd out(3 * surface.face_count());
    for (Eigen::Index f = 0; f < surface.face_count(); ++f) {
      Eigen::Vector3cd v;
      for (int a = 0; a < 3; ++a) {
        const Eigen::Vector3d x =
            0.5 * (surface.face_centre.row(f) + surface.nodes.row(surface.triangles(f, a)));
        const Eigen::Vector3d d = x - centre;
        const double r = d.norm();
        const Complex slope = pressure(k, x) * Complex(-1.0 / r, -k) / r *
                              d.dot(surface.face_normal.row(f).transpose());
        v[a] = -slope / (Complex(0.0, k) * kAir.fluid.impedance());
      }
      // A corner lies as far beyond its point as the point is from the centre.
      out.segment(3 * f, 3) = 2.0 * v - Eigen::Vector3cd::Constant(v.sum() / 3.0);
    }
    return out;
  }
  /// [W], in free space.
  double power() const {
    return 2.0 * std::numbers::pi * std::norm(strength) / kAir.fluid.impedance();
  }
};

}  // namespace clatter::sound::testing
