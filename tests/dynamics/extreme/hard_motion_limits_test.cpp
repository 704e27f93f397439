// SPDX-License-Identifier: GPL-3.0-or-later
// Hard cases S10, S13 and S15: free motion, spans and bodies at their limits.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/dynamics/extreme/extreme_scene.hpp"

namespace clatter::dynamics {
namespace {

using testing::joint;
using testing::slider;
using testing::span;
using HardS10 = testing::ExtremeScenes;
using HardS13 = testing::ExtremeScenes;
using HardS15 = testing::ExtremeScenes;

std::string body_of(const std::string& motion, double mass) {
  const std::string inertia = motion == "space"   ? "inertia_kg_m2 = [1, 1, 1]\n"
                              : motion == "slide" ? "axis = [0, 0, 1]\n"
                                                  : "inertia_kg_m2 = 1\n";
  return fmt::format("[[rigid_body]]\nname = \"b\"\nmotion = \"{}\"\nmass_kg = {}\n{}", motion,
                     mass, inertia);
}

TEST_F(HardS10, FreeFallIsTheParabolaForAnyMassSpanAndTolerance) {
  double largest = 0.0;
  for (const char* motion : {"slide", "yz", "space"})
    for (const double mass : {1e-9, 1e9})
      for (const double tolerance : {1e-12, 1.0})
        for (const double end : {1e-8, 1.0, 1e4}) {
          // The last output step ends 0.3 of it before the span does.
          const H5File file = recorded(
              "gravity_m_s2 = 9.81\n" +
              span(end, tolerance,
                   fmt::format("output_step_us = {}\n", 1e6 * std::max(end / 3.3, 1e-11))) +
              body_of(motion, mass));
          EXPECT_EQ(last(file, "time"), end);
          const double z =
              motion == std::string("slide") ? last(file, "b_travel") : last(file, "b_z");
          // The start is a stage of 1e-6 of the first step, which no longer is exact.
          largest = std::max(largest, std::abs(z / (-0.5 * 9.81 * end * end) - 1.0));
          EXPECT_LT(result_.statistics.accepted, 200) << motion << " " << mass;
        }
  test::expect_at_most("largest relative error of 36 falls", largest, 1e-9);
}

// A chain of five masses, its tables in two orders: coordinates, elimination and sums differ.
TEST_F(HardS13, TheOrderOfTheTablesIsNoPhysics) {
  const auto ends = [&](const std::vector<int>& order) {
    std::string text = "gravity_m_s2 = 9.81\n" + span(0.05, 1e-5);
    for (const int i : order) text += slider(fmt::format("b{}", i), 0.1 * (i + 1), 0.2 * i);
    for (const int i : order)
      text +=
          joint(fmt::format("b{}", i), i == 0 ? "" : fmt::format("b{}", i - 1), 1e4 * (i + 1), 5.0);
    const H5File file = recorded(text);
    std::vector<double> travel;
    for (int i = 0; i < 5; ++i) travel.push_back(last(file, fmt::format("b{}_travel", i)));
    return travel;
  };
  const auto one = ends({0, 1, 2, 3, 4}), other = ends({3, 0, 4, 2, 1});
  double largest = 0.0;
  for (size_t i = 0; i < 5; ++i)
    largest = std::max(largest, std::abs(one[i] - other[i]) / std::abs(one[i]));
  test::expect_at_most("largest difference of a travel", largest, 1e-9);
}

// Moments of inertia 1, 1, 1e-9 kg m2 with a spin of 1e4 rad/s about the needle: its axis goes
// round the angular momentum at the rate |L| / I_1.
TEST_F(HardS15, ANeedlePrecessesAsTheoryGives) {
  const H5File file = recorded(
      span(1.0) +
      "[[rigid_body]]\nname = \"b\"\nmotion = \"space\"\nmass_kg = 1\ninertia_kg_m2 = [1, 1, "
      "1e-9]\nstart_spin_rad_s = [1, 1, 1e4]\n");
  const Eigen::Vector3d momentum(1.0, 1.0, 1e-5);
  const Eigen::AngleAxisd turn(momentum.norm() * last(file, "time"), momentum.normalized());
  const Eigen::Quaterniond attitude(last(file, "b_qw"), last(file, "b_qx"), last(file, "b_qy"),
                                    last(file, "b_qz"));
  const Eigen::Vector3d expected = turn * Eigen::Vector3d::UnitZ();
  test::expect_at_most("error of the needle's direction",
                       (attitude * Eigen::Vector3d::UnitZ() - expected).norm(), 1e-9);
}

}  // namespace
}  // namespace clatter::dynamics
