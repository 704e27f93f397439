// SPDX-License-Identifier: GPL-3.0-or-later
#include "assembly/coupling/cluster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

namespace clatter::assembly {
namespace {

using Point = std::tuple<double, double, double>;

/// The groups as sets of points.
std::set<std::set<Point>> groups_of(const RowMatrix& coordinates, size_t limit) {
  std::vector<int32_t> nodes(static_cast<size_t>(coordinates.rows()));
  std::iota(nodes.begin(), nodes.end(), 0);
  std::set<std::set<Point>> found;
  for (const auto& group : cluster_nodes(coordinates, nodes, limit)) {
    std::set<Point> points;
    for (const int32_t n : group)
      points.emplace(coordinates(n, 0), coordinates(n, 1), coordinates(n, 2));
    found.insert(points);
  }
  return found;
}

TEST(Cluster, GroupsDoNotDependOnTheNumbersOfTheNodes) {
  // A grid: nine nodes share each coordinate.
  RowMatrix grid(81, 3);
  for (int n = 0; n < 81; ++n) grid.row(n) << n / 9, n % 9, 0.0;
  const auto expected = groups_of(grid, 12);
  EXPECT_EQ(expected.size(), 8U);  // 81 nodes halved three times: 10 or 11 in each
  std::vector<int> order(81);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937 random(1);
  for (int trial = 0; trial < 5; ++trial) {
    std::shuffle(order.begin(), order.end(), random);
    RowMatrix renumbered(81, 3);
    for (int n = 0; n < 81; ++n) renumbered.row(n) = grid.row(order[n]);
    EXPECT_EQ(groups_of(renumbered, 12), expected);
  }
}

}  // namespace
}  // namespace clatter::assembly
