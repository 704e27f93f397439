// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/mesh/cube_bernstein.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/mesh/shape.hpp"

namespace clatter::mesh {
namespace {

// Degrees of det J along the cube's axes; a test checks that the interpolation is exact.
std::array<int, 3> degree_of(CellType type) {
  switch (type) {
    case CellType::kHex20:
      return {5, 5, 5};
    case CellType::kWedge6:
      return {1, 1, 2};
    case CellType::kWedge15:
      return {4, 4, 5};
    case CellType::kPyramid5:
      return {2, 2, 0};
    default:
      return {5, 5, 3};
  }
}

// Chebyshev points of (0, 1): interior points, where the pyramid's functions have gradients.
Eigen::VectorXd line_points(int degree) {
  Eigen::VectorXd at(degree + 1);
  for (int i = 0; i <= degree; ++i)
    at(i) = 0.5 - 0.5 * std::cos((i + 0.5) * std::numbers::pi / (degree + 1));
  return at;
}

// Values at the line points to Bernstein coefficients.
Eigen::MatrixXd to_bernstein(int degree) {
  const Eigen::VectorXd at = line_points(degree);
  Eigen::MatrixXd basis(degree + 1, degree + 1);
  for (int i = 0; i <= degree; ++i) {
    double binomial = 1.0;
    for (int k = 0; k <= degree; ++k) {
      basis(i, k) = binomial * std::pow(at(i), k) * std::pow(1.0 - at(i), degree - k);
      binomial = binomial * (degree - k) / (k + 1);
    }
  }
  return basis.inverse();
}

struct Sampling {
  std::array<int, 3> degree;
  std::array<Eigen::MatrixXd, 3> bernstein;
  // dN/dxi_k: a row for each point, last axis fastest, a column for each node.
  std::array<Eigen::MatrixXd, 3> gradients;
};

Sampling make_sampling(CellType type) {
  Sampling s{degree_of(type), {}, {}};
  std::array<Eigen::VectorXd, 3> at;
  for (size_t axis = 0; axis < 3; ++axis) {
    at[axis] = line_points(s.degree[axis]);
    s.bernstein[axis] = to_bernstein(s.degree[axis]);
  }
  const Eigen::Index points = at[0].size() * at[1].size() * at[2].size();
  for (Eigen::MatrixXd& gradient : s.gradients) gradient.resize(points, traits(type).nodes);
  Eigen::Index point = 0;
  for (double a : at[0])
    for (double b : at[1])
      for (double c : at[2]) {
        const CellShape shape = cell_shape(type, from_cube(type, {a, b, c}));
        for (int k = 0; k < 3; ++k) s.gradients[k].row(point) = shape.gradient.col(k).transpose();
        ++point;
      }
  return s;
}

const Sampling& sampling_of(CellType type) {
  static const std::array<Sampling, kCellTypes> all = [] {
    std::array<Sampling, kCellTypes> out;
    for (int t = 2; t < kCellTypes; ++t)
      if (const auto type = static_cast<CellType>(t); type != CellType::kHex8)
        out[t] = make_sampling(type);
    return out;
  }();
  return all[static_cast<size_t>(type)];
}

// Applies `matrix` along one axis.
void transform_axis(CubePolynomial& p, int axis, const Eigen::MatrixXd& matrix) {
  const int n = p.degree[axis] + 1;
  int stride = 1;
  for (int later = axis + 1; later < 3; ++later) stride *= p.degree[later] + 1;
  const Eigen::Index outer = p.coefficients.size() / (n * stride);
  const CubeValues old = p.coefficients;
  for (Eigen::Index o = 0; o < outer; ++o)
    for (int i = 0; i < n; ++i)
      for (int s = 0; s < stride; ++s) {
        double sum = 0.0;
        for (int k = 0; k < n; ++k) sum += matrix(i, k) * old((o * n + k) * stride + s);
        p.coefficients((o * n + i) * stride + s) = sum;
      }
}

// The derivatives of x along reference axis k at all points, one column for each of x, y, z.
using Tangents = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kMostCubePoints, 3>;
Tangents tangents(const Eigen::MatrixXd& gradient, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  Tangents t(gradient.rows(), 3);
  for (int d = 0; d < 3; ++d) {
    t.col(d) = x(0, d) * gradient.col(0);
    for (Eigen::Index i = 1; i < gradient.cols(); ++i) t.col(d) += x(i, d) * gradient.col(i);
  }
  return t;
}

// The tangents of a trilinear hexahedron are bilinear, its edges their Bernstein coefficients: det
// J is the sum of the triple products of edges, with B1_i B1_j = B2_{i+j} / C(2, i + j).
CubePolynomial of_edges(const Eigen::Ref<const Eigen::MatrixXd>& x) {
  const auto corner = [&](int i, int j, int k) -> Eigen::Vector3d {
    constexpr int kAround[2][2] = {{0, 3}, {1, 2}};
    return x.row(kAround[i][j] + 4 * k);
  };
  Eigen::Vector3d a[2][2], b[2][2], c[2][2];
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      a[i][j] = 0.5 * (corner(1, i, j) - corner(0, i, j));
      b[i][j] = 0.5 * (corner(i, 1, j) - corner(i, 0, j));
      c[i][j] = 0.5 * (corner(i, j, 1) - corner(i, j, 0));
    }
  CubePolynomial p{{2, 2, 2}, CubeValues::Zero(27)};
  for (int pair = 0; pair < 16; ++pair) {  // an edge along the second axis, one along the third
    const int ib = pair & 1, kb = pair >> 1 & 1, ic = pair >> 2 & 1, jc = pair >> 3;
    const Eigen::Vector3d normal = (ib == ic ? 1.0 : 0.5) * b[ib][kb].cross(c[ic][jc]);
    for (int ja = 0; ja < 2; ++ja)
      for (int ka = 0; ka < 2; ++ka)
        p.coefficients(p.index(ib + ic, ja + jc, ka + kb)) +=
            (ja == jc ? 1.0 : 0.5) * (ka == kb ? 1.0 : 0.5) * a[ja][ka].dot(normal);
  }
  return p;
}

}  // namespace

Eigen::Vector3d from_cube(CellType type, const Eigen::Vector3d& at) {
  const Eigen::Vector3d centred = 2.0 * at - Eigen::Vector3d::Ones();
  switch (traits(type).corners) {
    case 8:
      return centred;
    case 6:
      return {at(0) * (1.0 - at(1)), at(1), centred(2)};
    default:
      return {centred(0) * (1.0 - at(2)), centred(1) * (1.0 - at(2)), at(2)};
  }
}

CubePolynomial jacobian_polynomial(CellType type, const Eigen::Ref<const Eigen::MatrixXd>& x) {
  if (type == CellType::kHex8) return of_edges(x);
  const Sampling& s = sampling_of(type);
  const Tangents a = tangents(s.gradients[0], x), b = tangents(s.gradients[1], x),
                 c = tangents(s.gradients[2], x);
  CubePolynomial p{s.degree, CubeValues(a.rows())};
  const auto minor = [&](int i, int j) {
    return b.col(i).cwiseProduct(c.col(j)) - b.col(j).cwiseProduct(c.col(i));
  };
  p.coefficients = a.col(0).cwiseProduct(minor(1, 2)) + a.col(1).cwiseProduct(minor(2, 0)) +
                   a.col(2).cwiseProduct(minor(0, 1));
  for (int axis = 0; axis < 3; ++axis) transform_axis(p, axis, s.bernstein[axis]);
  return p;
}

double CubePolynomial::smallest_corner() const {
  double low = coefficients(0);
  for (int corner = 1; corner < 8; ++corner)
    low = std::min(low, coefficients(index((corner & 1) != 0 ? degree[0] : 0,
                                           (corner & 2) != 0 ? degree[1] : 0,
                                           (corner & 4) != 0 ? degree[2] : 0)));
  return low;
}

// de Casteljau's construction at 1/2, as a matrix: row k of the lower half is the k-th row of
// Pascal's triangle over 2^k; the upper half is its mirror image.
CubePolynomial CubePolynomial::half(int axis, bool upper) const {
  const int n = degree[axis];
  Eigen::MatrixXd cut = Eigen::MatrixXd::Zero(n + 1, n + 1);
  cut(0, 0) = 1.0;
  for (int k = 1; k <= n; ++k)
    for (int i = 0; i <= k; ++i)
      cut(k, i) = 0.5 * ((i < k ? cut(k - 1, i) : 0.0) + (i > 0 ? cut(k - 1, i - 1) : 0.0));
  CubePolynomial out = *this;
  transform_axis(out, axis, upper ? Eigen::MatrixXd(cut.reverse()) : cut);
  return out;
}

int CubePolynomial::steepest_axis() const {
  int best = 0;
  double steepest = -1.0;
  for (int axis = 0; axis < 3; ++axis) {
    double jump = 0.0;
    for (int i = 0; i <= degree[0]; ++i)
      for (int j = 0; j <= degree[1]; ++j)
        for (int k = 0; k <= degree[2]; ++k) {
          const std::array<int, 3> here = {i, j, k};
          if (here[axis] == degree[axis]) continue;
          const int next = index(i + (axis == 0), j + (axis == 1), k + (axis == 2));
          jump = std::max(jump, std::abs(coefficients(next) - coefficients(index(i, j, k))));
        }
    if (jump <= steepest) continue;
    steepest = jump;
    best = axis;
  }
  return best;
}

}  // namespace clatter::mesh
