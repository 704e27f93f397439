// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/recipe/temperature_table.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <numeric>
#include <vector>

#include "assembly/recipe/profile.hpp"
#include "core/base/text_lines.hpp"
#include "core/base/threads.hpp"

namespace clatter::assembly {
namespace {

constexpr Eigen::Index kNeighbours = 8;  // twice the coefficients of a linear function
constexpr double kOnPoint = 1e-9;        // of the distance to the farthest neighbour
constexpr double kFlat = 1e-6;           // least singular value, relative: below, points are in one
                                         // plane, line or position

/// The value at `x` of the linear fit to the points in `near`, ascending by distance.
double fit_at(const TemperatureTable& table, const std::vector<Eigen::Index>& near,
              const Eigen::RowVector3d& x) {
  const auto m = static_cast<Eigen::Index>(near.size());
  const double reach = (table.points.row(near.back()) - x).norm();
  if (!((table.points.row(near[0]) - x).norm() > kOnPoint * reach))
    return table.temperature(near[0]);
  // About the weighted mean the constant and the slopes separate.
  Eigen::VectorXd weight(m);
  Eigen::RowVector3d centre = Eigen::RowVector3d::Zero();
  double mean = 0.0;
  for (Eigen::Index k = 0; k < m; ++k) {
    const Eigen::Index point = near[static_cast<size_t>(k)];
    weight(k) = 1.0 / (table.points.row(point) - x).squaredNorm();
    centre += weight(k) * table.points.row(point);
    mean += weight(k) * table.temperature(point);
  }
  centre /= weight.sum();
  mean /= weight.sum();
  Eigen::MatrixXd A(m, 3);
  Eigen::VectorXd b(m);
  for (Eigen::Index k = 0; k < m; ++k) {
    const Eigen::Index point = near[static_cast<size_t>(k)];
    const double root = std::sqrt(weight(k));
    A.row(k) = root * (table.points.row(point) - centre);
    b(k) = root * (table.temperature(point) - mean);
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> fit;
  fit.setThreshold(kFlat);
  fit.compute(A);
  return mean + (x - centre).dot(fit.solve(b).transpose());
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

Eigen::VectorXd temperatures_at(const TemperatureTable& table, const RowMatrix& nodes) {
  const Eigen::Index m = std::min(kNeighbours, table.points.rows());
  Eigen::VectorXd out(nodes.rows());
  parallel_pieces(nodes.rows(), [&](int64_t begin, int64_t end) {
    std::vector<Eigen::Index> near(static_cast<size_t>(table.points.rows()));
    for (Eigen::Index a = begin; a < end; ++a) {
      const Eigen::RowVector3d x = nodes.row(a);
      const Eigen::VectorXd distance = (table.points.rowwise() - x).rowwise().squaredNorm();
      near.resize(static_cast<size_t>(table.points.rows()));
      std::iota(near.begin(), near.end(), 0);
      std::partial_sort(near.begin(), near.begin() + m, near.end(),
                        [&](Eigen::Index i, Eigen::Index j) {
                          return distance(i) < distance(j) || (distance(i) == distance(j) && i < j);
                        });
      near.resize(static_cast<size_t>(m));
      out(a) = fit_at(table, near, x);
    }
  });
  return out;
}

}  // namespace clatter::assembly
