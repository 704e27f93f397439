// SPDX-License-Identifier: GPL-3.0-or-later
// Planar profiles: points, arc length, closest points, splines.
#include <gtest/gtest.h>

#include <limits>

#include "tests/dynamics/profile/profile_cases.hpp"

namespace clatter::dynamics {
namespace {

using Eigen::Vector2d;
using testing::kPi;

/// Line, arc, Bezier curve and spline, C1, the solid below.
Profile mixed() {
  const double r = 5e-3;
  const BezierSegment bezier{
      {Vector2d(0.01 - r, r), {0.01 - r - 4e-3, r}, {-4e-3, 8e-3}, {-8e-3, 8e-3}}};
  PointsSegment spline{{{-8e-3, 8e-3}, {-12e-3, 7.5e-3}, {-15e-3, 6e-3}, {-18e-3, 2e-3}},
                       false,
                       Vector2d(-1.0, 0.0),
                       {}};
  return Profile({LineSegment{{0.01, -8e-3}, {0.01, 0.0}},
                  ArcSegment{{0.01 - r, 0.0}, r, 0.0, 0.5 * kPi}, bezier, spline});
}

/// Smallest distance to points of the profile close to each other: slow and obviously right.
double distance_by_points(const Profile& profile, const Vector2d& point, double from, double to) {
  constexpr int kPoints = 40000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kPoints; ++i)
    least = std::min(least, (profile.at(from + (to - from) * i / kPoints).position - point).norm());
  return least;
}

TEST(Profile, ArcLengthIsTheLengthOfTheCurve) {
  const Profile profile = mixed();
  const double step = profile.length() / 20000;
  double sum = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double chord =
        (profile.at(step * (i + 1)).position - profile.at(step * i).position).norm();
    EXPECT_NEAR(chord, step, 1e-6 * step);  // chords of 2 um on radii above 0.5 mm: (2e-3/0.5)^2/24
    sum += chord;
  }
  EXPECT_NEAR(sum, profile.length(), 1e-7 * profile.length());
}

TEST(Profile, TangentNormalAndCurvatureAreDerivativesOfThePosition) {
  const Profile profile = mixed();
  const double h = 1e-6;
  for (const double s : {4e-3, 0.012, 0.0173, 0.0201, 0.026, 0.0317, 0.036}) {
    const ProfilePoint at = profile.at(s), low = profile.at(s - h), high = profile.at(s + h);
    const Vector2d tangent = (high.position - low.position) / (2.0 * h);
    EXPECT_LT((tangent - at.tangent).norm(), 1e-6);  // h^2 over the radius squared
    EXPECT_LT(std::abs(at.normal.dot(at.tangent)), 1e-15);
    EXPECT_GT(at.normal.y() + at.normal.x(), -1.0);
    const double curvature = (high.normal - low.normal).dot(at.tangent) / (2.0 * h);
    EXPECT_NEAR(at.curvature, curvature, 1e-3 * (1.0 + std::abs(curvature)));
  }
  EXPECT_GT(profile.at(4e-3).normal.x(),
            0.999);  // right of the first line, whose solid is on the left
}

TEST(Profile, ClosestPointsAreThoseOfADensePolygon) {
  for (const Profile& profile : {mixed(), testing::crank_sprocket(), testing::guide(),
                                 Profile({testing::ellipse(0.03, 0.02, 40)}, {.closed = true})}) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> along(0.0, profile.length()), off(-2e-3, 2e-3);
    for (int i = 0; i < 20; ++i) {
      const double s = along(random);
      const ProfilePoint at = profile.at(s);
      const Vector2d point = at.position + off(random) * at.normal + off(random) * at.tangent;
      const ClosestPoint closest = profile.closest(point);
      const double slow = distance_by_points(profile, point, 0.0, profile.length());
      const double step = profile.length() / 40000;
      EXPECT_LE(std::abs(closest.distance), slow + 1e-15);
      EXPECT_GE(std::abs(closest.distance), slow - step);
      EXPECT_LT((profile.at(closest.arc_length).position - closest.point.position).norm(), 1e-14);
    }
  }
}

TEST(Profile, ClosestPointNearAHintIsTheGlobalOneWhereThatIsInTheWindow) {
  for (const Profile& profile : {testing::crank_sprocket(), testing::guide(),
                                 Profile({testing::ellipse(0.03, 0.02, 40)}, {.closed = true})}) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> along(0.0, profile.length()), off(-1e-4, 1e-4);
    for (int i = 0; i < 200; ++i) {
      const double s = along(random);
      const ProfilePoint at = profile.at(s);
      const Vector2d point = at.position + off(random) * at.normal;
      const ClosestPoint global = profile.closest(point);
      const ClosestPoint local = profile.closest(point, s + off(random), 1e-3);
      // Slopes of the distance are rounded to 1e-17 m.
      EXPECT_NEAR(local.arc_length, global.arc_length, 1e-14);
      EXPECT_NEAR(local.distance, global.distance, 1e-17);
    }
  }
}

TEST(Profile, TheWindowLimitsTheClosestPoint) {
  const Profile profile = testing::flat();
  const ClosestPoint closest =
      profile.closest({0.0, 1e-3}, 5e-3, 2e-3);  // the line runs to -x from 20 mm
  EXPECT_NEAR(closest.arc_length, 7e-3, 1e-15);
  EXPECT_NEAR(closest.distance, std::hypot(13e-3, 1e-3), 1e-15);
  EXPECT_NEAR(profile.closest({0.0, -1e-3}).distance, -1e-3, 1e-15);
  const Profile wheel = testing::crank_sprocket();  // a window over the seam, from either side
  const ProfilePoint seam = wheel.at(0.0);
  EXPECT_NEAR(wheel.closest(seam.position, wheel.length() - 1e-4, 5e-4).distance, 0.0, 1e-15);
  EXPECT_NEAR(wheel.closest(seam.position, -1e-4, 5e-4).distance, 0.0, 1e-15);
}

TEST(Profile, TheSolidOnTheRightHasTheOppositeNormal) {
  const std::vector<Segment> line{LineSegment{{0.0, 0.0}, {0.01, 0.0}}};
  EXPECT_EQ(Profile(line).at(1e-3).normal, Vector2d(0.0, -1.0));
  const Profile right(line, {.solid = ProfileOptions::Solid::kRight});
  EXPECT_EQ(right.at(1e-3).normal, Vector2d(0.0, 1.0));
  const Profile hole({ArcSegment{{0.0, 0.0}, 0.01, 0.0, 2.0 * kPi}},
                     {.solid = ProfileOptions::Solid::kRight, .closed = true});
  EXPECT_NEAR(hole.at(1e-3).curvature, -100.0, 1e-12);
  EXPECT_NEAR(hole.closest({4e-3, 0.0}).distance, 6e-3, 1e-15);
}

TEST(Profile, AClosedSplineThroughAnEllipseConvergesWithOrderFour) {
  const double a = 0.03, b = 0.02;
  double before = 0.0;
  for (const int count : {20, 40, 80}) {
    const Profile profile({testing::ellipse(a, b, count)}, {.closed = true});
    double error = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const Vector2d at = profile.at(profile.length() * i / 1000).position;
      error = std::max(error, std::abs(std::hypot(at.x() / a, at.y() / b) - 1.0));
    }
    if (before > 0.0) {
      EXPECT_GT(std::log2(before / error), 3.7);
    }
    before = error;
  }
  EXPECT_LT(before, 1e-6);
}

TEST(Profile, SplinesHaveContinuousCurvatureAndReproduceOneCubic) {
  const Profile closed({testing::ellipse(0.03, 0.02, 24)}, {.closed = true});
  for (const ProfileCell& cell : closed.cells()) {
    const double jump =
        closed.at(cell.start + 1e-9).curvature - closed.at(cell.start - 1e-9).curvature;
    EXPECT_LT(std::abs(jump), 1e-4);  // of 30 to 75 1/m; the derivative is some 1e4 1/m2
  }
  // Equal chords: the parameter of points on a straight cubic is that of the spline.
  PointsSegment open;
  for (int i = 0; i < 6; ++i) open.points.emplace_back(1e-3 * i, 0.0);
  open.start_direction = Vector2d(1.0, 0.0);
  EXPECT_NEAR(Profile({open}).length(), 5e-3, 1e-16);
}

}  // namespace
}  // namespace clatter::dynamics
