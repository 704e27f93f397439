// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/shape.hpp"

#include <algorithm>

namespace clatter::mesh {
namespace {

constexpr double kTetCorner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr double kHexCorner[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                     {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
constexpr double kWedgeCorner[6][3] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1},
                                       {0, 0, 1},  {1, 0, 1},  {0, 1, 1}};
constexpr double kPyramidCorner[5][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};

/// A function with its gradient, so that products get their gradient automatically.
template <int Dim>
struct Value {
  double v = 0.0;
  Eigen::Matrix<double, Dim, 1> d = Eigen::Matrix<double, Dim, 1>::Zero();

  Value(double constant) : v(constant) {}  // NOLINT: constants mix freely with functions
  Value(double value, int direction) : v(value) { d(direction) = 1.0; }

  friend Value operator+(Value a, const Value& b) {
    a.v += b.v;
    a.d += b.d;
    return a;
  }
  friend Value operator-(Value a, const Value& b) {
    a.v -= b.v;
    a.d -= b.d;
    return a;
  }
  friend Value operator*(const Value& a, const Value& b) {
    Value out(a.v * b.v);
    out.d = a.v * b.d + b.v * a.d;
    return out;
  }
  friend Value operator/(const Value& a, const Value& b) {
    Value out(a.v / b.v);
    out.d = (a.d - out.v * b.d) / b.v;
    return out;
  }
};

template <int Dim, class Shape>
void put(Shape& shape, int node, const Value<Dim>& f) {
  shape.value(node) = f.v;
  shape.gradient.row(node) = f.d.transpose();
}

template <class Shape>
Shape sized(int nodes) {
  Shape shape;
  shape.value.resize(nodes);
  shape.gradient.resize(nodes, Eigen::NoChange);
  return shape;
}

// Barycentric coordinates of a simplex.
template <int Dim>
std::array<Value<Dim>, Dim + 1> barycentric(const Eigen::Matrix<double, Dim, 1>& xi) {
  if constexpr (Dim == 2) {
    const Value<2> r(xi(0), 0), s(xi(1), 1);
    return {1.0 - r - s, r, s};
  } else {
    const Value<3> r(xi(0), 0), s(xi(1), 1), t(xi(2), 2);
    return {1.0 - r - s - t, r, s, t};
  }
}

template <int Dim, class Shape>
Shape simplex_shape(const Eigen::Matrix<double, Dim, 1>& xi, int order,
                    std::span<const Edge> edges) {
  using F = Value<Dim>;
  const auto L = barycentric<Dim>(xi);
  constexpr int kCorners = Dim + 1;
  const int n = order == 1 ? kCorners : kCorners + static_cast<int>(edges.size());
  Shape shape = sized<Shape>(n);
  for (int i = 0; i < kCorners; ++i) {
    const F& l = L[i];
    put<Dim>(shape, i, order == 1 ? l : l * (F(2.0) * l - 1.0));
  }
  for (int e = 0; kCorners + e < n; ++e) {
    const auto [i, j] = edges[e];
    put<Dim>(shape, kCorners + e, F(4.0) * L[i] * L[j]);
  }
  return shape;
}

// Serendipity functions of a cube of Dim dimensions: `corner[i]` are -1 or 1, edges are parallel to
// one axis each.
template <int Dim, class Shape, class Corners>
Shape cube_shape(const Eigen::Matrix<double, Dim, 1>& xi, int order, int corners,
                 const Corners& corner, std::span<const Edge> edges) {
  using F = Value<Dim>;
  std::array<F, Dim> x = [&] {
    if constexpr (Dim == 2)
      return std::array<F, 2>{F(xi(0), 0), F(xi(1), 1)};
    else
      return std::array<F, 3>{F(xi(0), 0), F(xi(1), 1), F(xi(2), 2)};
  }();
  const int n = order == 1 ? corners : corners + static_cast<int>(edges.size());
  Shape shape = sized<Shape>(n);
  for (int i = 0; i < corners; ++i) {
    F product(1.0 / corners), sum(1.0 - Dim);
    for (int k = 0; k < Dim; ++k) {
      const F along = F(corner[i][k]) * x[k];
      product = product * (1.0 + along);
      sum = sum + along;
    }
    put<Dim>(shape, i, order == 1 ? product : product * sum);
  }
  for (int e = 0; corners + e < n; ++e) {
    const auto [i, j] = edges[e];
    F product(2.0 / corners);
    for (int k = 0; k < Dim; ++k) {
      const F& at = x[k];
      product =
          product * (corner[i][k] == corner[j][k] ? 1.0 + F(corner[i][k]) * at : 1.0 - at * at);
    }
    put<Dim>(shape, corners + e, product);
  }
  return shape;
}

CellShape wedge_shape(const Eigen::Vector3d& xi, int order, std::span<const Edge> edges) {
  using F = Value<3>;
  const F r(xi(0), 0), s(xi(1), 1), z(xi(2), 2);
  const std::array<F, 3> L = {1.0 - r - s, r, s};
  const int n = order == 1 ? 6 : 15;
  CellShape shape = sized<CellShape>(n);
  for (int i = 0; i < 6; ++i) {
    const F& l = L[i % 3];
    const F along = F(kWedgeCorner[i][2]) * z;
    put<3>(shape, i,
           order == 1 ? F(0.5) * l * (1.0 + along)
                      : F(0.5) * l * (1.0 + along) * (F(2.0) * l + along - 2.0));
  }
  for (int e = 0; 6 + e < n; ++e) {
    const auto [i, j] = edges[e];
    const F& l = L[i % 3];
    const bool upright = i % 3 == j % 3;
    const F along = F(kWedgeCorner[i][2]) * z;
    put<3>(shape, 6 + e, upright ? l * (1.0 - z * z) : F(2.0) * l * L[j % 3] * (1.0 + along));
  }
  return shape;
}

CellShape pyramid_shape(const Eigen::Vector3d& xi, int order, std::span<const Edge> edges) {
  using F = Value<3>;
  // The rational terms tend to zero toward the apex; the quotient must only stay finite there.
  const double height = std::min(xi(2), 1.0 - 1e-14);
  const F x(xi(0), 0), y(xi(1), 1), z(height, 2), w = 1.0 - z;
  const int n = order == 1 ? 5 : 13;
  CellShape shape = sized<CellShape>(n);
  for (int i = 0; i < 4; ++i) {
    const F a = F(kPyramidCorner[i][0]) * x, b = F(kPyramidCorner[i][1]) * y;
    const F linear = F(0.25) * ((1.0 + a) * (1.0 + b) - z + a * b * z / w);
    put<3>(shape, i, order == 1 ? linear : linear * (a + b - 1.0));
  }
  put<3>(shape, 4, order == 1 ? z : z * (F(2.0) * z - 1.0));
  for (int e = 0; 5 + e < n; ++e) {
    const auto [i, j] = edges[e];
    const F a = F(kPyramidCorner[i][0]) * x, b = F(kPyramidCorner[i][1]) * y;
    F f(0.0);
    if (j == 4)
      f = z * (w + a) * (w + b) / w;
    else if (kPyramidCorner[i][0] != kPyramidCorner[j][0])
      f = F(0.5) * (w + x) * (w - x) * (w + b) / w;
    else
      f = F(0.5) * (w + y) * (w - y) * (w + a) / w;
    put<3>(shape, 5 + e, f);
  }
  return shape;
}

constexpr double kQuadCorner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
constexpr std::array<Edge, 4> kQuadEdges = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};

const double (*corners_of(CellType type))[3] {
  switch (type) {
    case CellType::kTet4:
    case CellType::kTet10:
      return kTetCorner;
    case CellType::kHex8:
    case CellType::kHex20:
      return kHexCorner;
    case CellType::kWedge6:
    case CellType::kWedge15:
      return kWedgeCorner;
    default:
      return kPyramidCorner;
  }
}

}  // namespace

CellShape cell_shape(CellType type, const Eigen::Vector3d& xi) {
  const CellTraits& cell = traits(type);
  switch (cell.corners) {
    case 4:
      return simplex_shape<3, CellShape>(xi, cell.order, cell.edges);
    case 8:
      return cube_shape<3, CellShape>(xi, cell.order, 8, kHexCorner, cell.edges);
    case 6:
      return wedge_shape(xi, cell.order, cell.edges);
    default:
      return pyramid_shape(xi, cell.order, cell.edges);
  }
}

FaceShape face_shape(FaceType type, const Eigen::Vector2d& xi) {
  const FaceTraits& face = traits(type);
  if (face.corners == 3) return simplex_shape<2, FaceShape>(xi, face.order, kTriangleEdges);
  return cube_shape<2, FaceShape>(xi, face.order, 4, kQuadCorner, kQuadEdges);
}

Eigen::Matrix<double, Eigen::Dynamic, 3> reference_nodes(CellType type) {
  const CellTraits& cell = traits(type);
  const auto corner = corners_of(type);
  Eigen::Matrix<double, Eigen::Dynamic, 3> x(cell.nodes, 3);
  for (int i = 0; i < cell.corners; ++i) x.row(i) << corner[i][0], corner[i][1], corner[i][2];
  for (int e = 0; cell.corners + e < cell.nodes; ++e) {
    const auto [i, j] = cell.edges[e];
    x.row(cell.corners + e) = 0.5 * (x.row(i) + x.row(j));
  }
  return x;
}

Eigen::Matrix<double, Eigen::Dynamic, 2> reference_nodes(FaceType type) {
  const FaceTraits& face = traits(type);
  Eigen::Matrix<double, Eigen::Dynamic, 2> x(face.nodes, 2);
  if (face.corners == 3)
    x.topRows<3>() << 0.0, 0.0, 1.0, 0.0, 0.0, 1.0;
  else
    x.topRows<4>() << -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0, 1.0;
  for (int i = face.corners; i < face.nodes; ++i) {
    const int from = i - face.corners;
    x.row(i) = 0.5 * (x.row(from) + x.row((from + 1) % face.corners));
  }
  return x;
}

}  // namespace clatter::mesh
