// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/valve/cam_profile.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/units.hpp"

namespace clatter::dynamics {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;

namespace {

constexpr int kPoints = 720;  // of a turn
constexpr double kTurn = 2.0 * std::numbers::pi, kStep = kTurn / kPoints;
constexpr double kRest = 1e-6;  // lift below which the cam's base circle faces the roller [m]

}  // namespace

CamProfile::CamProfile(std::vector<Vector2d> points, std::vector<char> rests, double turn)
    : rests_(std::move(rests)), turn_(turn) {
  // Counter-clockwise, with the solid on the left.
  double area = 0.0;
  for (size_t k = 0; k < points.size(); ++k) {
    const Vector2d &a = points[k], &b = points[(k + 1) % points.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  if (area < 0.0) std::reverse(points.begin(), points.end());
  profile_ = std::make_shared<const Profile>(
      std::vector<Segment>{PointsSegment{std::move(points), true, {}, {}}},
      ProfileOptions{.solid = ProfileOptions::Solid::kLeft, .closed = true});
  smallest_radius_ = std::numeric_limits<double>::infinity();
  constexpr int kSamples = 4 * kPoints;
  for (int k = 0; k < kSamples; ++k) {
    const double curvature = profile_->at(profile_->length() * k / kSamples).curvature;
    convex_ = convex_ && curvature > 0.0;
    if (curvature > 0.0) smallest_radius_ = std::min(smallest_radius_, 1.0 / curvature);
  }
}

CamProfile CamProfile::of_law(const FollowerGeometry& geometry, const CamLaw& law, double turn) {
  std::vector<Vector2d> points;
  std::vector<char> rests;
  for (int k = 0; k < kPoints; ++k) {
    const double angle = k * kStep;
    const SplinePoint lift = law.at(angle);
    const auto refuse = [&](const std::string& what) {
      throw InputError(fmt::format("cam at {:.4g} deg, lift {:.4g} mm: {}", angle / kDegree,
                                   lift.value / kMilli, what));
    };
    if (!(lift.value < 0.95 * geometry.highest_lift()))
      refuse(fmt::format("the follower reaches {:.4g} mm", geometry.highest_lift() / kMilli));
    const FollowerState at = follower_at(geometry, lift, angle, turn);
    if (at.curvature * geometry.roller_radius > 1.0 - 1e-6)
      refuse(
          fmt::format("the roller's centre moves on a radius of {:.4g} mm, expected more than "
                      "the roller's {:.4g} mm: the cam would be undercut",
                      1.0 / at.curvature / kMilli, geometry.roller_radius / kMilli));
    points.emplace_back(at.pitch -
                        geometry.roller_radius * (Rotation2Dd(-turn * angle) * at.normal));
    rests.push_back(lift.value < kRest);
  }
  return {std::move(points), std::move(rests), turn};
}

CamProfile CamProfile::of_radius(const FollowerGeometry& geometry, const PeriodicSpline& radius,
                                 double turn) {
  const Vector2d to_roller = geometry.roller - geometry.cam;
  const double towards = std::atan2(to_roller.y(), to_roller.x());
  std::vector<Vector2d> points;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kPoints; ++k) {
    const double polar = k * kStep, r = radius.at(polar).value;
    if (!(r > 0.0))
      throw InputError(
          fmt::format("cam at {:.4g} deg: found a radius of {:.4g} mm, expected one "
                      "above 0",
                      polar / kDegree, r / kMilli));
    least = std::min(least, r);
    points.emplace_back(r * std::cos(polar), r * std::sin(polar));
  }
  std::vector<char> rests;
  for (int k = 0; k < kPoints; ++k)
    rests.push_back(radius.at(towards - turn * k * kStep).value < least + kRest);
  return {std::move(points), std::move(rests), turn};
}

bool CamProfile::rests(double angle, double margin) const {
  const auto count = static_cast<int>(std::ceil(margin / kStep));
  const auto middle =
      static_cast<int>(std::lround((angle / kTurn - std::floor(angle / kTurn)) * kPoints));
  for (int k = middle - count; k <= middle + count; ++k)
    if (!rests_[((k % kPoints) + kPoints) % kPoints]) return false;
  return true;
}

double CamProfile::lift(const FollowerGeometry& geometry, double angle) const {
  const Rotation2Dd back(-turn_ * angle);
  const auto gap = [&](double lift) {
    const Vector2d roller = follower_at(geometry, {lift, 0.0, 0.0, 0.0}, 0.0, turn_).roller;
    return profile_->closest(back * (roller - geometry.cam)).distance - geometry.roller_radius;
  };
  double low = 0.0, high = 0.95 * geometry.highest_lift();
  if (gap(low) > -1e-9) return 0.0;
  while (high - low > 1e-12) {
    const double middle = 0.5 * (low + high);
    (gap(middle) < 0.0 ? low : high) = middle;
  }
  return high;
}

}  // namespace clatter::dynamics
