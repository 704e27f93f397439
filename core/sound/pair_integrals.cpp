// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/pair_integrals.hpp"

#include "core/sound/kernel_array.hpp"

namespace clatter::sound {
namespace {

// Distance of the centres over the sum of the radii from which a rule suffices: doubling either
// number changes the power of bodies by less than 2e-4, a hundredth of the error of the mesh.
constexpr double kThreePointsFrom = 2.5, kSixPointsFrom = 1.2;
// Four of each facet: gaps down to a tenth of the facets' size are resolved.
constexpr int kMaximumDivisions = 8;

/// The order of three corners with the shared ones first.
struct Alignment {
  Eigen::Matrix3d corners_x, corners_y;
  Eigen::Vector3i order_x, order_y;  // position k has corner order[k]
  int shared = 0;
};

Alignment align(const PreparedFacet& x, const PreparedFacet& y) {
  Alignment out;
  int rest_x = 2, rest_y = 2;
  bool of_y[3] = {false, false, false};
  for (int a = 0; a < 3; ++a) {
    int same = -1;
    for (int b = 0; b < 3; ++b)
      if (x.nodes[a] == y.nodes[b]) same = b;
    if (same < 0) {
      out.order_x[rest_x--] = a;
      continue;
    }
    out.order_x[out.shared] = a;
    out.order_y[out.shared++] = same;
    of_y[same] = true;
  }
  for (int b = 0; b < 3; ++b)
    if (!of_y[b]) out.order_y[rest_y--] = b;
  for (int a = 0; a < 3; ++a) {
    out.corners_x.col(a) = x.facet.corners.col(out.order_x[a]);
    out.corners_y.col(a) = y.facet.corners.col(out.order_y[a]);
  }
  return out;
}

/// Real and imaginary parts of the sums of PairIntegrals.
struct PairSums {
  Eigen::Matrix3d single_re = Eigen::Matrix3d::Zero(), single_im = single_re;
  Eigen::Matrix3d double_re = single_re, double_im = single_re;
  Eigen::Matrix3d adjoint_re = single_re, adjoint_im = single_re;
};

PairIntegrals touching(double k, const PreparedFacet& x, const PreparedFacet& y,
                       const Alignment& aligned) {
  constexpr int kAtOnce = 16;  // a factor of the number of points of each rule
  using Values = Eigen::Array<double, kAtOnce, 1>;
  const PairRule& rule = touching_rule(static_cast<Contact>(aligned.shared));
  const double areas = x.facet.area * y.facet.area;
  PairSums sums;  // with the corners in the order of the rule
  for (Eigen::Index first = 0; first < rule.weight.size(); first += kAtOnce) {
    Values r2, of_x, of_y;
    for (int i = 0; i < kAtOnce; ++i) {
      const Eigen::Vector3d d = aligned.corners_x * rule.shape_x.col(first + i) -
                                aligned.corners_y * rule.shape_y.col(first + i);
      r2[i] = d.squaredNorm();
      of_x[i] = -x.facet.normal.dot(d);
      of_y[i] = y.facet.normal.dot(d);
    }
    const KernelArray<kAtOnce> at = kernels<kAtOnce>(k, r2);
    for (int i = 0; i < kAtOnce; ++i) {
      const Eigen::Vector3d test = areas * rule.weight[first + i] * rule.shape_x.col(first + i);
      const Eigen::Matrix3d both = test * rule.shape_y.col(first + i).transpose();
      sums.single_re += at.g_re[i] * both;
      sums.single_im += at.g_im[i] * both;
      sums.double_re += at.slope_re[i] * of_y[i] * both;
      sums.double_im += at.slope_im[i] * of_y[i] * both;
      sums.adjoint_re += at.slope_re[i] * of_x[i] * both;
      sums.adjoint_im += at.slope_im[i] * of_x[i] * both;
    }
  }
  PairIntegrals out;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      const int row = aligned.order_x[a], column = aligned.order_y[b];
      out.single_layer(row, column) = {sums.single_re(a, b), sums.single_im(a, b)};
      out.double_layer(row, column) = {sums.double_re(a, b), sums.double_im(a, b)};
      out.adjoint(row, column) = {sums.adjoint_re(a, b), sums.adjoint_im(a, b)};
    }
  return out;
}

/// Adds the product rule of two facets with these points and shape functions.
template <int Points>
void add_product(double k, const Facet& x, const Facet& y,
                 const Eigen::Matrix<double, 3, Points>& at_x,
                 const Eigen::Matrix<double, 3, Points>& at_y,
                 const Eigen::Matrix<double, 3, Points>& test,
                 const Eigen::Matrix<double, 3, Points>& trial, PairIntegrals& sum) {
  constexpr int kPairs = Points * Points;
  using Values = Eigen::Array<double, kPairs, 1>;
  using Square = Eigen::Matrix<double, Points, Points>;  // (point of x, point of y)
  Values dx, dy, dz;
  for (int q = 0; q < Points; ++q)
    for (int p = 0; p < Points; ++p) {
      dx[p + Points * q] = at_x(0, p) - at_y(0, q);
      dy[p + Points * q] = at_x(1, p) - at_y(1, q);
      dz[p + Points * q] = at_x(2, p) - at_y(2, q);
    }
  const KernelArray<kPairs> at = kernels<kPairs>(k, dx * dx + dy * dy + dz * dz);
  const auto along = [&](const Eigen::Vector3d& n) -> Values {
    return n[0] * dx + n[1] * dy + n[2] * dz;
  };
  const auto integral = [&](const Values& values) -> Eigen::Matrix3d {
    const Eigen::Map<const Square> square(values.data());
    return test * (square * trial.transpose());
  };
  const Values of_y = along(y.normal), of_x = -along(x.normal);
  sum.single_layer.real() += integral(at.g_re);
  sum.single_layer.imag() += integral(at.g_im);
  sum.double_layer.real() += integral(at.slope_re * of_y);
  sum.double_layer.imag() += integral(at.slope_im * of_y);
  sum.adjoint.real() += integral(at.slope_re * of_x);
  sum.adjoint.imag() += integral(at.slope_im * of_x);
}

void add_six_points(double k, const Facet& x, const Facet& y, PairIntegrals& sum) {
  using Columns = Eigen::Matrix<double, 3, 6>;
  const TriangleRule& rule = six_points();
  const Columns at_x = x.corners * rule.shape, at_y = y.corners * rule.shape;
  const Columns test = x.area * (x.shape * rule.shape * rule.weight.asDiagonal());
  const Columns trial = y.area * (y.shape * rule.shape * rule.weight.asDiagonal());
  add_product<6>(k, x, y, at_x, at_y, test, trial, sum);
}

/// Divides the larger facet until the two are far from each other.
void add_divided(double k, const Facet& x, const Facet& y, int divisions, PairIntegrals& sum) {
  const double radius_x = x.radius(), radius_y = y.radius();
  const double distance = (x.centre() - y.centre()).norm();
  if (distance >= kSixPointsFrom * (radius_x + radius_y) || divisions == 0)
    return add_six_points(k, x, y, sum);
  for (int part = 0; part < 4; ++part)
    if (radius_x > radius_y)
      add_divided(k, x.quarter(part), y, divisions - 1, sum);
    else
      add_divided(k, x, y.quarter(part), divisions - 1, sum);
}

}  // namespace

PairIntegrals pair_integrals(double k, const PreparedFacet& x, const PreparedFacet& y,
                             bool same_surface) {
  PairIntegrals sum;
  const double ratio = (x.centre - y.centre).norm() / (x.radius + y.radius);
  if (ratio >= kThreePointsFrom) {
    const Eigen::Matrix3d& shape = three_points().shape;
    add_product<3>(k, x.facet, y.facet, x.points, y.points, x.facet.area / 3.0 * shape,
                   y.facet.area / 3.0 * shape, sum);
    return sum;
  }
  if (same_surface) {
    const Alignment aligned = align(x, y);
    if (aligned.shared > 0) return touching(k, x, y, aligned);
  }
  add_divided(k, x.facet, y.facet, kMaximumDivisions, sum);
  return sum;
}

}  // namespace clatter::sound
