// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest gap between warm surfaces, by hand, and the clearance that follows from it.
#include "dynamics/film/warm_clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/film/piston_liner.hpp"
#include "tests/refusal.hpp"

namespace clatter::film {
namespace {

constexpr double kDeg = std::numbers::pi / 180.0;
// Half a sample along times the steepest slope below, and a sample's share of an order around.
constexpr double kSampling = 2e-8;  // [m]

/// A skirt from -40 to 20 mm from a pin that moves from 150 to 270 mm.
PistonLinerOptions flat_skirt() {
  PistonLinerOptions options;
  options.skirt_bottom = -40e-3;
  options.skirt_top = 20e-3;
  options.cells_around = options.cells_along = 4;
  return options;
}

constexpr WarmClearance kStroke{3e-6, 0.150, 0.270};

/// Radial deviations over heights, the same around.
LinerShape along(std::vector<double> height, std::vector<double> deviation) {
  const auto n = std::ssize(height);
  return {Eigen::VectorXd::Zero(1), Eigen::Map<Eigen::VectorXd>(height.data(), n),
          Eigen::Map<Eigen::RowVectorXd>(deviation.data(), n)};
}

/// amplitude cos(2 angle), at all heights.
LinerShape oval(double amplitude) {
  LinerShape shape{Eigen::VectorXd::LinSpaced(180, 0.0, 358.0 * kDeg), Eigen::VectorXd::Zero(1),
                   Eigen::MatrixXd(180, 1)};
  shape.deviation.col(0) = amplitude * (2.0 * shape.angle.array()).cos();
  return shape;
}

TEST(WarmClearance, AConeIsNarrowestWhereTheLowerEndOfTheSkirtReachesLowest) {
  PistonLinerOptions options = flat_skirt();
  options.bore = along({0.1, 0.3}, {0.0, 20e-6});  // 0.1 um a millimetre; 1 um at 110 mm
  const NearestPoint found = nearest_point(options, kStroke);
  EXPECT_NEAR(found.gap, 1e-6, 6e-8);  // half a millimetre above the end
  EXPECT_NEAR(found.pin, 0.150, 1e-12);
  EXPECT_NEAR(found.height, -39.5e-3, 1e-12);
}

TEST(WarmClearance, TheBarrelHasItsApexInTheNarrowestPartOfTheBore) {
  PistonLinerOptions options = flat_skirt();
  options.skirt.barrel_apex = -9.5e-3;
  options.skirt.barrel_top = 50e-6;
  options.skirt.barrel_bottom = 30e-6;
  options.skirt.ovality = 40e-6;
  options.bore = along({0.1, 0.2, 0.3}, {30e-6, -7e-6, 30e-6});
  const NearestPoint found = nearest_point(options, kStroke);
  EXPECT_NEAR(found.gap, -7e-6, 4e-7 * 0.5);  // half a millimetre of 0.37 um
  EXPECT_NEAR(found.height, -9.5e-3, 1e-12);
  EXPECT_NEAR(found.pin, 0.2095, 0.6e-3);
  EXPECT_NEAR(std::remainder(found.angle, std::numbers::pi), 0.0, 1e-12);
}

// Skirt 50 um + 10 um above, bore 20 um: the gap is 20 - 60 at the upper end.
TEST(WarmClearance, ShapesOfSkirtAndBoreHaveTheirSigns) {
  PistonLinerOptions options = flat_skirt();
  options.skirt_shapes = {along({0.0}, {50e-6}), along({0.0, 20e-3}, {0.0, 10e-6})};
  options.bore_shapes = {along({0.0}, {20e-6})};
  EXPECT_NEAR(nearest_point(options, kStroke).gap, -40e-6, 3e-7);
  EXPECT_NEAR(nearest_point(options, kStroke).height, 19.5e-3, 1e-12);
}

TEST(WarmClearance, AnOvalBoreIsNarrowestAtTheSidesOfThePads) {
  PistonLinerOptions options = flat_skirt();
  options.bore_shapes = {oval(10e-6)};
  const NearestPoint found = nearest_point(options, kStroke);
  // The last sample is half a spacing inside of 40 degrees.
  const double edge = 40.0 * kDeg * (1.0 - 1.0 / 41.0);
  EXPECT_NEAR(std::abs(std::remainder(found.angle, std::numbers::pi)), edge, 1e-9);
  EXPECT_NEAR(found.gap, 10e-6 * std::cos(2.0 * edge), kSampling);
}

TEST(WarmClearance, WhatIsOutsideOfTheLinerDoesNotCount) {
  PistonLinerOptions options = flat_skirt();
  options.bore = along({0.1, 0.3}, {0.0, 20e-6});
  options.ends = {0.130, 0.280};
  EXPECT_NEAR(nearest_point(options, kStroke).gap, 3e-6, 1.1e-7);  // at 130 mm
  options.ends = {0.4, 0.5};
  test::expect_parts(test::refusal_of([&] { nearest_point(options, kStroke); }),
                     {"minimum_warm_clearance_um", "400 to 500 mm", "expected one inside"});
}

// The smallest gap of the samples, with the clearance that follows, is the given one; the element
// has that clearance, also a negative one.
TEST(WarmClearance, OfTheElementLeavesTheGivenGap) {
  for (const double widening : {0.0, 12e-6}) {
    PistonLinerOptions options = flat_skirt();
    options.bore_shapes = {along({0.0}, {widening})};
    options.warm_clearance = kStroke;
    PistonLinerBodies bodies;
    bodies.stroke = [](double) { return StrokeState{0.2, 0.0}; };
    const PistonLiner element(options, bodies, {0, 1, 2, 3, 4, 5});
    EXPECT_NEAR(element.options().clearance, 3e-6 - widening, 1e-15);
  }
}

}  // namespace
}  // namespace clatter::film
