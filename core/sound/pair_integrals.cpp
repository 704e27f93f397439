// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sound/pair_integrals.hpp"

#include "core/sound/kernel.hpp"

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

PairIntegrals touching(double k, const PreparedFacet& x, const PreparedFacet& y,
                       const Alignment& aligned) {
  const PairRule& rule = touching_rule(static_cast<Contact>(aligned.shared));
  PairIntegrals sum;
  for (Eigen::Index p = 0; p < rule.weight.size(); ++p) {
    const Eigen::Vector3d shape_x = rule.shape_x.col(p), shape_y = rule.shape_y.col(p);
    const Eigen::Vector3d d = aligned.corners_x * shape_x - aligned.corners_y * shape_y;
    const Kernel at = kernel(k, d.norm());
    const Eigen::Vector3d test = rule.weight[p] * shape_x;
    const Complex of_y = at.slope * y.facet.normal.dot(d);
    const Complex of_x = -at.slope * x.facet.normal.dot(d);
    for (int b = 0; b < 3; ++b) {
      const Complex g = at.g * shape_y[b], by_y = of_y * shape_y[b], by_x = of_x * shape_y[b];
      const int column = aligned.order_y[b];
      for (int a = 0; a < 3; ++a) {
        const int row = aligned.order_x[a];
        sum.single_layer(row, column) += test[a] * g;
        sum.double_layer(row, column) += test[a] * by_y;
        sum.adjoint(row, column) += test[a] * by_x;
      }
    }
  }
  const double areas = x.facet.area * y.facet.area;
  sum.single_layer *= areas;
  sum.double_layer *= areas;
  sum.adjoint *= areas;
  return sum;
}

/// Adds the product rule of two facets with these points and shape functions.
template <int Points>
void add_product(double k, const Facet& x, const Facet& y,
                 const Eigen::Matrix<double, 3, Points>& at_x,
                 const Eigen::Matrix<double, 3, Points>& at_y,
                 const Eigen::Matrix<double, 3, Points>& test,
                 const Eigen::Matrix<double, 3, Points>& trial, PairIntegrals& sum) {
  for (int p = 0; p < Points; ++p) {
    Eigen::RowVector3cd single_row = Eigen::RowVector3cd::Zero(), double_row = single_row,
                        adjoint_row = single_row;
    for (int q = 0; q < Points; ++q) {
      const Eigen::Vector3d d = at_x.col(p) - at_y.col(q);
      const Kernel at = kernel(k, d.norm());
      single_row += at.g * trial.col(q).transpose();
      double_row += at.slope * y.normal.dot(d) * trial.col(q).transpose();
      adjoint_row -= at.slope * x.normal.dot(d) * trial.col(q).transpose();
    }
    sum.single_layer.noalias() += test.col(p) * single_row;
    sum.double_layer.noalias() += test.col(p) * double_row;
    sum.adjoint.noalias() += test.col(p) * adjoint_row;
  }
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
