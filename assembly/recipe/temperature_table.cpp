// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/temperature_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "assembly/recipe/profile.hpp"
#include "core/base/text_lines.hpp"
#include "core/base/threads.hpp"
#include "core/dense/least_squares.hpp"
#include "core/dense/symmetric_eigen.hpp"

namespace clatter::assembly {
namespace {

constexpr Eigen::Index kNeighbours = 8;  // twice the coefficients of a linear function
constexpr double kOnPoint = 1e-9;        // of the distance to the farthest neighbour
constexpr double kFlat = 1e-6;           // least singular value, relative
constexpr double kBeyond = 3.0;  // a fit is used up to three times as far as its points reach

using Neighbours = std::vector<Eigen::Index>;

/// Points of the table by their distance from a node.
class ByDistance {
 public:
  ByDistance(const TemperatureTable& table, const Eigen::RowVector3d& x)
      : distance_((table.points.rowwise() - x).rowwise().squaredNorm()),
        all_(static_cast<size_t>(table.points.rows())) {
    std::iota(all_.begin(), all_.end(), 0);
  }
  Eigen::Index count() const { return distance_.size(); }
  /// The nearest `count`, ascending.
  Neighbours nearest(Eigen::Index count) {
    std::partial_sort(
        all_.begin(), all_.begin() + count, all_.end(), [&](Eigen::Index i, Eigen::Index j) {
          return distance_(i) < distance_(j) || (distance_(i) == distance_(j) && i < j);
        });
    return {all_.begin(), all_.begin() + count};
  }

 private:
  Eigen::VectorXd distance_;
  Neighbours all_;
};

/// Farthest that points lie from `centre` along `direction`, to either side.
double reach_along(const RowMatrix& points, const Eigen::RowVector3d& centre,
                   const Eigen::Vector3d& direction) {
  return ((points.rowwise() - centre) * direction).cwiseAbs().maxCoeff();
}

/// Points that a node's value is fitted to, and the directions along which the fit varies.
struct Support {
  Neighbours near;
  Eigen::Matrix3Xd directions;
};

/// The nearest points, more where the node lies farther across them than they reach, as off a plane
/// that holds them all. A direction in which not even the entire table reaches is left out.
Support support_at(const TemperatureTable& table, const Eigen::RowVector3d& x) {
  ByDistance order(table, x);
  for (Eigen::Index count = std::min(kNeighbours, order.count());;
       count = std::min(2 * count, order.count())) {
    Support found{order.nearest(count), {3, 0}};
    const RowMatrix points = table.points(found.near, Eigen::all);
    const Eigen::RowVector3d centre = points.colwise().mean();
    const RowMatrix from_centre = points.rowwise() - centre;
    const Eigen::Matrix3d axes =
        dense::symmetric_eigen(from_centre.transpose() * from_centre).vectors;
    bool more = false;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = axes.col(axis);
      const double needed = std::abs((x - centre) * direction) / kBeyond;
      if (needed <= reach_along(points, centre, direction)) {
        found.directions.conservativeResize(3, found.directions.cols() + 1);
        found.directions.rightCols<1>() = direction;
      } else {
        more = more || needed <= reach_along(table.points, centre, direction);
      }
    }
    if (!more || count == order.count()) return found;
  }
}

struct Value {
  double temperature, residual;
};

/// The value at `x` of the linear fit, and the weighted root mean square of what it leaves.
Value fit_at(const TemperatureTable& table, const Support& support, const Eigen::RowVector3d& x) {
  const Neighbours& near = support.near;
  const double reach = (table.points.row(near.back()) - x).norm();
  if (!((table.points.row(near[0]) - x).norm() > kOnPoint * reach))
    return {table.temperature(near[0]), 0.0};
  const RowMatrix points = table.points(near, Eigen::all);
  const Eigen::VectorXd values = table.temperature(near);
  Eigen::VectorXd weight = (points.rowwise() - x).rowwise().squaredNorm().cwiseInverse();
  weight /= weight.sum();
  // About the weighted mean the constant and the slopes separate.
  const Eigen::RowVector3d centre = weight.transpose() * points;
  const double mean = weight.dot(values);
  const Eigen::VectorXd root = weight.cwiseSqrt();
  const Eigen::MatrixXd A = root.asDiagonal() * (points.rowwise() - centre) * support.directions;
  const Eigen::VectorXd b = root.cwiseProduct((values.array() - mean).matrix());
  if (A.cols() == 0) return {mean, b.norm()};
  const Eigen::VectorXd slope = dense::least_squares(A, b, kFlat).X;
  return {mean + ((x - centre) * support.directions).dot(slope.transpose()),
          (A * slope - b).norm()};
}

}  // namespace

TemperatureTable read_temperature_table(const std::filesystem::path& path, double metre) {
  constexpr std::string_view kHeader = "x,y,z,temperature_c";
  TextLines lines(path);
  std::string_view line;
  const bool any = lines.next(line);
  if (!any || line != kHeader)
    lines.refuse(any ? fmt::format("\"{}\"", line.substr(0, 60)) : "an empty file",
                 fmt::format("the header \"{}\"", kHeader));
  std::vector<double> values;
  while (lines.next(line)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    if (words.size() != 4) lines.refuse(fmt::format("{} numbers", words.size()), "4");
    for (const std::string_view word : words) values.push_back(lines.real(word));
    if (values.back() < -kZeroCelsius)
      lines.refuse(fmt::format("{:g} degrees Celsius", values.back()),
                   fmt::format("at least {:g}", -kZeroCelsius));
  }
  if (values.empty()) lines.refuse("no point", "at least one");
  const Eigen::Map<const RowMatrix> all(values.data(), static_cast<Eigen::Index>(values.size() / 4),
                                        4);
  return {metre * all.leftCols(3), all.col(3).array() + kZeroCelsius};
}

TableValues temperatures_at(const TemperatureTable& table, const RowMatrix& nodes) {
  TableValues out{Eigen::VectorXd(nodes.rows()), 0.0, 0.0};
  Eigen::VectorXd distance(nodes.rows()), residual(nodes.rows());
  parallel_pieces(nodes.rows(), [&](int64_t begin, int64_t end) {
    for (Eigen::Index a = begin; a < end; ++a) {
      const Eigen::RowVector3d x = nodes.row(a);
      const Support support = support_at(table, x);
      const Value value = fit_at(table, support, x);
      out.temperature(a) = value.temperature;
      residual(a) = value.residual;
      distance(a) = (table.points.row(support.near[0]) - x).norm();
    }
  });
  if (nodes.rows() == 0) return out;
  out.farthest = distance.maxCoeff();
  out.residual = residual.maxCoeff();
  return out;
}

}  // namespace clatter::assembly
