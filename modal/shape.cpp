// SPDX-License-Identifier: GPL-3.0-or-later
#include "modal/shape.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "core/base/error.hpp"
#include "core/dense/least_squares.hpp"

namespace clatter::modal {
namespace {

constexpr double kRound = 0.1;  // largest deviation of a node from the mean radius, of the radius
constexpr double kFlatRing = 1e-3;  // of the radius: lower ones are no cylinder
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Linear in the angle between the covered points, around the circle.
void fill_gaps(const Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic>& covered,
               Eigen::MatrixXd& deviation) {
  const Eigen::Index n = deviation.cols();
  for (Eigen::Index i = 0; i < deviation.rows(); ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      if (covered(i, j)) continue;
      Eigen::Index before = 1, after = 1;
      while (!covered(i, (j - before + n) % n)) ++before;
      while (!covered(i, (j + after) % n)) ++after;
      const double share = static_cast<double>(before) / static_cast<double>(before + after);
      deviation(i, j) = (1.0 - share) * deviation(i, (j - before + n) % n) +
                        share * deviation(i, (j + after) % n);
    }
}

/// Translation and tilt, with the mean of each height as further unknowns: a uniform widening of a
/// surface that covers only part of the circle is no translation.
Eigen::Vector4d rigid_of(const Shape& shape, const Eigen::MatrixXd& deviation) {
  const Eigen::Index rows = shape.height.size();
  const Eigen::Index points = shape.covered.sum();
  // Heights about their middle, so that both unknowns of a direction are of similar size.
  const double middle = shape.height.mean();
  const double size =
      std::max(shape.height(rows - 1) - shape.height(0), 1e-3 * shape.extent.radius);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(points, 4 + rows);
  Eigen::VectorXd b(points);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < shape.angle.size(); ++j) {
      if (!shape.covered(i, j)) continue;
      const double c = std::cos(shape.angle(j)), s = std::sin(shape.angle(j));
      const double h = (shape.height(i) - middle) / size;
      A.row(k).head<4>() << c, s, h * c, h * s;
      A(k, 4 + i) = 1.0;
      b(k++) = deviation(i, j);
    }
  Eigen::Vector4d found = dense::least_squares(A, b).X.topRows<4>();
  found.tail<2>() /= size;
  found.head<2>() -= middle * found.tail<2>();
  return found;
}

void subtract(const Shape& shape, const Eigen::Vector4d& rigid, Eigen::MatrixXd& deviation) {
  for (Eigen::Index i = 0; i < deviation.rows(); ++i)
    for (Eigen::Index j = 0; j < deviation.cols(); ++j)
      deviation(i, j) -= (rigid(0) + shape.height(i) * rigid(2)) * std::cos(shape.angle(j)) +
                         (rigid(1) + shape.height(i) * rigid(3)) * std::sin(shape.angle(j));
}

void add_orders(const Shape& shape, int orders, ShapeCase& out) {
  const Eigen::Index n = shape.angle.size();
  out.order_re.resize(shape.height.size(), orders + 1);
  out.order_im.resize(shape.height.size(), orders + 1);
  for (int m = 0; m <= orders; ++m) {
    const double scale = (m == 0 ? 1.0 : 2.0) / static_cast<double>(n);
    const Eigen::ArrayXd phase = static_cast<double>(m) * shape.angle.array();
    out.order_re.col(m) = scale * out.deviation * phase.cos().matrix();
    out.order_im.col(m) = -scale * out.deviation * phase.sin().matrix();
  }
}

/// The largest amplitude of each order over the heights [m].
Eigen::RowVectorXd largest_orders(const ShapeCase& one) {
  return (one.order_re.array().square() + one.order_im.array().square())
      .sqrt()
      .colwise()
      .maxCoeff();
}

Eigen::VectorXd heights_of(const CylinderExtent& extent, const ShapeOptions& options,
                           const std::string& where) {
  const auto [low, high] = options.range.value_or(std::pair{extent.low, extent.high});
  // The surface's own ends, as they are printed.
  const double slack = 1e-6 * (extent.high - extent.low);
  if (low < extent.low - slack || high > extent.high + slack || !(low < high))
    throw InputError(
        fmt::format("{}: --range: found {:.6g} to {:.6g} m, expected ascending heights "
                    "from {:.6g} to {:.6g} m",
                    where, low, high, extent.low, extent.high));
  return Eigen::VectorXd::LinSpaced(options.heights, std::max(low, extent.low),
                                    std::min(high, extent.high));
}

void check_options(const ShapeOptions& options) {
  const auto require = [](const char* flag, int found, int least) {
    if (found < least || found > 10000)
      throw InputError(
          fmt::format("command line: {}: found {}, expected {} to 10000", flag, found, least));
  };
  require("--heights", options.heights, 2);
  require("--angles", options.angles, 4);
  require("--orders", options.orders, 0);
  if (2 * options.orders >= options.angles)
    throw InputError(
        fmt::format("command line: --orders: found {}, expected less than half of the "
                    "{} angles",
                    options.orders, options.angles));
}

}  // namespace

Shape shape_of(const RowMatrix& nodes, const mesh::Surface& surface,
               const std::vector<Eigen::VectorXd>& displacement, const ShapeOptions& options,
               const std::string& where) {
  check_options(options);
  Shape shape;
  shape.surface = options.surface;
  shape.axes = options.axes.value();
  shape.extent = extent_of(nodes, surface, shape.axes);
  shape.rigid_kept = options.keep_rigid;
  if (!(shape.extent.spread <= kRound * shape.extent.radius &&
        shape.extent.high - shape.extent.low > kFlatRing * shape.extent.radius))
    throw InputError(
        fmt::format("{}: found nodes {:.3g} to {:.3g} m from the axis, expected a "
                    "cylinder about it",
                    where, shape.extent.radius - shape.extent.spread,
                    shape.extent.radius + shape.extent.spread));
  shape.height = heights_of(shape.extent, options, where);
  const Eigen::Index n = options.angles;
  shape.angle = Eigen::VectorXd::LinSpaced(
      n, 0.0, kTurn * static_cast<double>(n - 1) / static_cast<double>(n));
  const CylinderPoints points = points_on(nodes, surface, shape.axes, shape.height, shape.angle);
  shape.covered.resize(shape.height.size(), n);
  for (Eigen::Index i = 0; i < shape.height.size(); ++i) {
    for (Eigen::Index j = 0; j < n; ++j) shape.covered(i, j) = points.covered[i * n + j] ? 1 : 0;
    if (shape.covered.row(i).sum() == 0)
      throw InputError(
          fmt::format("{}: found no face at height {:.6g} m, expected some; choose "
                      "--range within the surface",
                      where, shape.height(i)));
  }
  for (size_t c = 0; c < displacement.size(); ++c) {
    ShapeCase one;
    one.name = options.cases[c];
    const Eigen::VectorXd radial = points.radial * displacement[c];
    one.deviation = Eigen::Map<const RowMatrix>(radial.data(), shape.height.size(), n);
    one.rigid = rigid_of(shape, one.deviation);
    if (!options.keep_rigid) subtract(shape, one.rigid, one.deviation);
    fill_gaps(shape.covered, one.deviation);
    add_orders(shape, options.orders, one);
    shape.cases.push_back(std::move(one));
  }
  return shape;
}

JsonMembers json_of(const Shape& shape) {
  std::vector<std::string> cases;
  for (const ShapeCase& one : shape.cases) {
    std::vector<std::string> orders;
    for (const double size : largest_orders(one)) orders.push_back(json_number(size));
    cases.push_back(
        fmt::format("{{\"name\": {}, \"smallest_m\": {}, \"largest_m\": {}, \"orders_m\": [{}]}}",
                    json_text(one.name), json_number(one.deviation.minCoeff()),
                    json_number(one.deviation.maxCoeff()), fmt::join(orders, ", ")));
  }
  return {{"surface", json_text(shape.surface)},
          {"radius_m", json_number(shape.extent.radius)},
          {"covered", json_number(shape.covered.cast<double>().mean())},
          {"cases", fmt::format("[{}]", fmt::join(cases, ", "))}};
}

std::vector<std::string> describe(const Shape& shape) {
  const double covered = shape.covered.cast<double>().mean();
  std::vector<std::string> lines = {fmt::format(
      "{} {}: {} heights from {:.1f} to {:.1f} mm, {} angles, radius {:.3f} mm, {:.0f} % of the "
      "points on faces; {}",
      shape.name, shape.surface, shape.height.size(), 1e3 * shape.height(0),
      1e3 * shape.height(shape.height.size() - 1), shape.angle.size(), 1e3 * shape.extent.radius,
      100.0 * covered,
      shape.rigid_kept ? "translation and tilt kept" : "translation and tilt removed")};
  for (const ShapeCase& one : shape.cases) {
    std::string orders;
    const Eigen::RowVectorXd largest = largest_orders(one);
    for (Eigen::Index m = 2; m < std::min<Eigen::Index>(5, largest.size()); ++m)
      orders += fmt::format(", order {} up to {:.2f}", m, 1e6 * largest(m));
    lines.push_back(fmt::format(
        "{}: deviation {:.2f} to {:.2f} um, mean of a height {:.2f} to "
        "{:.2f}{} um",
        one.name, 1e6 * one.deviation.minCoeff(), 1e6 * one.deviation.maxCoeff(),
        1e6 * one.order_re.col(0).minCoeff(), 1e6 * one.order_re.col(0).maxCoeff(), orders));
  }
  return lines;
}

}  // namespace clatter::modal
