// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

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
  ByDistance(const PointTable& table, const Eigen::RowVector3d& x)
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
Support support_at(const PointTable& table, const Eigen::RowVector3d& x) {
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

struct Fitted {
  Eigen::RowVectorXd values, residuals;
};

/// The values at `x` of the linear fits, and the weighted root mean squares of what they leave.
Fitted fit_at(const PointTable& table, const Support& support, const Eigen::RowVector3d& x) {
  const Neighbours& near = support.near;
  const double reach = (table.points.row(near.back()) - x).norm();
  if (!((table.points.row(near[0]) - x).norm() > kOnPoint * reach))
    return {table.values.row(near[0]), Eigen::RowVectorXd::Zero(table.values.cols())};
  const RowMatrix points = table.points(near, Eigen::all);
  const Eigen::MatrixXd values = table.values(near, Eigen::all);
  Eigen::VectorXd weight = (points.rowwise() - x).rowwise().squaredNorm().cwiseInverse();
  weight /= weight.sum();
  // About the weighted mean the constant and the slopes separate.
  const Eigen::RowVector3d centre = weight.transpose() * points;
  const Eigen::RowVectorXd mean = weight.transpose() * values;
  const Eigen::VectorXd root = weight.cwiseSqrt();
  const Eigen::MatrixXd A = root.asDiagonal() * (points.rowwise() - centre) * support.directions;
  const Eigen::MatrixXd b = root.asDiagonal() * (values.rowwise() - mean);
  if (A.cols() == 0) return {mean, b.colwise().norm()};
  const Eigen::MatrixXd slope = dense::least_squares(A, b, kFlat).X;
  return {mean + (x - centre) * support.directions * slope, (A * slope - b).colwise().norm()};
}

void require_in_range(const TextLines& lines, const TableColumn& column, double value) {
  if (value > column.least || (!column.above && value == column.least)) return;
  lines.refuse(fmt::format("{:g} {}", value, column.unit),
               fmt::format("{} {:g}", column.above ? "above" : "at least", column.least));
}

}  // namespace

PointTable read_point_table(const std::filesystem::path& path, double metre,
                            const std::vector<TableColumn>& columns) {
  std::string header = "x,y,z";
  for (const TableColumn& column : columns) header += "," + column.name;
  const size_t width = 3 + columns.size();
  TextLines lines(path);
  std::string_view line;
  const bool any = lines.next(line);
  if (!any || line != header)
    lines.refuse(any ? fmt::format("\"{}\"", line.substr(0, 60)) : "an empty file",
                 fmt::format("the header \"{}\"", header));
  std::vector<double> numbers;
  while (lines.next(line)) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    if (words.size() != width)
      lines.refuse(fmt::format("{} numbers", words.size()), fmt::format("{}", width));
    for (size_t k = 0; k < width; ++k) {
      numbers.push_back(lines.real(words[k]));
      if (k >= 3) require_in_range(lines, columns[k - 3], numbers.back());
    }
  }
  if (numbers.empty()) lines.refuse("no point", "at least one");
  const Eigen::Map<const RowMatrix> all(numbers.data(),
                                        static_cast<Eigen::Index>(numbers.size() / width),
                                        static_cast<Eigen::Index>(width));
  return {metre * all.leftCols(3), all.rightCols(all.cols() - 3)};
}

TableValues values_at(const PointTable& table, const RowMatrix& nodes) {
  const Eigen::Index quantities = table.values.cols();
  TableValues out{RowMatrix(nodes.rows(), quantities), 0.0, Eigen::RowVectorXd::Zero(quantities)};
  Eigen::VectorXd distance(nodes.rows());
  RowMatrix residuals(nodes.rows(), quantities);
  parallel_pieces(nodes.rows(), [&](int64_t begin, int64_t end) {
    for (Eigen::Index a = begin; a < end; ++a) {
      const Eigen::RowVector3d x = nodes.row(a);
      const Support support = support_at(table, x);
      const Fitted fitted = fit_at(table, support, x);
      out.values.row(a) = fitted.values;
      residuals.row(a) = fitted.residuals;
      distance(a) = (table.points.row(support.near[0]) - x).norm();
    }
  });
  if (nodes.rows() == 0) return out;
  out.farthest = distance.maxCoeff();
  out.residuals = residuals.colwise().maxCoeff();
  return out;
}

}  // namespace clatter::assembly
